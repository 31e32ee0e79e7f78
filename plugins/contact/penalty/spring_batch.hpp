// SPDX-License-Identifier: MIT
#pragma once

#include "scenery_contacts.hpp"

namespace muro::penalty {

/// What the kernel is told of the contacts of one robot.
struct SceneryContacts::SpringBatch {
  ContactLayout layout;
  FrictionAnchor before[max_contacts];
  std::uint8_t anchors_ends[max_contacts], patch_of[max_contacts];
  int patches = 0;
};

}  // namespace muro::penalty
