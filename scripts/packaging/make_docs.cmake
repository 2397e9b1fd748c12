# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)
# cmake -DDOXYGEN=… -DFOLDER=… -P make_docs.cmake runs Doxygen in a build folder. It fails and names them where public
# names have no docstring, where a description leaves out some of a function's arguments, and where a page's link to a
# heading has no target. Copies and moves that the compiler writes need no docstring. The test scripts.readme checks the
# pages' links as they are.
file(MAKE_DIRECTORY ${FOLDER}/docs)
execute_process(COMMAND ${DOXYGEN} ${FOLDER}/Doxyfile RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "docs: doxygen failed")
endif()
file(STRINGS ${FOLDER}/docs/warnings.txt missing REGEX "(is|are) not documented")
list(FILTER missing EXCLUDE REGEX "=default|=delete|operator=")
if(missing)
  list(LENGTH missing count)
  list(JOIN missing "\n" lines)
  message(NOTICE "${lines}")
  message(FATAL_ERROR "docs: ${count} public names or their arguments have no docstring")
endif()
file(STRINGS ${FOLDER}/docs/warnings.txt broken REGEX "unable to resolve reference")
if(broken)
  list(JOIN broken "\n" lines)
  message(FATAL_ERROR "docs: links of the pages have no target:\n${lines}")
endif()
