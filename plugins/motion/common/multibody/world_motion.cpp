// SPDX-License-Identifier: MIT
#include "world_motion.hpp"

#include <algorithm>
#include <cmath>

#include "engine_parameters.hpp"
#include "muro/base/random.hpp"
#include "plugins/common/contact_geometry/contact_responsibility.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::multibody {

namespace {

bool equal(const Parameter& p, const Parameters& a, const Parameters& b) {
  const auto same = [](auto x, auto y) { return std::equal(x.begin(), x.end(), y.begin(), y.end()); };
  switch (p.type) {
    case ParameterType::text:
      return a.text(p.name) == b.text(p.name);
    case ParameterType::reals:
      return same(a.reals(p.name), b.reals(p.name));
    case ParameterType::texts:
      return same(a.texts(p.name), b.texts(p.name));
    default:
      return a.real(p.name) == b.real(p.name);
  }
}

}  // namespace

void WorldMotion::connect(Connector& c) {
  const Parameters& p = c.parameters();
  check_parameters(c);
  gravity_ = c.constant(world_object, keys::gravity).value_or(Vec3(0, 0, -9.81));
  friction_rule_ = friction_rule_of(c);
  mimic_gain_ = p.real(mimic_gain.name);
  substeps_ = int(p.integer(substeps.name));
  traits_.motion = description().id;
  traits_.contact_world = number_of_world(fnv1a(p.text(world_name.name), fnv1a(description().id)));
  traits_.twist_lag = 0.5 / substeps_;
  traits_.couples_mimics = couples_mimics();
  configure(c);
  traits_.advice = advice();  // depends on what configure() has read
  for (std::uint32_t i = 0; i < c.items().size(); ++i) connect_robot(c, c.items()[i], c.parameters_of(i));
  std::vector<bool> own(c.items().size());
  for (std::size_t i = 0; i < own.size(); ++i) own[i] = served_[i].by_world != nullptr;
  if (!robots_.empty()) external_bodies_.connect(c, own);
  if (!has_own_inertias()) report_regularized_links(c);
  if (!traits_.couples_mimics) report_mimic_joints(c);
  report_kinematic_robots(c);
}

void WorldMotion::bind_by_name(Connector& c) {
  for (std::uint32_t i = 0; i < c.items().size(); ++i) {
    WorldRobot* const robot = served_[i].by_world;
    if (!robot) continue;
    const RobotView& view = *c.items()[i].robot;
    robot->set_has_contact_law(c.is_used(view.base(), keys::contact_wrenches_of_law, usage::derived));
    robot->connect_by_name(c, view, c.parameters_of(i));
  }
}

MovedBase WorldMotion::moved_base(std::uint32_t item) const {
  const WorldRobot* const robot = served_[item].by_world;
  if (!robot || robot->model().fixed_base) return {.keeps_applied = robot != nullptr};
  return {BaseMotion::by_forces, robot->model().bodies.front().inertia, true};
}

void WorldMotion::check_parameters(const Connector& c) const {
  for (std::uint32_t i = 1; i < c.items().size(); ++i)
    for (const Parameter& p : description().parameters)
      if (!is_of_robot(p.name) && !equal(p, c.parameters(), c.parameters_of(i)))
        throw Error(quote(c.items()[0].robot->name) + " and " + quote(c.items()[i].robot->name) +
                    " are in one world but set " + quote(p.name) +
                    " differently; set it alike, or give one of them another `world`");
}

void WorldMotion::connect_robot(Connector& c, const Item& item, const Parameters& p) {
  const RobotView& view = *item.robot;
  if (KinematicRobot::is_one(c, view, p)) {
    served_.push_back({nullptr, &kinematic_robots_.emplace_back(c, view, p, item.level)});
    return;
  }
  RobotModel model = model_of(c, view, drive_modes_of(c, view, p), min_inertia());
  model.fixed_base = p.text(base_mode.name) == "fixed";
  model.self_collision = p.boolean(self_collision.name);
  const std::size_t engine_memory = memory_of(model);
  WorldRobot& robot = robots_.emplace_back(std::move(model), item.level);
  robot.connect(c, view, p, traits_, engine_memory);
  served_.push_back({&robot, nullptr});
}

void WorldMotion::report_kinematic_robots(Connector& c) const {
  std::vector<const KinematicRobot*> by_targets;
  for (const Served& s : served_) by_targets.push_back(s.by_targets);
  tell_of(c, by_targets);
}

void WorldMotion::report_regularized_links(const Connector& c) const {
  std::vector<std::string_view> links;
  for (const WorldRobot& r : robots_)
    links.insert(links.end(), r.model().regularized_links.begin(), r.model().regularized_links.end());
  if (links.empty()) return;
  c.host().log(
      LogLevel::info,
      std::string(description().id) +
          ": no engine moves bodies without mass and inertia, those that touch others with hardly any, or those "
          "with a moment of inertia that exceeds the sum of the two others; what they lack was added to " +
          quoted_list(links) + "; give them an `inertial` that fits");
}

void WorldMotion::report_mimic_joints(const Connector& c) const {
  std::vector<std::string_view> joints;
  for (const Served& s : served_) {
    if (!s.by_world) continue;
    const RobotView& view = *c.items()[std::size_t(&s - served_.data())].robot;
    for (const RigidBody& body : s.by_world->model().bodies)
      if (body.leader >= 0) joints.push_back(c.object_name(view.links[body.link].joint_object));
  }
  if (joints.empty()) return;
  c.host().log(LogLevel::info, std::string(description().id) +
                                   ": each mimic joint has a drive of its own that follows "
                                   "its leader, and what it carries does not load the leader: " +
                                   quoted_list(joints) +
                                   "; motion.bullet, motion.mujoco and motion.articulated couple "
                                   "the two");
}

void WorldMotion::start() {
  if (robots_.empty()) return;
  world_ = make_world();
  external_bodies_.add_to(*world_);
  for (WorldRobot& r : robots_) {
    r.begin_watch();
    r.import();
    try {
      world_->add_robot(r.model(), r.state());
    } catch (const Error& error) {
      throw Error(quote(r.model().name) + " is no robot for " + std::string(description().id) + ": " + error.what() +
                  "; look at the masses, inertias, sizes and joints of its model");
    }
  }
  world_->complete();
}

void WorldMotion::on_handover(std::uint32_t item) {
  if (served_[item].by_world)
    served_[item].by_world->take_over();
  else
    served_[item].by_targets->take_over();
}

void WorldMotion::move(const Step& step, Range) {
  if (!robots_.empty()) step_world(step);
  for (const KinematicRobot& r : kinematic_robots_) r.step(step.dt);
}

/// Whether this motion moves the robot at present.
bool WorldMotion::moves(std::uint32_t item) const {
  const Served& s = served_[item];
  return s.by_world ? s.by_world->is_dynamic() : s.by_targets->is_active();
}

void WorldMotion::step_world(const Step& step) {
  for (WorldRobot& r : robots_) r.import();
  external_bodies_.import();
  const double dt = step.dt / substeps_;
  const double gain = std::min(mimic_gain_, 1 / dt);
  for (int i = 0; i < substeps_; ++i) {
    for (WorldRobot& r : robots_) r.set_drive_targets(traits_, dt, gain);
    advance(dt);
    for (WorldRobot& r : robots_) {
      r.add_contacts(substeps_);
      r.state().moved_from_outside = false;
    }
  }
  for (WorldRobot& r : robots_)
    if (r.is_dynamic()) r.export_state();
}

/// When an engine fails without naming a robot, it has mostly failed at the robot that is nearest to its limits.
void WorldMotion::advance(double dt) {
  try {
    world_->advance(dt);
  } catch (const RobotFailure& failure) {
    for (const WorldRobot& r : robots_)
      if (&r.state() == failure.robot()) throw Error(r.failure_text(failure.what()));
    throw;
  } catch (const Error& error) {
    const auto wildest = std::max_element(robots_.begin(), robots_.end(), [](const WorldRobot& a, const WorldRobot& b) {
      return a.wildness() < b.wildness();
    });
    throw Error(wildest->failure_text(error.what()));
  }
}

}  // namespace muro::multibody
