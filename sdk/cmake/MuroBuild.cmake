# SPDX-License-Identifier: MIT
# Settings of this repository's own targets; plugin authors do not need this file.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "Optimised, with line numbers" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 11)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(MURO_PLUGIN_DIR ${CMAKE_BINARY_DIR}/lib/muro)
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g1")
set(CMAKE_C_FLAGS_RELWITHDEBINFO "-O2 -g1")

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # precompiled headers and ccache agree only with this setting
  set(launcher /usr/bin/env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
endif()

add_compile_options(-Wall -Wextra -Wpedantic -Wshadow $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>
                    -ffp-contract=off)
# g++ looks for memory to free only when it has half a gigabyte: a sixth less time
add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=524288>)
if(MURO_WERROR)
  add_compile_options(-Werror)
endif()
if(MURO_SANITIZE)
  # -O1: without it the longest tests run into their time limits; gcc's guess about uninitialised values fails there
  add_compile_options(-O1 -g1 $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized> -fsanitize=${MURO_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${MURO_SANITIZE})
endif()
if(MURO_FUZZ) # with clang
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# Compiles the sources of a target in batches, each as one file: what headers cost is paid once a batch. The linter sees
# each source by itself (MURO_UNITY=OFF).
function(muro_compile_in_batches target batch_size)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${MURO_UNITY} UNITY_BUILD_BATCH_SIZE ${batch_size})
endfunction()

# Makes a target part of test programs: with the headers and options of muro_test_pch. They spend their time in what they
# test; compiling them is what takes long. Preset debug has symbols of tests.
set(MURO_TEST_OPTIONS -fPIE "$<$<CONFIG:RelWithDebInfo>:-O1;-g0>")
function(muro_compile_as_test target)
  target_link_libraries(${target} PUBLIC muro::sdk GTest::gtest)
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
  target_compile_options(${target} PRIVATE ${MURO_TEST_OPTIONS})
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  if(NOT ${target} STREQUAL "muro_test_pch")
    target_precompile_headers(${target} REUSE_FROM muro_test_pch)
  endif()
endfunction()

# muro_add_static_library(NAME muro_x SOURCES ... [LIBRARIES ...] [PRIVATE ...]): a static library that plugins share, or a plugin
# and its tests; included as "plugins/x/...". PRIVATE: libraries that its users do not see.
function(muro_add_static_library)
  cmake_parse_arguments(ARG "" "NAME" "SOURCES;LIBRARIES;PRIVATE" ${ARGN})
  add_library(${ARG_NAME} STATIC EXCLUDE_FROM_ALL ${ARG_SOURCES})
  target_link_libraries(${ARG_NAME} PUBLIC muro::sdk ${ARG_LIBRARIES} PRIVATE ${ARG_PRIVATE})
  target_include_directories(${ARG_NAME} PUBLIC ${PROJECT_SOURCE_DIR})
  set_target_properties(${ARG_NAME} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_precompile_headers(${ARG_NAME} REUSE_FROM muro_plugin_pch)
  muro_compile_in_batches(${ARG_NAME} 5)
endfunction()

# muro_add_test(NAME x SOURCES ... [LIBRARIES ...] [TIMEOUT s] [FIXTURE f] [SLOW] [SEPARATE]): a GoogleTest program, each
# test known to ctest. FIXTURE: the tests that set it up run before. Tests whose suite, instantiation or own name begins
# with the word Slow have the label `slow` and a TIMEOUT of 480 s or more (120 s by default); so have all tests of a
# program that is SLOW, which is built for `./dev test --slow` alone, and all where MURO_ALL_TESTS_SLOW is set.
# SEPARATE: its sources have different helpers under one name, so they are not compiled in batches.
function(muro_add_test)
  cmake_parse_arguments(ARG "SLOW;SEPARATE" "NAME;TIMEOUT;FIXTURE" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT MURO_TESTS OR (ARG_SLOW AND NOT MURO_SLOW_TESTS))
    return()
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  set(slow_timeout ${ARG_TIMEOUT})
  if(slow_timeout LESS 480)
    set(slow_timeout 480)
  endif()
  add_executable(${ARG_NAME} ${ARG_SOURCES})
  target_link_libraries(${ARG_NAME} PRIVATE GTest::gtest_main ${ARG_LIBRARIES})
  muro_compile_as_test(${ARG_NAME})
  if(NOT ARG_SEPARATE)
    muro_compile_in_batches(${ARG_NAME} 12)
  endif()
  set_target_properties(${ARG_NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  include(GoogleTest)
  gtest_discover_tests(${ARG_NAME} TEST_PREFIX ${ARG_NAME}. TEST_LIST tests NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT ${ARG_TIMEOUT} FIXTURES_REQUIRED "${ARG_FIXTURE}")
  set(slow "(.*[./])?Slow[A-Z0-9/]")
  if(ARG_SLOW OR MURO_ALL_TESTS_SLOW)
    set(slow "")
  endif()
  # ctest reads this after the tests that were found
  file(CONFIGURE OUTPUT ${ARG_NAME}_labels.cmake CONTENT [[
foreach(test IN LISTS tests)
  if(test MATCHES "^@ARG_NAME@[.]@slow@")
    set_tests_properties(${test} PROPERTIES LABELS slow TIMEOUT @slow_timeout@)
  endif()
endforeach()
]] @ONLY)
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${ARG_NAME}_labels.cmake)
endfunction()

# muro_add_bench(NAME bench_x SOURCES ... [LIBRARIES ...]): a program that `./dev bench` runs.
function(muro_add_bench)
  cmake_parse_arguments(ARG "" "NAME" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT MURO_TESTS)
    return()
  endif()
  if(NOT ARG_NAME MATCHES "^bench_")
    message(FATAL_ERROR "muro_add_bench(NAME ${ARG_NAME}): the name of a benchmark begins with bench_")
  endif()
  add_executable(${ARG_NAME} ${ARG_SOURCES})
  target_link_libraries(${ARG_NAME} PRIVATE muro::sdk ${ARG_LIBRARIES})
  target_include_directories(${ARG_NAME} PRIVATE ${PROJECT_SOURCE_DIR})
  set_target_properties(${ARG_NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bench)
  set_property(GLOBAL APPEND PROPERTY MURO_BENCHMARKS ${ARG_NAME})
endfunction()

# muro_skip(WHAT REASON): a part left out at configure time, named in the summary.
function(muro_skip WHAT REASON)
  set_property(GLOBAL APPEND PROPERTY MURO_SKIPPED "${WHAT}: ${REASON}")
endfunction()

function(muro_print_summary)
  get_property(plugins GLOBAL PROPERTY MURO_PLUGINS)
  get_property(skipped GLOBAL PROPERTY MURO_SKIPPED)
  list(JOIN plugins " " plugins)
  message(STATUS "muro ${PROJECT_VERSION}: plugins ${plugins}")
  foreach(line IN LISTS skipped)
    message(STATUS "  left out: ${line}")
  endforeach()
endfunction()

# simulator: what a user runs, without tests. benchmarks: the programs of muro_add_bench.
function(muro_add_groups)
  get_property(plugins GLOBAL PROPERTY MURO_PLUGINS)
  get_property(controllers GLOBAL PROPERTY MURO_CONTROLLERS)
  get_property(benchmarks GLOBAL PROPERTY MURO_BENCHMARKS)
  add_custom_target(simulator)
  add_dependencies(simulator ${plugins} ${controllers})
  foreach(target IN ITEMS muro muro_parser muro_parser_client)
    if(TARGET ${target})
      add_dependencies(simulator ${target})
    endif()
  endforeach()
  add_custom_target(benchmarks)
  if(benchmarks)
    add_dependencies(benchmarks simulator ${benchmarks})
  endif()
endfunction()
