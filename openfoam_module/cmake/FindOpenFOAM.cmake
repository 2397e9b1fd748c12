# Finds an OpenFOAM to compile against and to link with: either one that is sourced in the shell (WM_PROJECT_DIR holds
# src/ with its lnInclude folders, FOAM_LIBBIN its libraries), or the tree that scripts/setup unpacked in
# build/openfoam, with the distribution's libraries. It must be openfoam.com's, v1912 or later.
#
#   OpenFOAM_ROOT_DIR     the source tree
#   OpenFOAM_API          its version, as 1912
#   OpenFOAM_SOURCED      whether its libraries are those of the shell, FOAM_LIBBIN
#   OpenFOAM::OpenFOAM    include folders, definitions and the compile flags that are safe with OpenFOAM's headers
#   openfoam_link_libraries(<target> finiteVolume meshTools …)   links OpenFOAM's libraries, found by name
#
# The flags: OpenFOAM 1912's field operators let the result of `tensorField & tmp<vectorField>` reuse its operand's
# storage under __restrict__; GCC 12's loop vectoriser then reads what it has overwritten. Every unit that includes
# OpenFOAM headers is therefore compiled without it. Clang (clang-tidy) reads the headers after deprecations.H.

if(DEFINED ENV{WM_PROJECT_DIR} AND IS_DIRECTORY "$ENV{WM_PROJECT_DIR}/src/OpenFOAM/lnInclude")
  set(OpenFOAM_ROOT_DIR "$ENV{WM_PROJECT_DIR}")
elseif(EXISTS "${CMAKE_SOURCE_DIR}/build/openfoam/src/OpenFOAM/lnInclude")
  set(OpenFOAM_ROOT_DIR "${CMAKE_SOURCE_DIR}/build/openfoam")
endif()

if(OpenFOAM_ROOT_DIR AND EXISTS "${OpenFOAM_ROOT_DIR}/META-INFO/api-info")
  file(STRINGS "${OpenFOAM_ROOT_DIR}/META-INFO/api-info" api_line REGEX "^api=")
  string(REPLACE "api=" "" OpenFOAM_API "${api_line}")
endif()

set(openfoam_advice "run scripts/setup, which brings the headers, or source an OpenFOAM first")
if(OpenFOAM_ROOT_DIR AND NOT OpenFOAM_API)
  string(CONCAT openfoam_advice "${OpenFOAM_ROOT_DIR} is not openfoam.com's OpenFOAM, and the Foundation's has neither "
                "fvOptions nor dynamicFvMesh")
endif()

# A sourced OpenFOAM must not be mixed with the distribution's libraries.
set(OpenFOAM_SOURCED OFF)
set(openfoam_only)
if(DEFINED ENV{FOAM_LIBBIN} AND OpenFOAM_ROOT_DIR STREQUAL "$ENV{WM_PROJECT_DIR}")
  set(OpenFOAM_SOURCED ON)
  set(openfoam_only NO_DEFAULT_PATH)
endif()
find_library(OpenFOAM_LIBRARY OpenFOAM HINTS ENV FOAM_LIBBIN ${openfoam_only})
find_library(OpenFOAM_PSTREAM_LIBRARY Pstream
             HINTS "$ENV{FOAM_LIBBIN}/$ENV{FOAM_MPI}" "$ENV{FOAM_LIBBIN}/dummy" ${openfoam_only})

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  OpenFOAM
  REQUIRED_VARS OpenFOAM_ROOT_DIR OpenFOAM_API OpenFOAM_LIBRARY OpenFOAM_PSTREAM_LIBRARY
  VERSION_VAR OpenFOAM_API
  REASON_FAILURE_MESSAGE "${openfoam_advice}")

if(OpenFOAM_FOUND AND NOT TARGET OpenFOAM::OpenFOAM)
  set(src ${OpenFOAM_ROOT_DIR}/src)
  add_library(OpenFOAM::OpenFOAM INTERFACE IMPORTED)
  target_include_directories(
    OpenFOAM::OpenFOAM SYSTEM
    INTERFACE ${src}/finiteVolume/lnInclude
              ${src}/meshTools/lnInclude
              ${src}/sampling/lnInclude
              ${src}/dynamicMesh/lnInclude
              ${src}/dynamicFvMesh/lnInclude
              ${src}/transportModels
              ${src}/transportModels/incompressible/lnInclude
              ${src}/transportModels/interfaceProperties/lnInclude
              ${src}/transportModels/twoPhaseMixture/lnInclude
              ${src}/transportModels/immiscibleIncompressibleTwoPhaseMixture/lnInclude
              ${src}/TurbulenceModels/turbulenceModels/lnInclude
              ${src}/TurbulenceModels/incompressible/lnInclude
              ${src}/surfMesh/lnInclude
              ${src}/fileFormats/lnInclude
              ${src}/OpenFOAM/lnInclude
              ${src}/OSspecific/POSIX/lnInclude)
  set(label_size 32)
  if(DEFINED ENV{WM_LABEL_SIZE})
    set(label_size $ENV{WM_LABEL_SIZE})
  endif()
  target_compile_definitions(OpenFOAM::OpenFOAM INTERFACE OPENFOAM=${OpenFOAM_API} WM_DP WM_LABEL_SIZE=${label_size}
                                                          WM_ARCH_OPTION=64 NoRepository)
  # The last -O on the command line counts: this one follows the build type's -O3.
  target_compile_options(OpenFOAM::OpenFOAM INTERFACE -O2 -ftemplate-depth-100)
  if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    target_compile_options(OpenFOAM::OpenFOAM INTERFACE -fno-vectorize
                                                        "SHELL:-include ${CMAKE_CURRENT_LIST_DIR}/deprecations.H")
  else()
    target_compile_options(OpenFOAM::OpenFOAM INTERFACE -fno-tree-loop-vectorize)
  endif()
  # With sanitizers at -O2, GCC 12 takes std::function inside std::regex, of OpenFOAM's regExp, for uninitialized.
  target_compile_options(OpenFOAM::OpenFOAM INTERFACE $<$<BOOL:${MILLFOAM_SANITIZE}>:-Wno-maybe-uninitialized>)
  target_link_libraries(OpenFOAM::OpenFOAM INTERFACE ${OpenFOAM_LIBRARY} ${OpenFOAM_PSTREAM_LIBRARY})
  target_link_options(OpenFOAM::OpenFOAM INTERFACE LINKER:--no-as-needed)
  # Libraries that only libraries link, too, are those of this OpenFOAM, and not the distribution's.
  if(OpenFOAM_SOURCED)
    target_link_options(OpenFOAM::OpenFOAM INTERFACE LINKER:--disable-new-dtags)
  endif()
endif()

function(openfoam_link_libraries target)
  target_link_libraries(${target} PRIVATE OpenFOAM::OpenFOAM)
  foreach(name IN LISTS ARGN)
    find_library(OpenFOAM_${name}_LIBRARY ${name} HINTS ENV FOAM_LIBBIN ${openfoam_only} REQUIRED)
    target_link_libraries(${target} PRIVATE ${OpenFOAM_${name}_LIBRARY})
  endforeach()
endfunction()
