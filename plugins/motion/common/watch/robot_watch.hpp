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

/// What the watches over the robots of a motion share: what these can touch, by object, and what has been told.
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
  /// Throws Error, which says why the run ends. Says, once for all robots of the motion, that it stands too deep.
  void look(const Step& step, const Pose& pose, const Twist& twist, Surroundings& surroundings);

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
  std::vector<Joint> joints_;  ///< those that forces drive
};

}  // namespace muro::watch
