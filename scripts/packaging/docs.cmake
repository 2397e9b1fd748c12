# SPDX-License-Identifier: GPL-3.0-or-later
# Target `docs`: the site build/PRESET/docs/html, made by Doxygen from the pages, the docstrings of headers and the
# manuals at the head of OpenFOAM classes (doxygen_page). It fails where a public name of a header has no docstring.
find_package(Doxygen QUIET)
if(DOXYGEN_FOUND)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/Doxyfile.in ${CMAKE_BINARY_DIR}/Doxyfile @ONLY)
  add_custom_target(docs
    COMMAND ${CMAKE_COMMAND} -DDOXYGEN=${DOXYGEN_EXECUTABLE} -DFOLDER=${CMAKE_BINARY_DIR}
            -P ${CMAKE_CURRENT_LIST_DIR}/make_docs.cmake
    WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
    COMMENT "Site of pages and API in ${CMAKE_BINARY_DIR}/docs/html"
    VERBATIM)
else()
  add_custom_target(docs
    COMMAND ${CMAKE_COMMAND} -E echo "docs: Doxygen is missing; scripts/setup --tools installs it"
    COMMAND ${CMAKE_COMMAND} -E false
    VERBATIM)
endif()
