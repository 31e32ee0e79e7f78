// SPDX-License-Identifier: MIT
// The joints of one robot that forces move: those in mode effort and passive, and others whose effort is limited.
#pragma once

#include "dof.hpp"
#include "joint_places.hpp"
#include "linkage.hpp"

namespace muro::simplified {

class ForcedJoints {
 public:
  struct Settings {
    bool fixed_base = false;
    double acceleration = 0;  ///< rad/s^2 or m/s^2: most of joints that follow targets
    double armature = 0;      ///< kg m^2 or kg: adds to the inertia of every joint here
  };
  /// `places`, `inertias`, `start`: one a frame. Throws Error for a joint without inertia. [setup]
  ForcedJoints(Connector& c, const RobotView& robot, std::span<const Place> places, std::span<const Inertia> inertias,
               std::span<const double> start, const Settings& settings);

  /// Looks at what acts on the robot, before anything moves; returns it as one wrench on the base. `dt`: s.
  Wrench look(const Pose& pose, const Twist& twist, const Vec3& gravity, double dt);
  /// Moves the joints as seen by `look`. Whether their state is finite.
  bool move(double dt);

 private:
  struct Follower {
    double* position;
    double* velocity;
    double multiplier, offset;
  };
  struct Joint {
    Place place;
    JointLimits limits;    ///< damping and friction: with those of followers
    double least_inertia;  ///< kg m^2 or kg: what remains of the inertia, however the robot folds
    Out<double> effort;
    std::vector<Follower> followers;
  };
  struct Turn {
    const double* position;
    const double* velocity;
    std::uint32_t frame;
  };

  Settings settings_;
  Linkage linkage_;
  std::vector<Joint> joints_;      ///< as linkage_.dofs()
  std::vector<Turn> turns_;        ///< all joints of the robot
  std::vector<double> positions_;  ///< in the middle of the step, one a frame
};

}  // namespace muro::simplified
