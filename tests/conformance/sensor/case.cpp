// SPDX-License-Identifier: MIT
#include "tests/conformance/sensor/case.hpp"

#include <algorithm>
#include <cstdio>

#include "tests/conformance/team.hpp"
#include "tests/support/files.hpp"

namespace muro::sensor_conformance {

namespace {

const Description& description_of(const std::string& motion) { return *test::plugins().algorithm(motion).description; }

/// Returns a model of examples/models with more links (URDF).
RobotTree vehicle_with(Simulation& simulation, const std::string& model, const std::string& more) {
  std::string text = test::text_of(MURO_TEST_SOURCE_DIR "/examples/models/" + model + ".urdf");
  text.insert(text.rfind("</robot>"), more);
  const test::ScratchFolder folder;
  return simulation.read_model(folder.file(model + ".urdf", text));
}

constexpr const char* table_urdf =
    "<link name=\"disc\"/><joint name=\"table\" type=\"continuous\"><parent link=\"base_link\"/>"
    "<child link=\"disc\"/><origin xyz=\"0 0 0.3\"/><axis xyz=\"0 0 1\"/></joint>";

std::string arm_urdf(const Vec3& axis) {
  char text[600];
  std::snprintf(text, sizeof text,
                "<link name=\"arm\"><inertial><origin xyz=\"0.3 0 0\"/><mass value=\"0.5\"/>"
                "<inertia ixx=\"1e-4\" iyy=\"1e-3\" izz=\"1e-3\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>"
                "<joint name=\"lift\" type=\"continuous\"><parent link=\"base_link\"/><child link=\"arm\"/>"
                "<origin xyz=\"0 0 0.3\"/><axis xyz=\"%g %g %g\"/></joint>",
                axis.x(), axis.y(), axis.z());
  return text;
}

std::string model_for(const std::string& motion) {
  return motion == "motion.ackermann" ? "car" : motion == "motion.omni" ? "mecanum" : "rover";
}

RobotTree box_with_table() {
  const Shape box = test::with(Shape::box({0.4, 0.3, 0.2}), 0.8);
  return test::tree_of([&](RobotBuilder& b) {
    b.base("base_link");
    b.set(keys::inertial, test::solid_box(2, {0.4, 0.3, 0.2}));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&box, 1));
    b.translation({0, 0, 0.3});
    b.revolute("table", Vec3::UnitZ(), {});
    b.body("disc");
    b.set(keys::inertial, Inertia{.mass = 0.1, .ixx = 1e-3, .iyy = 1e-3, .izz = 2e-3});
  });
}

constexpr const char* tray_urdf =
    "<link name=\"tray\"><inertial><mass value=\"0.2\"/>"
    "<inertia ixx=\"1e-3\" iyy=\"1e-3\" izz=\"2e-3\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>"
    "<collision><geometry><box size=\"0.3 0.3 0.02\"/></geometry></collision></link>"
    "<joint name=\"holder\" type=\"fixed\"><parent link=\"base_link\"/>"
    "<child link=\"tray\"/><origin xyz=\"0 0 0.49\"/></joint>";

RobotTree box_with_tray() {
  const Shape box = test::with(Shape::box({0.4, 0.3, 0.2}), 0.8), tray = test::with(Shape::box({0.3, 0.3, 0.02}), 0.8);
  return test::tree_of([&](RobotBuilder& b) {
    b.base("base_link");
    b.set(keys::inertial, test::solid_box(2, {0.4, 0.3, 0.2}));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&box, 1));
    b.translation({0, 0, 0.49});
    b.body("tray");
    b.set(keys::inertial, test::solid_box(0.2, {0.3, 0.3, 0.02}));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&tray, 1));
  });
}

constexpr const char* plane_of_legged = "plane_of_legged";

/// Cases in which a robot drives.
constexpr std::string_view driving_cases[] = {
    "driving forward while turning left it is pushed to the left",
    "speeding up is felt as it is",
    "a sensor four times slower than the motion feels the same",
    "a left radius 1 % too large bends 10 m to the right",
    "a bumper is pressed at a wall, and not before",
    "velocity is told to the east and north",
};

struct Exception {
  std::string_view motion, name;
  double error;
  std::string_view why;
};
constexpr Exception exceptions[] = {{"", "", 0, ""}};

}  // namespace

Family family_of(const std::string& motion) {
  if (motion == "motion.point") return Family::point;
  if (motion == "motion.biped") return Family::legged;
  return (description_of(motion).features & feature_forces) != 0 ? Family::forces : Family::wheeled;
}

std::vector<std::string> motions() {
  std::vector<std::string> ids;
  for (const CatalogEntry& o : test::plugins().catalog())
    if (o.kind == "motion") ids.push_back(o.id);
  return ids;
}

const RobotView& Trial::add_legged(const std::string& more, const Pose& pose) {
  const RobotTree tree = vehicle_with(*this, "biped", more);
  const Shape plane = Shape::plane();
  world().add_scenery(plane_of_legged, pose * Pose{{0, 0, -tree.standing_height()}, Quat::Identity()},
                      std::span<const Shape>(&plane, 1));
  return add("r", tree, pose);
}

const RobotView& Trial::add_vehicle(const Pose& pose, const Twist& twist) {
  if (family() == Family::legged) return add_legged(table_urdf, pose);
  if (family() != Family::wheeled) return add("r", box_with_table(), pose, twist);
  return add("r", vehicle_with(*this, model_for(motion_), table_urdf), pose, twist);
}

const RobotView& Trial::add_carrier(const Pose& pose) {
  if (family() == Family::legged) return add_legged(tray_urdf, pose);
  if (family() != Family::wheeled) return add("r", box_with_tray(), pose);
  return add("r", vehicle_with(*this, model_for(motion_), tray_urdf), pose);
}

const RobotView& Trial::add_load(const std::string& motion, const RobotTree& tree, const Pose& pose,
                                 const Twist& twist) {
  motion_of_load_ = motion;
  return add("load", tree, pose, twist);
}

const RobotView& Trial::add_arm(const Vec3& axis, double position) {
  const Inertia arm{.mass = 0.5, .com = {0.3, 0, 0}, .ixx = 1e-4, .iyy = 1e-3, .izz = 1e-3};
  const bool is_wheeled = family() == Family::wheeled;
  const RobotView& robot = family() == Family::legged ? add_legged(arm_urdf(axis), {})
                           : is_wheeled ? add("r", vehicle_with(*this, model_for(motion_), arm_urdf(axis)))
                                        : add("r", test::tree_of([&](RobotBuilder& b) {
                                                b.base("base_link");
                                                b.set(keys::inertial, test::solid_box(2, {0.4, 0.3, 0.2}));
                                                b.translation({0, 0, 0.3});
                                                b.revolute("lift", axis, {});
                                                b.body("arm");
                                                b.set(keys::inertial, arm);
                                              }),
                                              {{0, 0, 3}, Quat::Identity()});
  world().set(world().object("r/lift"), keys::initial_joint_position, position);
  return robot;
}

ObjectId Trial::add_sensor(const std::string& id, const std::string& on, Parameters parameters, double rate) {
  const RobotView& r = *world().robots().back();
  const std::string name = "sensor_" + std::to_string(world().object_count());
  const ObjectId object = add_sensor_object(r, name, world().object(std::string(r.name) + "/" + on));
  use(id, rate, {{&r, object}}, std::move(parameters));
  return object;
}

void Trial::start(Parameters parameters) {
  const auto knows = [&](const std::string& name) {
    const Rows<Parameter> known = description_of(motion_).parameters;
    return std::any_of(known.begin(), known.end(), [&](const Parameter& p) { return p.name == name; });
  };
  std::erase_if(parameters, [&](const auto& p) { return !knows(p.first); });
  if (family() == Family::legged) {
    parameters = test::vehicle_for(motion_).parameters;
    parameters["plane"] = std::string(plane_of_legged);
  }
  std::vector<Item> own = all_robots();
  if (!motion_of_load_.empty()) {
    use(motion_of_load_, 1000, {own.back()});
    own.pop_back();
  }
  use(motion_, 1000, own, parameters);
  if (family() == Family::wheeled)
    use(motion_ == "motion.ackermann" ? "drive.ackermann"
        : motion_ == "motion.omni"    ? "drive.omni"
                                      : "drive.skid_steer",
        0, own);
  if (family() == Family::forces || finds_contacts_ || !motion_of_load_.empty())
    use_contacts();
  else
    use_kinematics();
  build();
}

void Trial::command(double speed, double yaw_rate) {
  if (family() == Family::forces || family() == Family::legged) return;
  world().value(robot().base(), keys::command_twist) = {{speed, 0, 0}, {0, 0, yaw_rate}};
}

std::vector<Case> all_cases() {
  std::vector<Case> all;
  for (const auto& some :
       {inertial_cases(), change_cases(), joint_cases(), wrench_cases(), touch_cases(), pair_cases(), place_cases()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

How how(const std::string& motion, const Case& c) {
  if (!c.only_for.empty() && motion != c.only_for) return How::left_out;
  const Family family = family_of(motion);
  if (family != Family::legged) return c.how[int(family)];
  const bool drives = std::find(std::begin(driving_cases), std::end(driving_cases), c.name) != std::end(driving_cases);
  return drives ? How::left_out : c.how[int(Family::wheeled)];
}

Bound bound_of(const std::string& motion, const Case& c) {
  for (const Exception& e : exceptions)
    if (e.motion == motion && e.name == c.name) return {e.error, e.why};
  const Family family = family_of(motion);
  return {c.bound[int(family == Family::legged ? Family::wheeled : family)]};
}

namespace {

std::string text(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.7g", x);
  return buffer;
}

std::string text(const Vec3& v) { return "(" + text(v.x()) + ", " + text(v.y()) + ", " + text(v.z()) + ")"; }

}  // namespace

Outcome difference(const Vec3& seen, const Vec3& expected) {
  return {(seen - expected).norm(), text(seen) + " for " + text(expected)};
}
Outcome difference(double seen, double expected) {
  return {std::abs(seen - expected), text(seen) + " for " + text(expected)};
}

}  // namespace muro::sensor_conformance
