// SPDX-License-Identifier: MIT
// How heavy what robots carry together is: a contact algorithm tells motions that resolve contacts with scenery
// themselves, since any of these contacts may have to bear it.
#pragma once

#include "muro/key.hpp"

namespace muro::keys {

inline constexpr Key<double> carried_mass{
    "contact.carried_mass", "kg",
    "on a base: of all robots that carry each other, itself included; 0 while it carries none and none carries it"};

}  // namespace muro::keys
