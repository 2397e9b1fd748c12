# SPDX-License-Identifier: GPL-3.0-or-later
# What `cmake --install` puts where, and the Debian package that `cpack` makes of it.
#
#   bin/                        tools
#   lib/                        libmillFoam.so, static libraries, CMake package millFoam (find_package(millFoam))
#   include/millfoam/           headers, included as "averaging/run/average_run.hpp"
#   share/millfoam/             scripts, the template of a case, and the mills of cases/mills
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(headers ${CMAKE_INSTALL_INCLUDEDIR}/millfoam)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/millFoam)
set(share ${CMAKE_INSTALL_DATADIR}/millfoam)

set(tools millMesh millDem millAverage millDrag)
if(MILLFOAM_LIGGGHTS)
  list(APPEND tools millLiggghts)
else()
  set(liggghts "liggghts, ")
endif()
if(MILLFOAM_OPENFOAM)
  list(APPEND tools slurryStart slurryFoam millInterFoam foamMeshToH5)
  # Cases name it in controlDict's `libs`
  install(TARGETS millFoam LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()
install(TARGETS ${tools} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

foreach(room options version drag surface meshing dem_driver averaging averaging_run)
  set_target_properties(millfoam_${room} PROPERTIES EXPORT_NAME ${room})
endforeach()
install(TARGETS millfoam_options millfoam_version millfoam_drag millfoam_surface millfoam_meshing millfoam_dem_driver
                millfoam_averaging millfoam_averaging_run
        EXPORT millFoamTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${headers})
install(EXPORT millFoamTargets NAMESPACE millFoam:: DESTINATION ${package})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/millFoamConfig.cmake.in ${CMAKE_BINARY_DIR}/millFoamConfig.cmake
                              INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/millFoamConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/millFoamConfig.cmake ${CMAKE_BINARY_DIR}/millFoamConfigVersion.cmake
        DESTINATION ${package})

foreach(room meshing dem_driver averaging)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/${room} DESTINATION ${headers} FILES_MATCHING PATTERN *.hpp
          PATTERN tools EXCLUDE)
endforeach()
install(DIRECTORY ${CMAKE_SOURCE_DIR}/openfoam_module/drag DESTINATION ${headers}/openfoam_module
        FILES_MATCHING PATTERN *.hpp PATTERN tools EXCLUDE)
install(FILES ${CMAKE_BINARY_DIR}/generated/millfoam_version.hpp DESTINATION ${headers})

install(PROGRAMS ${CMAKE_SOURCE_DIR}/scripts/new_mill ${CMAKE_SOURCE_DIR}/scripts/plot_mill
                 ${CMAKE_SOURCE_DIR}/scripts/report ${CMAKE_SOURCE_DIR}/scripts/setup
        DESTINATION ${share}/scripts)
install(FILES ${CMAKE_SOURCE_DIR}/scripts/case_functions ${CMAKE_SOURCE_DIR}/scripts/coupling_functions
              ${CMAKE_SOURCE_DIR}/scripts/env ${CMAKE_SOURCE_DIR}/scripts/mill_stages
              ${CMAKE_SOURCE_DIR}/scripts/paraview_mill.py ${CMAKE_SOURCE_DIR}/scripts/stage_functions
        DESTINATION ${share}/scripts)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/scripts/mill_case ${CMAKE_SOURCE_DIR}/scripts/millfoam
        DESTINATION ${share}/scripts
        PATTERN __pycache__ EXCLUDE)
file(GLOB mills CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/cases ${CMAKE_SOURCE_DIR}/cases/mills/*/mill.yaml)
foreach(mill ${mills})
  cmake_path(GET mill PARENT_PATH folder)
  install(FILES ${CMAKE_SOURCE_DIR}/cases/${mill} DESTINATION ${share}/${folder})
endforeach()
install(FILES ${CMAKE_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_PACKAGE_NAME millfoam)
set(CPACK_PACKAGE_CONTACT "The millFoam developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# What the programs start, and the report's Python; libraries are found by dpkg-shlibdeps
string(CONCAT CPACK_DEBIAN_PACKAGE_DEPENDS
       "${liggghts}openmpi-bin, python3, python3-numpy, python3-h5py, python3-matplotlib, python3-scipy, "
       "python3-skimage, python3-pil")
# With another OpenFOAM than the distribution's, its owner sources it
if(MILLFOAM_OPENFOAM AND NOT MILLFOAM_OPENFOAM_SOURCED)
  string(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS ", openfoam")
endif()
# To link with the static libraries
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
    "libeigen3-dev, libcgal-dev, libyaml-cpp-dev, nlohmann-json3-dev, libhdf5-dev, zlib1g-dev")
include(CPack)
