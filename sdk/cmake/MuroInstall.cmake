# SPDX-License-Identifier: MIT
# The package `muro` that plugin authors find: in the installation, and with the same layout in the build tree, so
# that CMAKE_PREFIX_PATH may name either.
include(CMakePackageConfigHelpers)

set(package lib/cmake/muro)
if(TARGET muro)
  install(TARGETS muro EXPORT muroTargets RUNTIME DESTINATION bin)
endif()
install(TARGETS muro_sdk muro_elementary muro_controller muro_describe EXPORT muroTargets RUNTIME DESTINATION libexec/muro)
install(DIRECTORY sdk/muro DESTINATION include FILES_MATCHING PATTERN "*.hpp")
install(FILES sdk/c/muro_controller.h sdk/c/muro_controller.hpp sdk/c/muro_elementary.h DESTINATION include)
install(DIRECTORY sdk/template DESTINATION share/muro)
install(FILES sdk/CHANGELOG.md DESTINATION share/muro)
install(EXPORT muroTargets NAMESPACE muro:: DESTINATION ${package})
export(EXPORT muroTargets NAMESPACE muro:: FILE ${CMAKE_BINARY_DIR}/${package}/muroTargets.cmake)

configure_package_config_file(sdk/cmake/muroConfig.cmake.in ${CMAKE_BINARY_DIR}/${package}/muroConfig.cmake
                              INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/${package}/muroConfigVersion.cmake COMPATIBILITY SameMajorVersion)
foreach(file MuroPlugin.cmake plugin_exports.map)
  configure_file(sdk/cmake/${file} ${CMAKE_BINARY_DIR}/${package}/${file} COPYONLY)
endforeach()
install(FILES ${CMAKE_BINARY_DIR}/${package}/muroConfig.cmake ${CMAKE_BINARY_DIR}/${package}/muroConfigVersion.cmake
              ${CMAKE_BINARY_DIR}/${package}/MuroPlugin.cmake ${CMAKE_BINARY_DIR}/${package}/plugin_exports.map
        DESTINATION ${package})
