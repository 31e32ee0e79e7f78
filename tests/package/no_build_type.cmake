# SPDX-License-Identifier: MIT
# Configures SOURCE in BUILD without a build type, and expects that its plugin is optimised all the same.
file(REMOVE_RECURSE ${BUILD})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${BUILD} -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${CXX}
                        -DCMAKE_PREFIX_PATH=${PREFIX} -DCMAKE_EXPORT_COMPILE_COMMANDS=ON ${ARGUMENTS}
                OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
file(READ ${BUILD}/compile_commands.json commands)
if(NOT commands MATCHES "${EXPECTED}")
  message(FATAL_ERROR "expected `${EXPECTED}` in the command:\n${commands}")
endif()
if(EXPECTED MATCHES "-O2" AND NOT said MATCHES "no build type is set, so it is compiled with -O2")
  message(FATAL_ERROR "it does not say that it optimises:\n${said}")
endif()
