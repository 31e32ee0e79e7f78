// SPDX-License-Identifier: MIT
// What is drawn over the scene: for eyes alone, no sensor sees it.
#pragma once

#include <vector>

#include "muro/inspection.hpp"
#include "plugins/common/render/lines.hpp"

namespace muro::view {

class Overlay {
 public:
  bool scans = true, frames = false, contacts = true;

  /// Remembers robots and laser scanners. [setup]
  void connect(Connector& c);
  /// What there is to draw now. `chosen`: an object whose robot's frames are all shown.
  void collect(Inspection& simulation, ObjectId chosen, render::Lines& lines) const;

 private:
  struct Body {
    In<Pose> pose;
    ObjectId object;
    std::int32_t robot;
    bool is_base;
  };

  void add_scan(Inspection& simulation, ObjectId sensor, render::Lines& lines) const;
  static void add_frame(const Pose& pose, double length, render::Lines& lines);

  std::vector<Body> bodies_;
  std::vector<ObjectId> sensors_;
};

}  // namespace muro::view
