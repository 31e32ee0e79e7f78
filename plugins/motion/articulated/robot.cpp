// SPDX-License-Identifier: MIT
#include "robot.hpp"

#include <algorithm>
#include <cmath>

#include "muro/base/random.hpp"
#include "muro/simd/numbers.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "muro/vocabulary/contact.hpp"
#include "plugins/common/contact_geometry/contact_responsibility.hpp"
#include "plugins/common/contact_geometry/impact_path.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/motion/common/multibody/engine_parameters.hpp"
#include "plugins/motion/common/position_drive/joint_target.hpp"
#include "plugins/motion/common/position_drive/settled_modes.hpp"
#include "plugins/motion/common/watch/robot_watch.hpp"

namespace muro::articulated {

namespace {

constexpr std::string_view id = "motion.articulated";

constexpr Drive drive_of(DriveMode mode) {
  switch (mode) {
    case DriveMode::velocity:
      return Drive::velocity;
    case DriveMode::position:
      return Drive::position;
    case DriveMode::acceleration:
      return Drive::acceleration;
    case DriveMode::effort:
      return Drive::effort;
    case DriveMode::passive:
      break;
  }
  return Drive::passive;
}

/// Returns the distance of `place` from the first such place of the robot. If there is none so far, `place` is the
/// first.
template <class T>
std::ptrdiff_t offset_from(T*& first, T* place) {
  if (!first) first = place;
  return lane::numbers_between(first, place);
}

}  // namespace

Robot::Robot(Connector& c, const RobotView& view, const Parameters& p, std::uint32_t level)
    : level_(level), rigid_(multibody::model_of(c, view, drive_modes_of(c, view, p), {})) {
  rigid_.fixed_base = p.text("base") == "fixed";
  model_ = model_of_bodies(rigid_);
  masses_ = masses_of_bodies(rigid_);
  contact_role_ = ContactRole(c, view.base(), number_of_world(fnv1a(view.name, fnv1a(id))));
  carried_mass_ = c.input(view.base(), keys::carried_mass, 0.0);
  pose_ = c.variable(view.base(), keys::pose, c.constant(view.base(), keys::initial_pose).value_or(Pose{}));
  const Twist initial_twist = c.constant(view.base(), keys::initial_twist).value_or(Twist{});
  twist_ = c.variable(view.base(), keys::twist, rigid_.fixed_base ? Twist{} : initial_twist);
  told_ = c.derived_list(view.base(), keys::contact_wrenches_of_motion);
  connect_joints(c, view, p);
  connect_links(c);
  connect_memory(c, view, p.text("integrator") != "rk4");
  contacts_ = RobotContacts(c, view, rigid_);
  connect_self_contacts(c, view, p);
  if (rigid_.bodies.size() == 1 && !rigid_.fixed_base) impacts_ = contact_geometry::ImpactInput(c, view);
}

void Robot::connect_joints(Connector& c, const RobotView& view, const Parameters& p) {
  std::vector<bool> is_open;
  drive_modes_of(c, view, p, &is_open);
  const std::size_t count = rigid_.bodies.size();
  velocities_.resize(view.links.size());
  joints_.resize(count), positions_out_.resize(count), velocities_out_.resize(count), efforts_out_.resize(count);
  int mimics = 0;
  for (std::size_t i = 1; i < count; ++i) {
    const multibody::RigidBody& body = rigid_.bodies[i];
    const ObjectId object = view.links[body.link].joint_object;
    const double start = rigid_.initial_positions[i];
    check_start(c, object, body.limits, start);
    joints_[i].object = object;
    joints_[i].name = c.object_name(object);
    positions_out_[i] = c.variable(object, keys::joint_position, start);
    velocities_out_[i] = c.variable(object, keys::joint_velocity, 0.0);
    efforts_out_[i] = c.derived(object, keys::joint_effort);
    velocities_[body.link] = velocities_out_[i].get();
    mimics += body.leader >= 0 ? 1 : 0;
    if (body.leader == 0)
      throw Error(quote(c.object_name(object)) + " mimics a joint that is fixed; let it mimic one that moves");
    if (body.leader >= 0) continue;
    Joint& joint = model_.joints[i];
    joint.drive = drive_of(body.drive);
    joints_[i].target = connect_joint_target(c, object, body.drive, start);
    if (joint.drive == Drive::position || is_open[body.link])
      joints_[i].position_target = PositionTarget(object, joints_[i].target.get(), p.real(interpolate.name));
  }
  if (mimics > most_mimics)
    throw Error(quote(rigid_.name) + " has " + std::to_string(mimics) + " mimic joints; " + std::string(id) +
                " moves robots with up to " + std::to_string(most_mimics) + " of them");
}

/// Connects drives, when it is known which properties algorithms command.
void Robot::connect_drives(Connector& c, const RobotView& view, const Parameters& p) {
  const std::vector<DriveMode> modes = settled_modes(c, view, p);
  const std::vector<PositionDrive> drives = position_drives_of(c, view, modes, p);
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    multibody::RigidBody& body = rigid_.bodies[i];
    const bool is_settled = body.drive != modes[body.link];
    body.drive = modes[body.link];
    if (body.leader >= 0) continue;
    Joint& joint = model_.joints[i];
    if (is_settled)
      joints_[i].target = connect_joint_target(c, joints_[i].object, body.drive, rigid_.initial_positions[i]);
    joint.drive = drive_of(body.drive);
    if (joint.drive != Drive::position) continue;
    const PositionDrive& drive = drives[body.link];
    joint.natural_frequency = drive.natural_frequency;
    joint.stiffness = drive.stiffness.value_or(-1);
    joint.drive_damping = drive.damping.value_or(-1);
    joints_[i].position_target.follow(joints_[i].target.get());
  }
}

void Robot::connect_links(Connector& c) {
  for (const multibody::LoadedLink& loaded : rigid_.loaded_links) {
    LoadedLink& link = links_.emplace_back();
    link.external = c.read_sum(loaded.object, keys::external_wrench);
    if (loaded.has_shapes) link.contact = c.derived(loaded.object, keys::contact_wrench);
    link.is_body = loaded.link == rigid_.bodies[loaded.placement.body].link;
  }
  wrenches_.resize(6 * rigid_.bodies.size());
}

/// Connects the memory of interpolated targets and of the integrator.
void Robot::connect_memory(Connector& c, const RobotView& view, bool keeps_accelerations) {
  std::size_t of_targets = 0;
  for (const JointHandles& joint : joints_) of_targets += joint.position_target.memory_size();
  const std::size_t bodies = rigid_.bodies.size(), of_base = 6;
  const std::size_t of_integrator = keeps_accelerations && bodies > 1 ? of_base + bodies - 1 : 0;
  const std::size_t count = of_targets + of_integrator;
  if (count == 0) return;
  const bool has_levels = !c.constant_array(view.base(), keys::motion_level_names).empty();
  const std::string name = std::string(id) + (has_levels ? "." + std::to_string(level_) : "");
  auto* next = static_cast<double*>(c.state_block(view.base(), name, std::uint32_t(count * sizeof(double))));
  for (JointHandles& joint : joints_) {
    const std::size_t size = joint.position_target.memory_size();
    if (size > 0) joint.position_target.keep_in({next, size});
    next += size;
  }
  if (of_targets > 0) targets_.resize(2 * joints_.size());
  accelerations_ = {next, of_integrator};
  state_.accelerations = of_integrator > 0 ? next : nullptr;
}

/// Connects contacts among links; a robot with one link has none.
void Robot::connect_self_contacts(Connector& c, const RobotView& view, const Parameters& p) {
  rigid_.self_collision = p.boolean(multibody::self_collision.name);
  const auto has_shapes = [](const multibody::LoadedLink& link) { return link.has_shapes; };
  if (!rigid_.self_collision || std::count_if(rigid_.loaded_links.begin(), rigid_.loaded_links.end(), has_shapes) < 2)
    return;
  self_contacts_ = SelfContacts(c, view, rigid_);
  const double omega = 2 * M_PI * p.real("frequency");
  self_contact_law_ = {rigid_.mass * omega * omega, p.real("correcting_speed")};
}

void Robot::connect_by_name(Connector& c, const RobotView& view, const Parameters& p) {
  connect_drives(c, view, p);
  self_contacts_.connect_by_name(c, view, rigid_);
  has_contact_law_ = c.is_used(view.base(), keys::contact_wrenches_of_law, usage::derived);
  tells_contacts_ = c.is_used(view.base(), keys::contact_wrenches_of_motion, usage::read);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const multibody::LoadedLink& loaded = rigid_.loaded_links[i];
    const ObjectId link = loaded.object;
    links_[i].pose = c.read(link, keys::pose);
    links_[i].pose_of_body = c.read(view.links[rigid_.bodies[loaded.placement.body].link].object, keys::pose);
    if (!c.is_used(link, keys::applied_wrench, usage::read)) continue;
    links_[i].applied = c.derived(link, keys::applied_wrench);
    tells_applied_ = true;
  }
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    const Drive drive = model_.joints[i].drive;
    if (drive == Drive::position) joints_[i].position_target.connect_by_name(c);
    if (drive == Drive::effort) joints_[i].losses.connect_by_name(c, joints_[i].object);
  }
  set_offsets();
}

/// Sets the places of the numbers of the robot.
void Robot::set_offsets() {
  state_.pose = lane::numbers(pose_.get());
  state_.twist = lane::numbers(twist_.get());
  state_.masses = masses_.data();
  state_.radius = radius_of_gyration(rigid_);
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    Joint& j = model_.joints[i];
    const JointHandles& handles = joints_[i];
    j.position = offset_from(state_.positions, positions_out_[i].get());
    j.velocity = offset_from(state_.velocities, velocities_out_[i].get());
    j.out_effort = offset_from(state_.efforts, efforts_out_[i].get());
    if (const In<double>& friction = handles.losses.friction_input) {
      j.has_friction_loss = true;
      j.friction_loss = offset_from(state_.friction_losses, friction.get());
    }
    if (const In<double>& armature = handles.losses.armature_input) {
      j.has_armature_loss = true;
      j.armature_loss = offset_from(state_.armature_losses, armature.get());
    }
    if (!handles.target) continue;
    const double* target = handles.target.get();
    const double* velocity = handles.position_target.velocity();
    if (interpolates() && j.drive == Drive::position) {
      interpolated_.push_back(
          {handles.position_target, positions_out_[i].get(), rigid_.bodies[i].limits, &targets_[i]});
      target = targets_.data() + i;
      velocity = targets_.data() + joints_.size() + i;
    }
    j.target = offset_from(state_.targets[int(j.drive)], target);
    j.has_target_velocity = j.drive == Drive::position && velocity;
    if (j.has_target_velocity) j.target_velocity = offset_from(state_.targets[int(Drive::velocity)], velocity);
  }
}

bool Robot::interpolates() const { return !targets_.empty(); }

void Robot::start() {
  contacts_.start();
  self_contacts_.start();
  constexpr std::size_t of_a_link = 8;
  contact_wrenches_.resize(std::max(contact_wrenches_.size(), 6 * of_a_link * links_.size()));
  touching_links_.reserve(links_.size()), touching_wrenches_.reserve(links_.size());
  links_are_clear_ = false;
  only_contacts_push_ = std::all_of(links_.begin(), links_.end(), [this](const LoadedLink& link) {
    return link.external.size() <= (has_contact_law_ ? 1 : 0);
  });
}

void Robot::take_over() {
  contact_role_.take_over();
  contacts_.take_over();
  self_contacts_.take_over();
  std::fill(accelerations_.begin(), accelerations_.end(), 0.0);
  links_are_clear_ = false;
  for (const JointHandles& joint : joints_) joint.position_target.take_over();
  if (rigid_.fixed_base) *twist_ = Twist{};
}

void Robot::prepare(double dt) {
  start_ = pose_->position;
  state_.borne_mass = std::max(rigid_.mass, *carried_mass_);
  if (interpolates()) advance_targets(dt);
  sum_wrenches();
  add_self_contacts(dt);
  state_.contacts = contacts_.contacts().data();
  state_.contact_count = int(contacts_.contacts().size());
  state_.contact_bodies = contacts_.bodies();
  state_.contact_faces = contacts_.faces();
  state_.is_pushed = contacts_.touches_robots() || !self_contacts_.contacts().empty();
  find_touching_links();
  const bool tells_each = contact_count() > 0 && (tells_contacts_ || !state_.body_wrenches);
  if (tells_each && contact_wrenches_.size() < 6 * contact_count()) contact_wrenches_.resize(2 * 6 * contact_count());
  state_.contact_wrenches = tells_each ? contact_wrenches_.data() : nullptr;
  fetch_contacts();
}

/// Fetches early from memory what the kernel and export_contacts() will need.
void Robot::fetch_contacts() const {
  constexpr std::size_t line = 64 / sizeof(double);
  for (const KernelContact& contact : contacts_.contacts()) {
    __builtin_prefetch(contact.place);
    __builtin_prefetch(contact.place + line);
    __builtin_prefetch(contact.kept, 1);
    __builtin_prefetch(contact.kept + line, 1);
  }
  for (double* const wrench : touching_wrenches_) __builtin_prefetch(wrench, 1);
}

void Robot::advance_targets(double dt) {
  for (const InterpolatedTarget& t : interpolated_) {
    const Reference r = t.target.advance(*t.position, t.limits, dt);
    t.to[0] = r.position;
    t.to[joints_.size()] = r.velocity;
  }
}

/// Sums the wrenches on links at the origins of their bodies.
void Robot::sum_wrenches() {
  state_.wrenches = nullptr;
  if (only_contacts_push_ && !contacts_.touches_robots()) return;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const LoadedLink& link = links_[i];
    for (std::uint64_t k = 0; k < link.external.size(); ++k) {
      const Wrench& w = *link.external.contribution(k);
      if (w.force.isZero(0) && w.torque.isZero(0)) continue;
      if (!state_.wrenches) std::fill(wrenches_.begin(), wrenches_.end(), 0.0);
      state_.wrenches = wrenches_.data();
      double* const to = wrenches_.data() + 6 * rigid_.loaded_links[i].placement.body;
      const Vec3 torque = w.torque + (link.pose->position - link.pose_of_body->position).cross(w.force);
      for (int n = 0; n < 3; ++n) to[n] += w.force[n], to[3 + n] += torque[n];
    }
  }
}

void Robot::add_self_contacts(double dt) {
  self_contacts_.update(self_contact_law_, dt);
  if (self_contacts_.contacts().empty()) return;
  if (!state_.wrenches) std::fill(wrenches_.begin(), wrenches_.end(), 0.0);
  state_.wrenches = wrenches_.data();
  self_contacts_.add_to(wrenches_);
}

void Robot::take_impacts(const Step& step) {
  const ImpactCorrection* const correction = impacts_.begin_step(step);
  if (!correction) return;
  const Inertia& inertia = rigid_.bodies.front().inertia;
  const lane::Mass<double> mass{lane::splat<double>(inertia.com), {0, 0, 0}, columns_of(inertia.tensor())};
  contact_geometry::correct_path(state_.pose, state_.twist, mass, columns_of(inertia.tensor().inverse()),
                                 1 / inertia.mass, *correction);
}

/// Finds the links that touch. Kernels write the sums of contacts of bodies; for bodies with several links,
/// export_contacts() finds them.
void Robot::find_touching_links() {
  if (!links_are_clear_)
    for (const LoadedLink& link : links_)
      if (link.contact) *link.contact = Wrench{};
  links_are_clear_ = true;
  const std::span<const RobotContacts::OfLink> touching = contacts_.of_links();
  bool are_bodies = !touching.empty();
  touching_wrenches_.clear();
  for (std::size_t k = 0; k < touching.size(); ++k) {
    const std::uint32_t number = touching[k].link;
    if (k == touching_links_.size() || touching_links_[k] != number) {
      clear_contact_wrenches(k);
      touching_links_.push_back(number);
    }
    touching_wrenches_.push_back(lane::numbers(links_[number].contact.get()));
    are_bodies = are_bodies && links_[number].is_body;
  }
  clear_contact_wrenches(touching.size());
  state_.body_wrenches = are_bodies ? touching_wrenches_.data() : nullptr;
}

/// Clears the contact wrenches from number `first` on: of links that touched in the last step, and now perhaps do not.
void Robot::clear_contact_wrenches(std::size_t first) {
  for (std::size_t k = first; k < touching_links_.size(); ++k) *links_[touching_links_[k]].contact = Wrench{};
  touching_links_.resize(first);
}

/// Returns the sum of the contacts from `begin` to `end`, at `origin` (m, world).
Wrench Robot::sum_of_contacts(std::size_t begin, std::size_t end, const Vec3& origin) const {
  using lane::V3;
  const KernelContact* contact = contacts_.contacts().data() + begin;
  const double* n = contact_wrenches_.data() + 6 * begin;
  const V3<double> o = plain(origin);
  V3<double> sum{0, 0, 0}, torque{0, 0, 0};
  for (; begin < end; ++begin, ++contact, n += 6) {
    const V3<double> force{n[0], n[1], n[2]}, moment{n[3], n[4], n[5]};
    sum += force;
    torque += cross(lane::splat<double>(contact->place) - o, force);
    torque += moment;
  }
  return {vector_of(sum), vector_of(torque)};
}

void Robot::export_contacts() {
  if (tells_contacts_) told_.clear();
  const std::size_t count = contact_count();
  std::size_t i = 0;
  if (!state_.body_wrenches)
    for (const auto [number, end] : contacts_.of_links()) {
      *links_[number].contact = sum_of_contacts(i, end, origin_of(number));
      i = end;
    }
  for (i = 0; tells_contacts_ && i < count; ++i) {
    const Contact& c = contacts_.contact(i);
    told_.push_back({c.self, c.other, c.point, c.normal, c.depth, wrench_of_contact(i)});
  }
  export_self_contacts();
  if (!tells_applied_) return;
  for (const LoadedLink& link : links_) {
    if (!link.applied) continue;
    *link.applied = link.external.value();
    if (link.contact) *link.applied += *link.contact;
  }
}

void Robot::export_self_contacts() {
  const std::vector<SelfContact>& all = self_contacts_.contacts();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Contact& c = self_contacts_.contact(i);
    const auto tell = [&](std::uint32_t number, const Vec3& force) {
      links_[number].contact->add_force(force, c.point - origin_of(number));
      if (std::find(touching_links_.begin(), touching_links_.end(), number) == touching_links_.end())
        touching_links_.push_back(number);
    };
    tell(all[i].link, all[i].force);
    tell(all[i].other_link, -all[i].force);
    if (tells_contacts_) told_.push_back({c.self, c.other, c.point, c.normal, c.depth, {all[i].force, Vec3::Zero()}});
  }
}

std::string Robot::failure() const {
  for (std::size_t i = 1; i < joints_.size(); ++i)
    if (joints_[i].target && !std::isfinite(*joints_[i].target))
      return "the target of " + quote(joints_[i].name) + " is not finite; look at what writes its `joint.*.target`";
  Wrench external;
  for (const LoadedLink& link : links_) external += link.external.value();
  return watch::failure_of_numbers(rigid_.name, *pose_, *twist_, external, rigid_.mass);
}

}  // namespace muro::articulated
