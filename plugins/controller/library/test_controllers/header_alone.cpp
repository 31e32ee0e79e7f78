// SPDX-License-Identifier: MIT
#include "muro_controller.h"

#include "muro_controller.h"

const muro_controller_table* muro_controller() { return nullptr; }
