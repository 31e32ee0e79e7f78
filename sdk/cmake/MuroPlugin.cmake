# SPDX-License-Identifier: MIT
# For plugin authors: muro_add_plugin(), muro_add_kernels(), muro_use_kernels() and muro_add_controller(). Comes with find_package(muro), and with
# add_subdirectory(<muro>/sdk).

# muro_add_plugin(NAME motion_point SOURCES point.cpp [LIBRARIES ...] [OUTPUT_DIRECTORY ...])
#
# Builds NAME.so, which exports one symbol and has no undefined muro symbol, and writes NAME.muro.json
# beside it: what the plugin says of itself, so that the host can list it without running its code.
# Both go to OUTPUT_DIRECTORY (default: MURO_PLUGIN_DIR, else the current build folder) and are installed
# to lib/muro. Where MURO_PLUGINS_FOR_TESTS is set, plugins are not installed, are not in the summary and are
# compiled without the precompiled header.
function(muro_add_plugin)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "NAME;OUTPUT_DIRECTORY" "SOURCES;LIBRARIES")
  if(NOT ARG_NAME OR NOT ARG_SOURCES OR ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "muro_add_plugin(NAME name SOURCES file... [LIBRARIES ...] [OUTPUT_DIRECTORY dir]): "
                        "NAME or SOURCES missing, or not understood: ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  _muro_refuse_fast_math("plugin ${ARG_NAME}")
  if(NOT ARG_OUTPUT_DIRECTORY)
    set(ARG_OUTPUT_DIRECTORY ${MURO_PLUGIN_DIR})
  endif()
  if(NOT ARG_OUTPUT_DIRECTORY)
    set(ARG_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  endif()

  add_library(${ARG_NAME} MODULE ${ARG_SOURCES})
  _muro_optimise(${ARG_NAME})
  target_link_libraries(${ARG_NAME} PRIVATE muro::sdk ${ARG_LIBRARIES})
  target_link_options(${ARG_NAME} PRIVATE LINKER:--version-script=${CMAKE_CURRENT_FUNCTION_LIST_DIR}/plugin_exports.map
                      LINKER:--exclude-libs,ALL)
  _muro_refuse_undefined(${ARG_NAME})
  set_target_properties(
    ${ARG_NAME}
    PROPERTIES PREFIX ""
               SUFFIX .so
               CXX_VISIBILITY_PRESET hidden
               C_VISIBILITY_PRESET hidden
               VISIBILITY_INLINES_HIDDEN ON
               LIBRARY_OUTPUT_DIRECTORY ${ARG_OUTPUT_DIRECTORY})
  if(TARGET muro_plugin_pch AND NOT MURO_PLUGINS_FOR_TESTS)
    target_precompile_headers(${ARG_NAME} REUSE_FROM muro_plugin_pch)
    muro_compile_in_batches(${ARG_NAME} 5)
  endif()

  set(description ${ARG_OUTPUT_DIRECTORY}/${ARG_NAME}.muro.json)
  add_custom_command(
    TARGET ${ARG_NAME}
    POST_BUILD
    COMMAND muro::describe $<TARGET_FILE:${ARG_NAME}> ${description}
    BYPRODUCTS ${description}
    COMMENT "Describing plugin ${ARG_NAME}"
    VERBATIM)
  # described anew when the describing program changes
  set_property(TARGET ${ARG_NAME} APPEND PROPERTY LINK_DEPENDS $<TARGET_FILE:muro::describe>)
  if(NOT MURO_PLUGINS_FOR_TESTS)
    set_property(GLOBAL APPEND PROPERTY MURO_PLUGINS ${ARG_NAME})
    install(TARGETS ${ARG_NAME} LIBRARY DESTINATION lib/muro)
    install(FILES ${description} DESTINATION lib/muro)
  endif()
endfunction()

# muro_add_kernels(TARGET motion_point SOURCES step_kernel.cpp)
#
# Compiles sources into a target, once for each instruction set of muro/simd/isa.hpp, with MURO_ISA naming it. Such a
# source includes the headers of muro/simd/ and declarations of its own, and nothing that has inline functions beside.
function(muro_add_kernels)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "TARGET" "SOURCES")
  if(NOT ARG_TARGET OR NOT ARG_SOURCES OR ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "muro_add_kernels(TARGET target SOURCES file...): TARGET or SOURCES missing, or not "
                        "understood: ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  set(flags_base "")
  set(flags_avx2 -mavx2)
  set(flags_avx512 -mavx512f -mavx512dq -mavx512vl -mavx512bw -mprefer-vector-width=512)
  set(isas base)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    list(APPEND isas avx2 avx512)
  endif()
  foreach(isa IN LISTS isas)
    set(kernels ${ARG_TARGET}_${isa})
    add_library(${kernels} OBJECT ${ARG_SOURCES})
    target_include_directories(${kernels} PRIVATE $<TARGET_PROPERTY:${ARG_TARGET},INCLUDE_DIRECTORIES>)
    target_compile_features(${kernels} PRIVATE cxx_std_20)
    target_compile_definitions(${kernels} PRIVATE MURO_ISA=${isa})
    # -Wno-psabi: no vector is passed between functions, for all are inlined. -Wno-maybe-uninitialized: the headers of
    # gcc 12 for AVX-512 warn of themselves. -fno-tree-slp-vectorize: in spite of -ffp-contract=off, gcc 12 makes pairs of
    # a product with a sum and a difference one operation with one rounding.
    target_compile_options(${kernels} PRIVATE -ffp-contract=off -fno-math-errno -fno-trapping-math -Wno-psabi
                                              "$<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized;-Wno-maybe-uninitialized;-fno-tree-slp-vectorize>"
                                              $<$<NOT:$<CONFIG:Debug>>:-O3> ${flags_${isa}})
    set_target_properties(${kernels} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
                                                VISIBILITY_INLINES_HIDDEN ON)
    target_sources(${ARG_TARGET} PRIVATE $<TARGET_OBJECTS:${kernels}>)
  endforeach()
endfunction()

# muro_use_kernels(TARGET motion_point_test FROM motion_point)
#
# Gives a target, such as a test, the kernels that were compiled for another one.
function(muro_use_kernels)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "TARGET;FROM" "")
  if(NOT TARGET "${ARG_TARGET}" OR NOT TARGET "${ARG_FROM}_base" OR ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "muro_use_kernels(TARGET target FROM target): `${ARG_TARGET}` is no target, `${ARG_FROM}` has no "
                        "kernels, or not understood: ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  foreach(isa IN ITEMS base avx2 avx512)
    if(TARGET ${ARG_FROM}_${isa})
      target_sources(${ARG_TARGET} PRIVATE $<TARGET_OBJECTS:${ARG_FROM}_${isa}>)
    endif()
  endforeach()
endfunction()

# muro_add_controller(NAME wander SOURCES wander.c [LIBRARIES ...] [OUTPUT_DIRECTORY ...])
#
# Builds NAME.so, control code for `controller.library`, from C, C++ or another language that CMake knows. Needs nothing
# but the C header. Its references to its own functions are bound when it is linked: else the dynamic linker would take
# those of the program and of what it is linked with where they have the same name, such as `step` of the C library.
function(muro_add_controller)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "NAME;OUTPUT_DIRECTORY" "SOURCES;LIBRARIES")
  if(NOT ARG_NAME OR NOT ARG_SOURCES OR ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "muro_add_controller(NAME name SOURCES file... [LIBRARIES ...] [OUTPUT_DIRECTORY dir]): "
                        "NAME or SOURCES missing, or not understood: ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  _muro_refuse_fast_math("controller ${ARG_NAME}")
  if(NOT ARG_OUTPUT_DIRECTORY)
    set(ARG_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  endif()
  add_library(${ARG_NAME} MODULE ${ARG_SOURCES})
  _muro_optimise(${ARG_NAME})
  target_link_libraries(${ARG_NAME} PRIVATE muro::controller ${ARG_LIBRARIES})
  target_link_options(${ARG_NAME} PRIVATE LINKER:-Bsymbolic)
  _muro_refuse_undefined(${ARG_NAME})
  set_target_properties(
    ${ARG_NAME}
    PROPERTIES PREFIX ""
               SUFFIX .so
               C_VISIBILITY_PRESET hidden
               CXX_VISIBILITY_PRESET hidden
               LIBRARY_OUTPUT_DIRECTORY ${ARG_OUTPUT_DIRECTORY})
  set_property(GLOBAL APPEND PROPERTY MURO_CONTROLLERS ${ARG_NAME})
endfunction()

# What no library has is an error of the build, not of the run that loads it: a process of its own lacks what muro has.
# The run-time library of a sanitizer is found when the program is loaded, so its symbols stay open.
function(_muro_refuse_undefined TARGET)
  if(NOT CMAKE_CXX_FLAGS MATCHES "fsanitize" AND NOT MURO_SANITIZE)
    target_link_options(${TARGET} PRIVATE LINKER:-z,defs)
  endif()
endfunction()

# Where a project sets no build type and no -O, CMake compiles without optimisation: steps take up to 100 times as long.
function(_muro_optimise TARGET)
  get_property(multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
  get_directory_property(options COMPILE_OPTIONS)
  if(CMAKE_BUILD_TYPE OR multi_config OR "${CMAKE_C_FLAGS} ${CMAKE_CXX_FLAGS} ${options}" MATCHES "(^|[ ;])-O")
    return()
  endif()
  message(STATUS "${TARGET}: no build type is set, so it is compiled with -O2 -DNDEBUG; "
                 "-DCMAKE_BUILD_TYPE=Debug is for debugging")
  target_compile_options(${TARGET} PRIVATE -O2 -DNDEBUG)
endfunction()

# A library linked with these flags turns off subnormal numbers in the thread that loads it (gcc before 13,
# clang before 19: crtfastmath.o), and so changes the results of everything else in the process.
function(_muro_refuse_fast_math WHO)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" config)
  get_directory_property(options COMPILE_OPTIONS)
  get_directory_property(link_options LINK_OPTIONS)
  set(flags "${CMAKE_C_FLAGS} ${CMAKE_CXX_FLAGS} ${CMAKE_C_FLAGS_${config}} ${CMAKE_CXX_FLAGS_${config}} \
${CMAKE_MODULE_LINKER_FLAGS} ${options} ${link_options}")
  if(flags MATCHES "(-ffast-math|-Ofast|-funsafe-math-optimizations)")
    message(FATAL_ERROR "${WHO}: ${CMAKE_MATCH_1} changes the arithmetic of every program that loads it; "
                        "remove it from the compiler's flags")
  endif()
endfunction()
