# Finds the library of LIGGGHTS 3.8 as Debian installs it (package libliggghts-dev), which has no CMake or pkg-config
# file. Its headers include each other by their bare names, and MPI's: they are included as "liggghts/library.h". The
# MPI must be the one that the library was built with; Debian's is the default MPI, Open MPI.
#
#   LIGGGHTS_INCLUDE_DIR    the folder that has the folder liggghts/
#   LIGGGHTS_LIBRARY        the library
#   LIGGGHTS::LIGGGHTS      both, with MPI
#
# Debian's library has no superquadrics. scripts/setup --superquadrics builds one that has them:
#
#   LIGGGHTS_SUPERQUADRIC_LIBRARY      that library, if there is one
#   LIGGGHTS::LIGGGHTS_SUPERQUADRIC    it, with its headers and their flags

find_path(LIGGGHTS_INCLUDE_DIR liggghts/library.h)
find_library(LIGGGHTS_LIBRARY liggghts)
find_package(MPI COMPONENTS C)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  LIGGGHTS
  REQUIRED_VARS LIGGGHTS_LIBRARY LIGGGHTS_INCLUDE_DIR MPI_C_FOUND
  REASON_FAILURE_MESSAGE "install Debian's package libliggghts-dev, or run scripts/setup")

if(LIGGGHTS_FOUND AND NOT TARGET LIGGGHTS::LIGGGHTS)
  add_library(LIGGGHTS::LIGGGHTS UNKNOWN IMPORTED)
  set_target_properties(LIGGGHTS::LIGGGHTS PROPERTIES IMPORTED_LOCATION "${LIGGGHTS_LIBRARY}")
  target_include_directories(LIGGGHTS::LIGGGHTS SYSTEM INTERFACE "${LIGGGHTS_INCLUDE_DIR}")
  # MPI's own C++ interface, which is gone from the standard, would need another library.
  target_compile_definitions(LIGGGHTS::LIGGGHTS INTERFACE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
  target_link_libraries(LIGGGHTS::LIGGGHTS INTERFACE MPI::MPI_C)
endif()

find_library(LIGGGHTS_SUPERQUADRIC_LIBRARY liggghts-superquadric
             PATHS ${CMAKE_SOURCE_DIR}/build/liggghts-superquadric/lib NO_DEFAULT_PATH)
if(LIGGGHTS_FOUND AND LIGGGHTS_SUPERQUADRIC_LIBRARY AND NOT TARGET LIGGGHTS::LIGGGHTS_SUPERQUADRIC)
  add_library(LIGGGHTS::LIGGGHTS_SUPERQUADRIC SHARED IMPORTED)
  set_target_properties(LIGGGHTS::LIGGGHTS_SUPERQUADRIC PROPERTIES IMPORTED_LOCATION "${LIGGGHTS_SUPERQUADRIC_LIBRARY}")
  cmake_path(GET LIGGGHTS_SUPERQUADRIC_LIBRARY PARENT_PATH superquadric_folder)
  target_include_directories(LIGGGHTS::LIGGGHTS_SUPERQUADRIC SYSTEM INTERFACE "${superquadric_folder}/../include")
  # As the library was compiled: they change the layout of its classes
  target_compile_definitions(LIGGGHTS::LIGGGHTS_SUPERQUADRIC INTERFACE
                             SUPERQUADRIC_ACTIVE_FLAG NONSPHERICAL_ACTIVE_FLAG OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
  target_link_libraries(LIGGGHTS::LIGGGHTS_SUPERQUADRIC INTERFACE MPI::MPI_C)
endif()
mark_as_advanced(LIGGGHTS_INCLUDE_DIR LIGGGHTS_LIBRARY LIGGGHTS_SUPERQUADRIC_LIBRARY)
