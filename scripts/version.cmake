# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)
# Writes the version that the programs carry, at every build: cmake -DSOURCE=… -DVERSION=… -DOUTPUT=… -P version.cmake
# The version is that of the project and, in a git tree, the commit, with -dirty where files were changed since. The
# file is written only when its content changes, so that nothing else is compiled again.
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=9 HEAD
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(NOT failed)
  execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no
                  OUTPUT_VARIABLE changes OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  string(APPEND VERSION "+${commit}")
  if(changes)
    string(APPEND VERSION "-dirty")
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT
"// Written by scripts/version.cmake.
#include \"millfoam_version.hpp\"

namespace millfoam {

const char* version() { return \"@VERSION@\"; }

}  // namespace millfoam
")
