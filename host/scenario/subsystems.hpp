// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/simulation.hpp"
#include "host/scenario/algorithms.hpp"

namespace muro::host {

/// Adds the algorithms that serve one robot.
class Subsystems {
 public:
  Subsystems(Simulation& simulation, Algorithms& algorithms, Problems& problems)
      : simulation_(simulation), world_(simulation.world()), algorithms_(algorithms), problems_(problems) {}

  /// Adds sensors first, because parts of a sensor may precede it in the file. Returns whether a motion moves the
  /// robot.
  bool add(const RobotTemplate& t, const RobotView& robot, const std::vector<Subsystem>& subsystems);

 private:
  bool is_only_motion(const RobotTemplate& t, const Subsystem& s, const Subsystem*& first);
  bool add_one(const RobotTemplate& t, const RobotView& robot, const Subsystem& s, const Description& d,
               const std::vector<Subsystem>& all);
  ObjectId mounting_object(const RobotView& robot, const Subsystem& s);
  /// Both functions return no_object and add a problem when there is no such object.
  ObjectId add_sensor(const RobotTemplate& t, const RobotView& robot, const Subsystem& s);
  ObjectId sensor_of_error(const RobotTemplate& t, const RobotView& robot, Subsystem& s,
                           const std::vector<Subsystem>& all);

  Simulation& simulation_;
  World& world_;
  Algorithms& algorithms_;
  Problems& problems_;
};

}  // namespace muro::host
