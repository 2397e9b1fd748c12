# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)
# Runs Doxygen in a build folder and names public names without a docstring: cmake -DDOXYGEN=… -DFOLDER=… -P make_docs.cmake
#
# Copies and moves that the compiler writes need none. Links to headings are not checked here: Doxygen names headings in
# another way than the sites that show the pages; the test scripts.readme checks them.
file(MAKE_DIRECTORY ${FOLDER}/docs)
execute_process(COMMAND ${DOXYGEN} ${FOLDER}/Doxyfile RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "docs: doxygen failed")
endif()
file(STRINGS ${FOLDER}/docs/warnings.txt missing REGEX "is not documented")
list(FILTER missing EXCLUDE REGEX "=default|=delete|operator=")
if(missing)
  list(LENGTH missing count)
  list(JOIN missing "\n" lines)
  message(NOTICE "${lines}")
  message(FATAL_ERROR "docs: ${count} public names have no docstring")
endif()
