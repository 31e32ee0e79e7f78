/* SPDX-License-Identifier: MIT
 * Calls a function that no library has. */
#include "muro_controller.h"

int function_of_no_library(void);

const muro_controller_table* muro_controller(void) {
  function_of_no_library();
  return NULL;
}
