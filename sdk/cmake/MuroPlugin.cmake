# SPDX-License-Identifier: MIT
# For plugin authors: muro_add_plugin() and muro_add_controller().

set(MURO_PLUGIN_EXPORTS ${CMAKE_CURRENT_LIST_DIR}/plugin_exports.map)

# muro_add_plugin(NAME motion_point SOURCES point.cpp [LIBRARIES ...])
#
# Builds NAME.so, which exports one symbol and has no undefined muro symbol, and writes NAME.muro.json
# beside it: what the plugin says of itself, so that the host can list it without running its code.
# Everything goes to MURO_PLUGIN_DIR (default: the current build folder).
function(muro_add_plugin)
  cmake_parse_arguments(ARG "" "NAME" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT MURO_PLUGIN_DIR)
    set(MURO_PLUGIN_DIR ${CMAKE_CURRENT_BINARY_DIR})
  endif()
  if("${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${CMAKE_BUILD_TYPE}}" MATCHES "-ffast-math|-Ofast")
    message(FATAL_ERROR "plugin ${ARG_NAME}: -ffast-math changes the arithmetic of every program that loads the "
                        "plugin; remove it from CMAKE_CXX_FLAGS")
  endif()
  add_library(${ARG_NAME} MODULE ${ARG_SOURCES})
  target_link_libraries(${ARG_NAME} PRIVATE muro::sdk ${ARG_LIBRARIES})
  target_link_options(${ARG_NAME} PRIVATE LINKER:--version-script=${MURO_PLUGIN_EXPORTS} LINKER:--exclude-libs,ALL)
  if(NOT CMAKE_CXX_FLAGS MATCHES "fsanitize" AND NOT MURO_SANITIZE)
    target_link_options(${ARG_NAME} PRIVATE LINKER:-z,defs)
  endif()
  set_target_properties(
    ${ARG_NAME}
    PROPERTIES PREFIX ""
               SUFFIX .so
               CXX_VISIBILITY_PRESET hidden
               C_VISIBILITY_PRESET hidden
               VISIBILITY_INLINES_HIDDEN ON
               LIBRARY_OUTPUT_DIRECTORY ${MURO_PLUGIN_DIR})
  if(TARGET muro_plugin_pch)
    target_precompile_headers(${ARG_NAME} REUSE_FROM muro_plugin_pch)
  endif()
  add_custom_command(
    TARGET ${ARG_NAME}
    POST_BUILD
    COMMAND muro::describe $<TARGET_FILE:${ARG_NAME}> ${MURO_PLUGIN_DIR}/${ARG_NAME}.muro.json
    BYPRODUCTS ${MURO_PLUGIN_DIR}/${ARG_NAME}.muro.json
    COMMENT "Describing plugin ${ARG_NAME}"
    VERBATIM)
  add_dependencies(${ARG_NAME} muro_describe)
  set_property(GLOBAL APPEND PROPERTY MURO_PLUGINS ${ARG_NAME})
endfunction()

# muro_add_controller(NAME wander SOURCES wander.c [LIBRARIES ...])
#
# Builds NAME.so, control code for `controller.library`, from C or C++. Needs nothing but the C header.
function(muro_add_controller)
  cmake_parse_arguments(ARG "" "NAME;OUTPUT_DIRECTORY" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT ARG_OUTPUT_DIRECTORY)
    set(ARG_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  endif()
  add_library(${ARG_NAME} MODULE ${ARG_SOURCES})
  target_link_libraries(${ARG_NAME} PRIVATE muro::controller ${ARG_LIBRARIES})
  set_target_properties(
    ${ARG_NAME}
    PROPERTIES PREFIX ""
               SUFFIX .so
               C_VISIBILITY_PRESET hidden
               CXX_VISIBILITY_PRESET hidden
               LIBRARY_OUTPUT_DIRECTORY ${ARG_OUTPUT_DIRECTORY})
endfunction()
