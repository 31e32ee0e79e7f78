// SPDX-License-Identifier: MIT
// The watch over robots of motions whose contacts a collision algorithm finds: as motions by engines have it.
#pragma once

#include <atomic>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"
#include "resting_depth.hpp"
#include "watch.hpp"

namespace muro::watch {

/// What robots can touch, by object.
struct Obstacle {
  std::string name;
  bool is_scenery = false;
};
using Obstacles = std::map<std::uint32_t, Obstacle>;
Obstacles obstacles_of(const Connector& c);

/// Why a run ends in which the numbers of a robot are no longer those of bodies: its pose, twist or joints are not.
/// `external`: the sum of the wrenches on it, `mass`: kg.
std::string failure_of_numbers(std::string_view robot, const Pose& pose, const Twist& twist, const Wrench& external,
                               double mass);

/// The watch over one robot. Looks at it each `interval` steps: what comes apart stays so.
class RobotWatch {
 public:
  static constexpr std::uint64_t interval = 16;

  /// `velocities`: of the joints, one per link (rad/s or m/s); null for those that no force moves. [setup]
  RobotWatch(Connector& c, const RobotView& robot, std::span<const double* const> velocities);
  /// Finds out whether there is a contact algorithm, and looks at contacts where somebody does. [setup]
  void connect_contacts(Connector& c);
  /// The run begins or goes on; `external`: what adds to the robot's wrench, null where nothing moves its base. [setup]
  void begin(const SumIn<Wrench>* external);
  /// Why the run ends; empty while it goes on.
  std::string problem(const Pose& pose, const Twist& twist, const Obstacles& obstacles);
  /// Says that it stands too deep in something at `time` (s): of all robots that share `is_told` the first.
  void tell_depth(double time, const Obstacles& obstacles, Host& host, std::atomic<bool>& is_told);

 private:
  struct Joint {
    const double* velocity;
    double reach_square;  ///< m^2, see Reach; 1 for a joint that shifts
    std::string name;
  };
  struct Overlap {
    double depth = 0;
    const std::string* obstacle = nullptr;
  };

  Overlap deepest_overlap(const Obstacles& obstacles) const;
  bool is_fixed(ObjectId body) const;

  Watch watch_;
  RestingDepth resting_depth_;
  std::vector<ObjectId> fixed_;  ///< bodies that nothing moves, in rising order
  ObjectId base_;
  std::string name_;
  bool begins_ = true;
  bool has_contact_law_ = false;
  ListIn<Contact> contacts_;
  std::vector<Joint> joints_;  ///< those that forces drive
};

}  // namespace muro::watch
