// SPDX-License-Identifier: MIT
// The watch over robots of motions whose contacts a collision algorithm finds. It does the same as the watch of motions
// by engines.
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

/// Data that the watches of a motion's robots share: the objects that robots can touch, and what has been reported.
struct Surroundings {
  struct Obstacle {
    std::string name;
    bool is_scenery = false;
  };
  std::map<std::uint32_t, Obstacle> obstacles;
  Host* host = nullptr;
  std::atomic<bool> depth_is_told = false;

  /// [setup]
  void connect(const Connector& c);
};

/// Returns the reason to end a run in which the pose, twist or joints of a robot are no longer possible for a body.
/// `external`: sum of the wrenches on the robot; `mass`: kg.
std::string failure_of_numbers(std::string_view robot, const Pose& pose, const Twist& twist, const Wrench& external,
                               double mass);

/// The watch over one robot. It checks the robot every `interval` steps: an unstable robot does not recover.
class RobotWatch {
 public:
  static constexpr std::uint64_t interval = 16;

  /// `velocities`: joint velocities, one per link (rad/s or m/s); null for joints that no force moves. [setup]
  RobotWatch(Connector& c, const RobotView& robot, std::span<const double* const> velocities);
  /// Finds out whether there is a contact algorithm. Reads contacts when another algorithm reads them. [setup]
  void connect_contacts(Connector& c);
  /// Starts the watch when a run begins or continues. `external`: contributions to the robot's wrench; null when
  /// nothing moves its base. [setup]
  void begin(const SumIn<Wrench>* external);
  /// Throws Error with the reason when the run must end. Logs a robot that stands too deep, once for all robots of the
  /// motion.
  void look(const Step& step, const Pose& pose, const Twist& twist, Surroundings& surroundings);

 private:
  struct Joint {
    const double* velocity;
    double reach_square;  ///< m^2, see Reach; 1 for a prismatic joint
    std::string name;
  };
  struct Overlap {
    double depth = 0;
    const std::string* obstacle = nullptr;
  };

  Overlap deepest_overlap(const Surroundings& surroundings) const;
  std::string problem(const Pose& pose, const Twist& twist, const Surroundings& surroundings);
  void tell_depth(double time, Surroundings& surroundings);
  bool is_fixed(ObjectId body) const;

  Watch watch_;
  RestingDepth resting_depth_;
  std::vector<ObjectId> fixed_;  ///< bodies that nothing moves
  ObjectId base_;
  std::string name_;
  bool begins_ = true;
  bool has_contact_law_ = false;
  ListIn<Contact> contacts_;
  std::vector<Joint> joints_;  ///< joints that forces drive
};

}  // namespace muro::watch
