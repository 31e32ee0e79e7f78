// SPDX-License-Identifier: MIT
// Report of the contact algorithm on impacts within the last step.
#pragma once

#include "muro/algorithm.hpp"
#include "muro/vocabulary/contact.hpp"

namespace muro::contact_geometry {

/// Input of a robot whose impacts act at their instant; by default it has none.
class ImpactInput {
 public:
  ImpactInput() = default;
  /// Reports to the contact algorithm that the motion corrects the path of `robot`. [setup]
  ImpactInput(Connector& c, const RobotView& robot)
      : time_(c.input(robot.base(), keys::impact_time, std::int64_t{0})),
        correction_(c.input(robot.base(), keys::impact, ImpactCorrection{})),
        step_(c.variable(robot.base(), keys::impact_step, 0.0)) {}

  /// Reports the length of the step. Returns the changes of impacts in it; null for none.
  const ImpactCorrection* begin_step(const Step& step) const {
    if (!time_) return nullptr;
    if (*step_ != step.dt) *step_ = step.dt;
    return *time_ != step.time || correction_->path.isZero(0) ? nullptr : correction_.get();
  }

 private:
  In<std::int64_t> time_;
  In<ImpactCorrection> correction_;
  Out<double> step_;
};

}  // namespace muro::contact_geometry
