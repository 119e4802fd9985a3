# SPDX-License-Identifier: LGPL-2.1-or-later

# Installation: program, its scripts, library, headers, and what find_package(perideal) reads.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(config_directory ${CMAKE_INSTALL_LIBDIR}/cmake/perideal)
install(TARGETS perideal)
install(DIRECTORY tools DESTINATION ${CMAKE_INSTALL_DATADIR}/perideal FILES_MATCHING PATTERN "*.py")
install(TARGETS perideal_library EXPORT perideal-targets)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/perideal ${PROJECT_BINARY_DIR}/include/perideal
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.h")
install(EXPORT perideal-targets NAMESPACE perideal:: DESTINATION ${config_directory})
configure_package_config_file(perideal-config.cmake.in ${PROJECT_BINARY_DIR}/perideal-config.cmake
  INSTALL_DESTINATION ${config_directory})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/perideal-config-version.cmake
  COMPATIBILITY SameMinorVersion)
# The build folder serves find_package() as well: -Dperideal_DIR=BUILD.
export(EXPORT perideal-targets NAMESPACE perideal:: FILE ${PROJECT_BINARY_DIR}/perideal-targets.cmake)
install(FILES ${PROJECT_BINARY_DIR}/perideal-config.cmake ${PROJECT_BINARY_DIR}/perideal-config-version.cmake
  DESTINATION ${config_directory})
