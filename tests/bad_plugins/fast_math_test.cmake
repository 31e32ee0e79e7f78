# SPDX-License-Identifier: MIT
# Builds a plugin out of tree with fast arithmetic that comes in by PLACE, and expects the refusal.
set(flags "")
set(before "")
set(after "")
if(PLACE STREQUAL configure_flags)
  set(flags -DCMAKE_CXX_FLAGS=-ffast-math)
  set(expected "plugin fast: -ffast-math changes the arithmetic of every program that loads it")
elseif(PLACE STREQUAL directory_options)
  set(before "add_compile_options(-Ofast)")
  set(expected "plugin fast: -Ofast changes the arithmetic of every program that loads it")
elseif(PLACE STREQUAL target_options)
  set(after "target_compile_options(fast PRIVATE -ffast-math)")
  set(expected "muro plugins are not built with -ffast-math")
elseif(PLACE STREQUAL link_options)
  set(after "target_link_options(fast PRIVATE -ffast-math)")
  set(expected "loading it turns off subnormal numbers in the whole program")
endif()

file(REMOVE_RECURSE ${SCRATCH})
file(WRITE ${SCRATCH}/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(fast CXX)
find_package(muro REQUIRED)
${before}
muro_add_plugin(NAME fast SOURCES ${CMAKE_CURRENT_LIST_DIR}/unchanged.cpp)
target_compile_definitions(fast PRIVATE PLUGIN_NAME=\"fast\")
${after}
")
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SCRATCH} -B ${SCRATCH}/build -G ${GENERATOR} -Dmuro_DIR=${MURO_PACKAGE}
                        -DCMAKE_CXX_COMPILER=${CXX} ${flags}
                RESULT_VARIABLE code OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(code EQUAL 0)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${SCRATCH}/build RESULT_VARIABLE code OUTPUT_VARIABLE built
                  ERROR_VARIABLE built)
  string(APPEND said "${built}")
endif()
string(REGEX REPLACE "[ \n]+" " " words "${said}")
string(FIND "${words}" "${expected}" at)
if(code EQUAL 0 OR at EQUAL -1)
  message(FATAL_ERROR "expected a refusal with \"${expected}\"; exit code ${code}:\n${said}")
endif()
