// SPDX-License-Identifier: MIT
// Bodies that slide.
#include "muro/toolkit/pair_surface.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {

namespace {

const Vec3 block_size(0.2, 0.2, 0.1);

/// A block on a slope that falls along -x.
struct Slope : Trial {
  const RobotView* block_;
  double angle_;

  Slope(const std::string& motion, double angle, double friction) : Slope(motion, angle, friction, friction) {}
  Slope(const std::string& motion, double angle, double of_slope, double of_block, FrictionRule rule = {})
      : Trial(motion), angle_(angle) {
    world().set(world_object, keys::friction_rule, std::uint32_t(rule));
    add_slope(angle, of_slope);
    const Quat turn = from_rpy(0, -angle, 0);
    block_ = &add("block", conformance::block(1, block_size, of_block), {turn * Vec3(0, 0, 0.05), turn});
    start();
  }
  double speed() { return -twist(*block_).linear.dot(from_rpy(0, -angle_, 0) * Vec3::UnitX()); }
};

Outcome slides(const std::string& motion) {
  Slope s(motion, M_PI / 6, 0.3);
  s.run_for(0.5);  // it has sunk in
  const double before = s.speed();
  s.run_for(1);
  return relative(s.speed() - before, 2.3562872);
}

/// Checks a block with mu = 0.2 on a slope with 0.5, by each friction rule.
Outcome slides_by_the_rule(const std::string& motion) {
  const std::pair<FrictionRule, double> rules[] = {{FrictionRule::min, 0.2},
                                                   {FrictionRule::mean, std::sqrt(0.2 * 0.5)},
                                                   {FrictionRule::product, 0.2 * 0.5},
                                                   {FrictionRule::max, 0.5}};
  Outcome worst;
  for (const auto& [rule, friction] : rules) {
    Slope s(motion, M_PI / 6, 0.5, 0.2, rule);
    s.run_for(0.5);
    const double before = s.speed();
    s.run_for(1);
    const Outcome found = relative(s.speed() - before, g * (0.5 - friction * std::sqrt(0.75)));
    if (found.error > worst.error) worst = found;
  }
  return worst;
}

Outcome sticks(const std::string& motion) {
  Slope s(motion, M_PI / 6, 0.6);  // tan 30 deg = 0.577
  s.run_for(1);
  const Vec3 before = s.pose(*s.block_).position;
  s.run_for(5);
  const double creep = (s.pose(*s.block_).position - before).norm() / 5;
  return {creep, text(creep) + " m/s"};
}

/// Checks a block pushed along the diagonal of its sides. Friction could hold it only if its limit were not a circle.
Outcome cone(const std::string& motion) {
  Trial t(motion);
  t.add_ground(0.5);
  const RobotView& r = t.add("block", block(1, {0.4, 0.4, 0.05}, 0.5), {{0, 0, 0.025}, Quat::Identity()});
  Wrench& w = t.push(r);
  t.start();
  t.run_for(0.5);
  const double force = 1.15 * 0.5 * g;
  w = {{force * M_SQRT1_2, force * M_SQRT1_2, 0}, Vec3::Zero()};
  const Vec3 before = t.twist(r).linear;
  t.run_for(0.5);
  const double seen = (t.twist(r).linear - before).dot(Vec3(M_SQRT1_2, M_SQRT1_2, 0)) / 0.5 / g;
  return {std::abs(seen - 0.15 * 0.5), text(seen) + " g for 0.075 g"};
}

Outcome straight(const std::string& motion) {
  Trial t(motion);
  t.add_ground(0.5);
  const RobotView& r = t.add("block", block(1, {0.4, 0.4, 0.05}, 0.5), {{0, 0, 0.025}, Quat::Identity()});
  Wrench& w = t.push(r);
  t.start();
  t.run_for(0.5);
  const Vec3 along(std::cos(0.4), std::sin(0.4), 0);
  w = {2 * 0.5 * g * along, Vec3::Zero()};
  const Vec3 before = t.pose(r).position;
  t.run_for(0.5);
  const Vec3 way = t.pose(r).position - before;
  const double angle = std::abs(std::atan2(way.y(), way.x()) - 0.4);
  return {angle, text(std::atan2(way.y(), way.x())) + " for 0.4"};
}

/// Checks the way of a block until it stops: v^2 / (2 mu g).
Outcome stops(const std::string& motion) {
  Trial t(motion);
  t.add_ground(0.4);
  const RobotView& r = t.add("block", block(1, block_size, 0.4), {{0, 0, 0.05}, Quat::Identity()});
  Wrench& w = t.push(r);
  t.start();
  t.run_for(0.5);
  const double start = t.pose(r).position.x();
  w = {{2000, 0, 0}, Vec3::Zero()};
  t.run_for(0.001);
  w = {};
  const double v = t.twist(r).linear.x();
  t.run_for(2);
  return relative(t.pose(r).position.x() - start, v * v / (2 * 0.4 * g));
}

}  // namespace

std::vector<Case> slope_cases() {
  constexpr Features needs = feature_contact | feature_friction;
  return {
      {"a block slides down 30 deg with g (sin - mu cos)", "relative", needs, 1e-3, slides},
      {"a block slides by the world's rule for the friction of a pair", "relative", needs, 5e-3, slides_by_the_rule},
      {"a block holds on 30 deg when tan is below mu", "m/s", needs, 1e-6, sticks},
      {"friction is the same along the diagonal", "g", needs, 5e-3, cone},
      {"a pushed block moves along the push", "rad", needs, 0.01, straight},
      {"a sliding block stops after v^2 / (2 mu g)", "relative", needs, 0.01, stops},
  };
}

}  // namespace muro::conformance
