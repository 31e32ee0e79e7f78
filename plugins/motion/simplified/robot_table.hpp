// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "applied_wrenches.hpp"
#include "model.hpp"
#include "plugins/common/contact_geometry/impact_input.hpp"
#include "plugins/motion/common/motion/contact_role.hpp"

namespace muro::simplified {

/// A robot: what steps seldom need.
struct Robot {
  std::string name;
  Inertia inertia;                        ///< of all its bodies at the start, in the frame of the base
  std::vector<DriveMode> modes;           ///< of its joints, one a link
  std::optional<SumIn<Wrench>> external;  ///< none: no wrench moves it
  ContactRole contact_role;
  AppliedWrenches applied;
  std::uint32_t first_other_contribution = 0;  ///< in RobotTable::other_contributions
  std::int32_t articulation = -1;              ///< index of its articulation; -1: no joint moves mass
  std::int32_t force_driven = -1;              ///< index of its force-driven joints; -1: no force drives a joint

  const SumIn<Wrench>* wrenches() const { return external ? &*external : nullptr; }
};

/// The robots of a motion, a row each. Columns that each step reads lie side by side: kernels take eight rows at a
/// time.
struct RobotTable {
  /// What robots that move together have in common.
  struct Kind {
    std::uint32_t model = 0;
    std::uint32_t wrenches = 0;  ///< contributions to the external wrench
    bool operator==(const Kind&) const = default;
  };

  std::vector<Robot> robots;
  std::vector<Kind> kinds;
  std::array<std::vector<RobotState>, 3> layers;  ///< by group of joints; the first has the base, too
  std::vector<contact_geometry::ImpactInput> impacts;
  std::vector<Wrench> totals;                      ///< of robots with force-driven joints: what acts in this step
  std::vector<const double*> other_contributions;  ///< to wrenches, all but the first of each robot

  std::uint32_t size() const { return std::uint32_t(robots.size()); }
  void resize(std::size_t rows) {
    robots.resize(rows), kinds.resize(rows), impacts.resize(rows), totals.resize(rows);
    for (std::vector<RobotState>& layer : layers) layer.resize(rows);
  }

  /// Finds the contributions to the wrench of each robot: all are known when a run begins. [setup]
  void find_contributions() {
    other_contributions.clear();
    totals.assign(robots.size(), Wrench{});
    for (std::size_t i = 0; i < robots.size(); ++i) {
      Robot& r = robots[i];
      r.first_other_contribution = std::uint32_t(other_contributions.size());
      kinds[i].wrenches = 0;
      if (r.force_driven >= 0) {
        kinds[i].wrenches = 1;
        layers[0][i].wrench = lane::numbers(&totals[i]);
      } else if (r.external) {
        kinds[i].wrenches = std::uint32_t(r.external->size());
        layers[0][i].wrench = r.external->size() > 0 ? lane::numbers(r.external->contribution(0)) : nullptr;
        for (std::uint64_t k = 1; k < r.external->size(); ++k)
          other_contributions.push_back(lane::numbers(r.external->contribution(k)));
      }
    }
  }

  Pose pose(std::uint32_t i) const {
    const double* const p = layers[0][i].pose;
    return {Vec3(p[0], p[1], p[2]), Quat(p + 3)};
  }
  Twist twist(std::uint32_t i) const {
    const double* const v = layers[0][i].twist;
    return {Vec3(v[0], v[1], v[2]), Vec3(v[3], v[4], v[5])};
  }
};

}  // namespace muro::simplified
