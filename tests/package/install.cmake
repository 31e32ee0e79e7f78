# SPDX-License-Identifier: MIT
# Installs the build tree FROM to TO, from nothing.
file(REMOVE_RECURSE ${TO})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${FROM} --prefix ${TO} COMMAND_ERROR_IS_FATAL ANY)
