// SPDX-License-Identifier: MIT
#include "motion.hpp"

#include <cmath>

#include "muro/toolkit/mass_properties.hpp"
#include "muro/toolkit/random.hpp"
#include "parameters.hpp"
#include "plugins/common/contact_geometry/contact_responsibility.hpp"

namespace muro::multibody {

namespace {

/// m, rad, m/s, rad/s: engines that fail get here on their way to infinity, and may stay.
constexpr double beyond_all_bounds = 1e12;

// Layout of Robot::last: whether the rest counts, pose, twist, then position and velocity of each part's joint.
constexpr std::size_t valid = 0, last_pose = 1, last_twist = 8, last_joints = 14;

std::string quoted(std::string_view name) { return "`" + std::string(name) + "`"; }

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

void Motion::connect(Connector& c) {
  const Parameters& p = c.parameters();
  check_parameters(c);
  gravity_ = c.constant(world_object, keys::gravity).value_or(Vec3(0, 0, -9.81));
  position_gain_ = p.real(position_gain.name);
  substeps_ = int(p.integer(substeps.name));
  number_ = number_of_world(fnv1a(p.text(world_name.name), fnv1a(description().id)));
  configure(c);
  for (std::uint32_t i = 0; i < c.items().size(); ++i) connect_robot(c, c.items()[i], c.parameters_of(i));
  connect_others(c);

  std::string mended;
  for (const Robot& r : robots_)
    for (const std::string& link : r.model.mended)
      if (mended.size() < 500) mended += " " + link;
  if (!mended.empty())
    c.host().log(
        LogLevel::info,
        std::string(description().id) +
            ": no engine moves bodies without mass and inertia, or with a moment of inertia that exceeds the sum "
            "of the two others; what they lack was added to:" +
            mended);
}

void Motion::check_parameters(const Connector& c) const {
  for (std::uint32_t i = 1; i < c.items().size(); ++i)
    for (const Parameter& p : description().parameters)
      if (!is_of_robot(p.name) && !equal(p, c.parameters(), c.parameters_of(i)))
        throw Error(quoted(c.items()[0].robot->name) + " and " + quoted(c.items()[i].robot->name) +
                    " are in one world but set " + quoted(p.name) +
                    " differently; set it alike, or give one of them another `world`");
}

void Motion::connect_robot(Connector& c, const Item& item, const Parameters& p) {
  const RobotView& view = *item.robot;
  Robot& r = robots_.emplace_back();
  r.model = model_of(c, view, drive_modes_of(c, view, p), inertia_floor());
  r.model.fixed_base = p.text(base_mode.name) == "fixed";
  r.model.self_collision = p.boolean(self_collision.name);
  check(r.model);

  const std::size_t parts = r.model.parts.size();
  r.state.joints.resize(parts);
  r.state.external.resize(parts);
  r.state.contact.resize(r.model.bodies.size());
  r.parts.resize(parts);
  r.level = item.level;
  r.active_level = c.input(view.base(), keys::motion_level, std::uint32_t{0});
  r.contact_world = c.variable(view.base(), keys::contact_world, number_);
  r.twist_lag = c.variable(view.base(), keys::twist_lag, 0.5 / substeps_);
  r.pose = c.variable(view.base(), keys::pose, c.constant(view.base(), keys::initial_pose).value_or(Pose{}));
  const Twist moving = c.constant(view.base(), keys::initial_twist).value_or(Twist{});
  r.twist = c.variable(view.base(), keys::twist, r.model.fixed_base ? Twist{} : moving);
  connect_joints(c, view, r);
  connect_touched(c, view, r);

  const std::size_t own = last_joints + 2 * parts, engine = memory_of(r.model);
  const bool shares = !c.constant_array(view.base(), keys::motion_level_names).empty();
  const std::string name = std::string(description().id) + (shares ? "." + std::to_string(item.level) : "");
  auto* block = static_cast<double*>(c.state_block(view.base(), name, std::uint32_t((own + engine) * sizeof(double))));
  r.last = {block, own};
  r.state.memory = {block + own, engine};
}

void Motion::connect_joints(Connector& c, const RobotView& view, Robot& r) const {
  r.joints.resize(r.model.parts.size());
  for (std::size_t i = 1; i < r.joints.size(); ++i) {
    const Part& part = r.model.parts[i];
    const ObjectId object = view.links[part.frame].joint_object;
    const double start = r.model.start_positions[i];
    check_start(c, object, part.limits, start);
    Joint& j = r.joints[i];
    j.position = c.variable(object, keys::joint_position, start);
    j.velocity = c.variable(object, keys::joint_velocity, 0.0);
    j.effort = c.derived(object, keys::joint_effort);
    if (part.leader >= 0) continue;
    switch (part.drive) {
      case DriveMode::velocity:
        j.target = c.input(object, keys::joint_velocity_target, 0.0);
        break;
      case DriveMode::position:
        j.target = c.input(object, keys::joint_position_target, start);
        break;
      case DriveMode::effort:
        j.target = c.input(object, keys::joint_effort_target, 0.0);
        break;
      case DriveMode::acceleration:
      case DriveMode::passive:
        break;
    }
  }
}

void Motion::connect_touched(Connector& c, const RobotView& view, Robot& r) const {
  for (const TouchedBody& body : r.model.bodies) {
    const ObjectId object = view.links[body.frame].object;
    Touched& t = r.touched.emplace_back();
    t.external = c.read_sum(object, keys::external_wrench);
    if (body.shaped) t.contact = c.derived(object, keys::contact_wrench);
  }
}

void Motion::connect_others(Connector& c) {
  std::vector<bool> own(c.robots().size());
  for (const Item& item : c.items()) {
    own[item.robot->number] = true;
    if (const auto original = c.constant(item.robot->base(), keys::shadow_of))  // it is in its own place
      own[std::size_t(c.robot_of(*original))] = true;
  }
  const auto shapes_of = [&](ObjectId object) {
    std::vector<PartShape> shapes;
    for (const Shape& s : c.constant_array(object, keys::collision_shapes)) shapes.push_back({s, 0});
    return shapes;
  };
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    const ObjectId object{i};
    if (c.robot_of(object) >= 0) continue;
    Fixture f{std::string(c.object_name(object)), shapes_of(object), {}};
    if (f.shapes.empty()) continue;
    f.pose = c.constant(object, keys::pose).value_or(Pose{});
    scenery_.push_back(std::move(f));
  }
  for (const RobotView* robot : c.robots()) {
    if (own[robot->number] || c.constant(robot->base(), keys::shadow_of)) continue;
    for (const Link& f : robot->links) {
      Fixture fixture{std::string(c.object_name(f.object)), shapes_of(f.object), {}};
      if (fixture.shapes.empty()) continue;
      Other& o = others_.emplace_back();
      o.fixture = std::move(fixture);
      o.pose = c.read(f.object, keys::pose);
      o.twist = c.read(f.object, keys::twist);
      o.contact_world = c.input(robot->base(), keys::contact_world, std::uint64_t{0});
    }
  }
}

void Motion::start() {
  world_ = make_world();
  for (const Fixture& f : scenery_) world_->add_scenery(f);
  for (Other& o : others_) {
    import(o);
    world_->add_obstacle(o.fixture, o.state);
  }
  for (Robot& r : robots_) {
    import(r);
    world_->add_robot(r.model, r.state);
  }
  world_->complete();
}

void Motion::on_handover(std::uint32_t item) {
  Robot& r = robots_[item];
  *r.contact_world = number_;
  *r.twist_lag = 0.5 / substeps_;
  r.last[valid] = 0;
  if (r.model.fixed_base) *r.twist = Twist{};
}

void Motion::step(const Step& step, Range) {
  for (Robot& r : robots_) import(r);
  for (Other& o : others_) import(o);
  const double dt = step.dt / substeps_;
  for (int i = 0; i < substeps_; ++i) {
    for (Robot& r : robots_) set_demands(r, dt);
    world_->advance(dt);
    for (Robot& r : robots_) r.state.moved_from_outside = false;
  }
  for (Robot& r : robots_)
    if (r.state.presence == Presence::simulated) export_robot(r);
}

void Motion::import(Other& o) {
  o.state.presence = is_moved_by_forces(*o.contact_world) ? Presence::absent : Presence::obstacle;
  o.state.pose = *o.pose;
  o.state.twist = *o.twist;
}

void Motion::import(Robot& r) const {
  RobotState& s = r.state;
  s.presence = *r.active_level == r.level             ? Presence::simulated
               : is_moved_by_forces(*r.contact_world) ? Presence::absent
                                                      : Presence::obstacle;
  s.pose = *r.pose;
  s.twist = *r.twist;
  for (std::size_t i = 1; i < r.joints.size(); ++i) {
    s.joints[i].position = *r.joints[i].position;
    s.joints[i].velocity = *r.joints[i].velocity;
  }
  if (s.presence != Presence::simulated) {
    if (r.last[valid] != 0 && !is_in_world(*r.contact_world)) clear_outputs(r);
    r.last[valid] = 0;
    return;
  }
  bool same = r.last[valid] != 0;
  const double *pose = r.last.data() + last_pose, *twist = r.last.data() + last_twist;
  for (int k = 0; k < 3; ++k)
    same = same && s.pose.position[k] == pose[k] && s.twist.linear[k] == twist[k] && s.twist.angular[k] == twist[3 + k];
  for (int k = 0; k < 4; ++k) same = same && s.pose.orientation.coeffs()[k] == pose[3 + k];
  const double* joints = r.last.data() + last_joints;
  for (std::size_t i = 1; i < r.joints.size(); ++i)
    same = same && s.joints[i].position == joints[2 * i] && s.joints[i].velocity == joints[2 * i + 1];
  s.moved_from_outside = !same;

  import_wrenches(r);
}

/// Another motion has taken the robot over, which does not write them.
void Motion::clear_outputs(const Robot& r) {
  for (const Touched& t : r.touched)
    if (t.contact) *t.contact = Wrench{};
  for (std::size_t i = 1; i < r.joints.size(); ++i) *r.joints[i].effort = 0;
}

void Motion::import_wrenches(Robot& r) {
  RobotState& s = r.state;
  s.applied = false;
  for (const Touched& t : r.touched)
    for (std::uint64_t k = 0; k < t.external.size(); ++k) {
      const Wrench& w = *t.external.contribution(k);
      s.applied = s.applied || !w.force.isZero(0) || !w.torque.isZero(0);
    }
  for (Wrench& w : s.external) w = Wrench{};
  if (!s.applied) return;
  place_parts(r.model, s, r.parts);
  for (std::size_t i = 0; i < r.touched.size(); ++i) {
    const Place& place = r.model.bodies[i].place;
    const Wrench w = r.touched[i].external.value();
    Wrench& sum = s.external[place.part];
    sum.add_force(w.force, r.parts[place.part].pose.orientation * place.pose.position);
    sum.torque += w.torque;
  }
}

/// What drives aim at, within the limits of the model.
void Motion::set_demands(Robot& r, double dt) const {
  const double gain = std::min(position_gain_, 1 / dt);
  for (std::size_t i = 1; i < r.joints.size(); ++i) {
    const Part& part = r.model.parts[i];
    const JointLimits& limits = part.limits;
    JointState& joint = r.state.joints[i];
    Demand& d = joint.demand;
    d = {};
    d.most = limits.effort;
    if (part.leader >= 0) {
      const JointState& leader = r.state.joints[std::size_t(part.leader)];
      d.by_speed = true;
      d.speed =
          part.multiplier * leader.velocity + gain * (part.offset + part.multiplier * leader.position - joint.position);
      continue;
    }
    switch (part.drive) {
      case DriveMode::velocity:
        d.by_speed = true;
        d.speed = std::clamp(*r.joints[i].target, -limits.velocity, limits.velocity);
        break;
      case DriveMode::position: {
        d.by_speed = true;
        const double target = std::clamp(*r.joints[i].target, limits.lower, limits.upper);
        d.speed = std::clamp(gain * (target - joint.position), -limits.velocity, limits.velocity);
        break;
      }
      case DriveMode::effort:
        d.effort = std::clamp(*r.joints[i].target, -limits.effort, limits.effort);
        break;
      case DriveMode::acceleration:
      case DriveMode::passive:
        break;
    }
  }
}

/// So that a change from outside is seen.
void Motion::remember(Robot& r) {
  const RobotState& s = r.state;
  r.last[valid] = 1;
  std::copy_n(s.pose.position.data(), 3, r.last.data() + last_pose);
  std::copy_n(s.pose.orientation.coeffs().data(), 4, r.last.data() + last_pose + 3);
  std::copy_n(s.twist.linear.data(), 3, r.last.data() + last_twist);
  std::copy_n(s.twist.angular.data(), 3, r.last.data() + last_twist + 3);
  for (std::size_t i = 1; i < r.joints.size(); ++i) {
    r.last[last_joints + 2 * i] = s.joints[i].position;
    r.last[last_joints + 2 * i + 1] = s.joints[i].velocity;
  }
}

void Motion::export_robot(Robot& r) const {
  const RobotState& s = r.state;
  double all = s.pose.position.lpNorm<1>() + s.twist.linear.lpNorm<1>() + s.twist.angular.lpNorm<1>();
  *r.pose = s.pose;
  *r.twist = s.twist;
  for (std::size_t i = 1; i < r.joints.size(); ++i) {
    const JointState& j = s.joints[i];
    *r.joints[i].position = j.position;
    *r.joints[i].velocity = j.velocity;
    *r.joints[i].effort = j.effort;
    all += std::abs(j.position) + std::abs(j.velocity);
  }
  if (!(all < beyond_all_bounds))
    throw Error("the motion of " + quoted(r.model.name) +
                " is no longer finite: forces grow from step to step; raise the rate or `substeps`, or look at what "
                "commands its joints and at masses of its links that differ much");
  export_contacts(r);
  remember(r);
}

void Motion::export_contacts(Robot& r) {
  bool placed = false;
  for (std::size_t i = 0; i < r.touched.size(); ++i) {
    if (!r.touched[i].contact) continue;
    Wrench w = r.state.contact[i];
    const Place& place = r.model.bodies[i].place;
    if (!place.pose.position.isZero(0) && !w.force.isZero(0)) {
      if (!placed) place_parts(r.model, r.state, r.parts);
      placed = true;
      w.torque -= Vec3(r.parts[place.part].pose.orientation * place.pose.position).cross(w.force);
    }
    *r.touched[i].contact = w;
  }
}

}  // namespace muro::multibody
