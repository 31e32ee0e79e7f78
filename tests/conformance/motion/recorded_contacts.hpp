// SPDX-License-Identifier: MIT
// Contacts of a scene, as recorder.contacts has written them.
#pragma once

#include <functional>
#include <vector>

#include "tests/support/scene.hpp"

namespace muro::conformance {

struct RecordedContact {
  Vec3 normal, force;  ///< of the first of its bodies; N
  double depth = 0;    ///< m
};

/// Returns all contacts of all steps at 1 kHz, in the order of time, while `run` builds the scene and runs it.
std::vector<RecordedContact> recorded_contacts(test::Scene& scene, const std::function<void()>& run);

}  // namespace muro::conformance
