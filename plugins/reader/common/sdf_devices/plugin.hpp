// SPDX-License-Identifier: MIT
#pragma once

#include "fields.hpp"
#include "subsystem.hpp"

namespace muro::sdf_devices {

/// Reads a <plugin> of a model. A plugin that drives the wheels of a vehicle by a twist becomes `drive.differential`,
/// `drive.skid_steer` or `drive.ackermann`. All others become nothing and are listed.
Device read_plugin(Element& plugin, PartNames& parts, Messages& messages);

}  // namespace muro::sdf_devices
