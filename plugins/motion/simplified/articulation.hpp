// SPDX-License-Identifier: MIT
// A robot with joints that move its masses.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "composite_body.hpp"
#include "impact_path.hpp"
#include "move.hpp"
#include "rigid_body.hpp"

namespace muro::simplified {

class Articulation {
 public:
  /// `positions`, `velocities`: of mass.joints().
  Articulation(CompositeBody mass, std::vector<const double*> positions, std::vector<const double*> velocities)
      : mass_(std::move(mass)),
        position_sources_(std::move(positions)),
        velocity_sources_(std::move(velocities)),
        positions_(position_sources_.size(), std::numeric_limits<double>::quiet_NaN()),
        velocities_(positions_) {}

  /// Stores the mass state. Call it before the joints move.
  void begin_step() {
    update();
    before_ = state_;
    inverse_before_ = inverse_;
  }

  /// Moves the base. Call it when the joints have moved. Returns whether the new state is finite.
  bool move_base(const BatchParameters& batch, const RobotState& robot, const Wrench& external) {
    update();
    lane::Places<double, double> pose_at{{robot.pose}}, twist_at{{robot.twist}};
    lane::PoseOf<double> pose = lane::load_pose(lane::as_read(pose_at));
    lane::TwistOf<double> twist = lane::load_twist(lane::as_read(twist_at));
    integrator::move_base<true>(pose, twist, plain(external.force), plain(external.torque), mass_of(before_),
                                mass_of(state_), columns_of(0.5 * (inverse_before_ + inverse_)), columns_of(inverse_),
                                batch.mass->inverse_mass, lane::splat<double>(batch.gravity), batch.dt);
    lane::store_pose(pose_at, 0, pose);
    lane::store_twist(twist_at, 0, twist);
    const auto all = pose.position + twist.linear + twist.angular;
    return std::isfinite(all.x + all.y + all.z);
  }

  /// See simplified::correct_path. Call it after move_base.
  void correct_path(const RobotState& robot, double inverse_mass, const ImpactCorrection& impact) const {
    simplified::correct_path(robot.pose, robot.twist, mass_of(state_), columns_of(inverse_), inverse_mass, impact);
  }

 private:
  static integrator::Mass<double> mass_of(const MassState& m) {
    return {plain(m.com), plain(m.com_velocity), columns_of(m.tensor)};
  }

  /// Updates the mass state if the joint state has changed.
  void update() {
    bool same = true;
    for (std::size_t k = 0; k < position_sources_.size(); ++k) {
      same = same && positions_[k] == *position_sources_[k] && velocities_[k] == *velocity_sources_[k];
      positions_[k] = *position_sources_[k];
      velocities_[k] = *velocity_sources_[k];
    }
    if (same) return;
    state_ = mass_.state(positions_, velocities_);
    inverse_ = state_.tensor.inverse();
  }

  CompositeBody mass_;
  std::vector<const double*> position_sources_, velocity_sources_;
  std::vector<double> positions_, velocities_;  ///< the joint state that state_ belongs to
  MassState state_, before_;
  Mat3 inverse_ = Mat3::Zero(), inverse_before_ = Mat3::Zero();
};

}  // namespace muro::simplified
