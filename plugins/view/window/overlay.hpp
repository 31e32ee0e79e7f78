// SPDX-License-Identifier: MIT
// Debug drawing over the scene. No sensor sees it.
#pragma once

#include <vector>

#include "body_poses.hpp"
#include "muro/ext/inspection.hpp"
#include "plugins/common/render/debug_lines.hpp"

namespace muro::view {

class Overlay {
 public:
  bool scans = true, frames = false, contacts = true;

  /// Finds the laser scanners. [setup]
  void connect_by_name(Connector& c);
  /// Adds lines and points of this frame. `selected`: an object whose robot is shown with the frames of all its links.
  void collect(Inspection& simulation, const BodyPoses& bodies, ObjectId selected, render::DebugLines& lines) const;

 private:
  void add_scan(Inspection& simulation, ObjectId sensor, render::DebugLines& lines) const;
  static void add_frame(const Pose& pose, double length, render::DebugLines& lines);

  std::vector<ObjectId> scanners_;
};

}  // namespace muro::view
