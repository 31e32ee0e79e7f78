// SPDX-License-Identifier: MIT
// Reads <gazebo>: elements that URDF does not have, in the terms of SDFormat (sdformat, parser_urdf).
#include <utility>

#include "model.hpp"
#include "plugins/reader/common/sdf_devices/plugin.hpp"
#include "plugins/reader/common/sdf_devices/sensor.hpp"

namespace muro::urdf {

namespace {

using sdf_devices::Fields;

constexpr const char* engine_text =
    "the stiffness of contacts and joints is a matter of the algorithms in the scenario";

class Gazebo {
 public:
  Gazebo(ModelInfo& model, Problems& problems) : model_(model), problems_(problems) {
    for (const auto& [name, link] : model.links) parts_.used.insert(name);
    for (const auto& [name, joint] : model.joints) parts_.used.insert(name);
    parts_.joint = [this](const std::string& name) -> std::optional<std::string> {
      const auto joint = model_.joints.find(name);
      if (joint == model_.joints.end() || !joint->second.moves) return std::nullopt;
      return name_of_part(name);
    };
  }

  void run(Element& robot) {
    for (Element* gazebo : children(robot, "gazebo")) {
      const char* const reference = gazebo->Attribute("reference");
      if (!reference)
        take_model(*gazebo);
      else if (const auto link = model_.links.find(reference); link != model_.links.end())
        take_link(*gazebo, link->first, link->second);
      else if (const auto joint = model_.joints.find(reference); joint != model_.joints.end())
        take_joint(*gazebo, joint->first, joint->second);
      else
        problems_.warning(location_of(*gazebo),
                          concat("<gazebo reference=", quote(reference), "> names no link or joint and is ignored"));
    }
    add_motion();
    add_gravity_compensation();
    left_out_.report(problems_);
  }

 private:
  /// Returns the robot's name of a joint. A joint with the name of a link is called NAME_joint.
  std::string name_of_part(std::string joint) const {
    if (model_.links.count(joint) == 0) return joint;
    do joint += "_joint";
    while (parts_.used.count(joint) != 0);
    return joint;
  }

  void take_model(Element& gazebo) {
    Fields fields(gazebo, "<gazebo>", messages_);
    if (fields.flag("static").value_or(false)) {
      is_static_ = true;
      problems_.note(location_of(gazebo),
                     "the robot is static: motions by forces hold its base (`base: fixed`); "
                     "without a motion all of it stands still");
      place_ = place_.line > 0 ? place_ : location_of(gazebo);
    }
    take_self_collision(fields);
    for (Element* plugin : fields.sections("plugin")) take_drive(*plugin);
    fields.list_unread("it has no counterpart in a robot");
  }

  void take_link(Element& gazebo, const std::string& name, LinkInfo& link) {
    const std::string owner = "link " + quote(name);
    take_surface(gazebo, owner, link.surface, problems_);
    Fields fields(gazebo, owner, messages_);
    for (const char* const taken : {"mu1", "mu2", "restitution_coefficient", "collision"}) fields.section(taken);
    const bool is_off = fields.flag("turnGravityOff").value_or(false);
    const bool is_on = fields.flag("gravity").value_or(true);
    if (is_off || !is_on) {
      weightless_.push_back(name);
      weightless_place_ = weightless_place_.line > 0 ? weightless_place_ : location_of(gazebo);
    }
    take_self_collision(fields);
    take_sensors(fields, name, !link.collisions.empty());
    fields.skip({"kp", "kd", "minDepth", "min_depth", "maxVel", "max_vel", "maxContacts", "max_contacts", "softCfm",
                 "soft_cfm", "softErp", "soft_erp"},
                engine_text);
    fields.skip({"fdir1"}, "friction is one Coulomb coefficient, the same in all directions");
    fields.skip({"material"}, "materials of Gazebo's scripts are not read; write <material> with a <color>");
    fields.skip({"laserRetro", "laser_retro"}, "rays have no brightness");
    fields.skip({"visual"}, "only plain colours are shown");
    for (const char* const damping : {"dampingFactor", "velocity_decay"})
      if (const Element* const e = fields.section(damping))
        left_out_.add(Severity::warning, concat("<", damping, "> in <gazebo>"),
                      "damping of bodies is a parameter of the motion, where it has one", location_of(*e));
    fields.list_unread("it has no counterpart in a link");
  }

  void take_joint(Element& gazebo, const std::string& name, JointInfo& joint) {
    Fields fields(gazebo, "joint " + quote(name), messages_);
    const auto stiffness = fields.number("springStiffness", 0, 1e12);
    const double reference =
        fields.number("springReference", -limits::joint_position, limits::joint_position).value_or(0);
    if (stiffness.value_or(0) > 0 && joint.moves) {
      joint.spring = model_file::JointSpring{*stiffness, reference};
      problems_.note(location_of(gazebo), fields.owner() + joint.spring->note());
    }
    // forces through a joint are measured at its child
    take_sensors(fields, joint.child, false);
    // these flags need no report: links behind fixed joints are separate bodies anyway
    for (const char* const kept : {"disableFixedJointLumping", "preserveFixedJoint"}) fields.section(kept);
    fields.skip({"provideFeedback"}, "a `sensor.force_torque` reads what passes through any joint");
    fields.skip(
        {"stopCfm", "stopErp", "stopKp", "stopKd", "fudgeFactor", "cfmDamping", "implicitSpringDamper", "erp", "cfm"},
        engine_text);
    fields.list_unread("it has no counterpart in a joint");
  }

  void take_sensors(Fields& fields, const std::string& part, bool can_be_touched) {
    for (Element* sensor : fields.sections("sensor"))
      if (!can_be_touched && sensor->Attribute("type", "contact"))
        left_out_.add(Severity::warning, "<sensor type=`contact`>", "its link has no shape that something could touch",
                      location_of(*sensor));
      else
        place(read_sensor(*sensor, part, messages_), part);
  }

  void place(sdf_devices::Device device, const std::string& part) {
    device.place("", part, parts_);
    add(device);
  }

  /// Adds a drive. A robot has only one.
  void take_drive(Element& plugin) {
    const sdf_devices::Device drive = read_plugin(plugin, parts_, messages_);
    if (!drive.subsystems.empty() && std::exchange(has_drive_, true))
      problems_.warning(location_of(plugin), drive.owner + " is left out: the robot has a drive already");
    else
      add(drive);
  }

  void add(const sdf_devices::Device& device) {
    device.tell(problems_);
    model_.subsystems.insert(model_.subsystems.end(), device.subsystems.begin(), device.subsystems.end());
  }

  void take_self_collision(Fields& fields) {
    for (const char* const name : {"selfCollide", "self_collide"})
      if (fields.flag(name).value_or(false) && !self_collision_) {
        self_collision_ = true;
        problems_.note(
            location_of(fields.parent()),
            concat(fields.owner(), ": <", name, "> is `self_collision` of motions that have it: all links of ",
                   "the robot touch each other, but neighbours"));
        place_ = place_.line > 0 ? place_ : location_of(fields.parent());
      }
  }

  void add_motion() {
    if (!is_static_ && !self_collision_) return;
    sdf_devices::Subsystem motion("motion", "", place_);
    if (is_static_) motion.add("base", "fixed");
    if (self_collision_) motion.add_flag("self_collision", true);
    model_.subsystems.push_back(std::move(motion));
  }

  void add_gravity_compensation() {
    if (weightless_.empty()) return;
    sdf_devices::Subsystem lift(parts_.unique("gravity_compensation"), "drive.gravity_compensation", weightless_place_);
    if (weightless_.size() < model_.links.size()) lift.add("links", weightless_);
    const bool several = weightless_.size() > 1;
    problems_.note(weightless_place_,
                   concat("gravity does not pull at ", several ? "links " : "link ", quoted_list(weightless_), ", by `",
                          lift.text(), "`; `", lift.name(), ": off` leaves it out"));
    model_.subsystems.push_back(std::move(lift));
  }

  ModelInfo& model_;
  Problems& problems_;
  sdf_devices::LeftOut left_out_;
  sdf_devices::Messages messages_{problems_, left_out_};
  sdf_devices::PartNames parts_;
  bool is_static_ = false, self_collision_ = false, has_drive_ = false;
  Location place_;                       ///< location of the first of these flags
  std::vector<std::string> weightless_;  ///< links without gravity
  Location weightless_place_;
};

}  // namespace

void take_gazebo(Element& robot, ModelInfo& model, Problems& problems) { Gazebo(model, problems).run(robot); }

}  // namespace muro::urdf
