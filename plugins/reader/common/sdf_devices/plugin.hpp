// SPDX-License-Identifier: MIT
#pragma once

#include "fields.hpp"
#include "subsystem.hpp"

namespace muro::sdf_devices {

/// A <plugin> of a model. Those that drive the wheels of a vehicle by a twist become `drive.differential`,
/// `drive.skid_steer` or `drive.ackermann`; all others become nothing, and are listed.
Device read_plugin(Element& plugin, PartNames& parts, Messages& messages);

}  // namespace muro::sdf_devices
