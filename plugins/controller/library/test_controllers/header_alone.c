/* SPDX-License-Identifier: MIT */
#include "muro_controller.h"

const muro_controller_table* muro_controller(void) { return NULL; }
