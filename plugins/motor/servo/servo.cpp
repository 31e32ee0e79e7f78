// SPDX-License-Identifier: MIT
// A position or velocity servo: digital controller, DC motor and gear. It drives joints whose motion takes efforts. The
// motor gives the effort that its controller wants, within its limits, or is driven by a voltage.
#include <string>
#include <utility>
#include <vector>

#include "encoder.hpp"
#include "gearbox.hpp"
#include "muro/base/number_text.hpp"
#include "muro/plugin.hpp"
#include "muro/toolkit/joint_drives.hpp"
#include "muro/toolkit/joint_inertia.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "plugins/common/contact_geometry/contact_responsibility.hpp"
#include "plugins/common/text/quote.hpp"
#include "voltage_drive.hpp"

namespace {

using namespace muro;
using namespace muro::servo;

constexpr Key<double> integral_effort{"servo.integral", "N m or N", "effort of the controller's integral"};
constexpr Key<double> encoder_reading{"servo.position", "rad or m", "position as measured"};
constexpr Key<double> measured_speed{"servo.velocity", "rad/s or m/s", "speed as measured"};
constexpr Key<double> encoder_offset{"servo.offset", "rad or m", "true position less the measured one"};
constexpr Key<double> delayed_commands{"servo.commands", "rad or m, rad/s or m/s", "list: on their way to the servo"};
constexpr Key<double> rotor_position{"motor.position", "rad or m", "of the rotor, at the output"};
constexpr Key<double> rotor_velocity{"motor.velocity", "rad/s or m/s", "of the rotor, at the output"};
constexpr Key<double> motor_effort{"motor.effort", "N m or N", "what the motor applies to the rotor, at the output"};

constexpr std::string_view modes[] = {"position", "velocity"};
constexpr std::string_view encoder_places[] = {"output", "motor"};
constexpr Parameter parameters[] = {
    texts("joints", "names, or beginnings of names followed by *; default: all whose motion takes efforts"),
    text("mode", "position", "what it follows: joint.position.target or joint.velocity.target").one_of(modes),
    real("stiffness", "N m/rad or N/m", 0,
         "effort by position error; mode velocity: by the integral of the speed error")
        .between(0, 1e12),
    real("damping", "N m s/rad or N s/m", 0, "effort by speed; mode velocity: by speed error").between(0, 1e12),
    real("integral", "N m/(rad s) or N/(m s)", 0, "mode position: growth of effort by position error").between(0, 1e12),
    real("delay", "s", 0, "of commands; rounded to whole runs").between(0, 1),
    text("encoder", "output", "where the position is measured").one_of(encoder_places),
    real("encoder_resolution", "rad or m", 0, "step of the measured position, at the output; 0: exact").between(0, 1),
    real("offset", "rad or m", 0,
         "zero of the encoder: joint.position less the measured position; goals are measured positions")
        .between(-10, 10),
    real("speed_filter", "s", 0, "time constant of the measured speed; 0: none").between(0, 10),
    real("gear_ratio", "1 or rad/m", 1, "turns of the motor by those of the output").between(1e-6, 1e9),
    real("stall_torque", "N m", 0, "of the motor at standstill; 0: no torque-speed line").between(0, 1e12),
    real("no_load_speed", "rad/s", 0, "of the motor; 0: no torque-speed line").between(0, 1e9),
    real("max_torque", "N m", 0, "of the motor at the largest current; 0: no limit").between(0, 1e12),
    real("rotor_inertia", "kg m^2", 0, "of the motor; 0: the joint feels none, and the gear is ideal").between(0, 1e9),
    real("efficiency", "1", 1, "of the gear under load; below 0.5 it locks itself").between(0.05, 1),
    real("friction", "N m or N", 0, "Coulomb friction of motor and gear, at the output").between(0, 1e12),
    real("viscous_friction", "N m s/rad or N s/m", 0, "of motor and gear, at the output").between(0, 1e12),
    real("backlash", "rad or m", 0, "play of the gear from flank to flank, at the output").between(0, 10),
    real("gear_stiffness", "N m/rad or N/m", 0, "of the gear, at the output; 0: as stiff as the rate allows")
        .between(0, 1e12),
    text("part", "", "a motor driven by a voltage: mx28, mx64, mx106, xl320, xl330, sts3215, or a file of your own"),
    text("friction_model", "", "a section of the part, such as m1 or m4; default: the last"),
    real("supply_voltage", "V", 0,
         "where servo.supply_voltage is not commanded; this and what follows: else the part's")
        .between(0, 1e6),
    real("p_gain", "1", 0, "of the firmware, in its units").between(0, 1e12),
    real("duty_gain", "1/rad", 0, "duty by error of position, for each unit of p_gain").between(0, 1e12),
    real("duty_limit", "1", 1, "the largest duty").between(0, 1),
    real("kt", "N m/A", 0, "torque by current; above 0: the motor is driven by a voltage").between(0, 1e9),
    real("resistance", "Ohm", 0, "of the coil").between(0, 1e9),
    real("armature", "kg m^2", 0, "inertia of the rotor, as the output feels it").between(0, 1e9),
    real("stribeck_friction", "N m", 0, "friction that goes away with speed").between(0, 1e12),
    real("stribeck_velocity", "rad/s", 1, "at which exp(-1) of it is left").between(1e-9, 1e9),
    real("stribeck_exponent", "1", 1, "of speed by stribeck_velocity").between(1e-3, 100),
    real("load_friction", "1", 0, "friction by the torque between motor and load").between(0, 1e3),
    real("load_stribeck_friction", "1", 0, "the same, what goes away with speed").between(0, 1e3),
};
constexpr PropertyUse reads[] = {
    {"joint.position.target", "mode position"},
    {"joint.velocity.target", "mode velocity"},
    {"joint.position", "of every joint that it drives"},
    {"joint.velocity", "of every joint that it drives"},
    {"servo.supply_voltage", "where a voltage drives the motor"},
    {"servo.p_gain", "where a voltage drives the motor"},
    {"servo.torque_enable", "where a voltage drives the motor; 0 opens its coil"},
    {"contact.world", "of a robot with several motions: whether the present one takes efforts"},
    {"inertial", "of the bodies behind a joint, where the rotor has inertia"}};
constexpr PropertyUse writes[] = {{"joint.effort.target", "of every joint that it drives"},
                                  {"servo.integral", "effort of the controller's integral"},
                                  {"servo.position", "position as measured"},
                                  {"servo.velocity", "speed as measured"},
                                  {"servo.offset", "constant: joint.position less the measured one, where it is not 0"},
                                  {"servo.commands", "commands on their way, where there is a delay"},
                                  {"motor.position", "of the rotor, at the output, where it has inertia"},
                                  {"motor.velocity", "of the rotor, at the output, where it has inertia"},
                                  {"motor.effort", "what the motor applies to the rotor, at the output"},
                                  {"servo.duty", "where a voltage drives the motor"},
                                  {"joint.drive.friction", "where a voltage drives the motor"},
                                  {"joint.drive.armature", "where a voltage drives the motor"}};
constexpr Description description{
    .id = "motor.servo",
    .kind = Kind::drive,
    .version = "1.0.0",
    .summary = "Servos with a digital controller, a DC motor, and a gear with backlash and friction",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

/// A joint with a servo.
struct ServoJoint {
  In<double> command, position, velocity;
  Out<double> effort, integral, encoder_reading, measured_speed, motor_effort;
  Out<double> rotor_position, rotor_velocity;  ///< used when the rotor has inertia
  ListOut<double> commands;                    ///< used when there is a delay: a ring of commands
  Gearbox gear;
  VoltageDrive voltage_drive;  ///< used when a voltage drives the motor
  double initial_command = 0;
  In<std::uint64_t> world;  ///< keys::contact_world, used when several motions move the robot

  /// Returns whether a motion by forces moves the robot; otherwise the effort has no effect.
  bool acts() const { return !world || is_moved_by_forces(*world); }
};

/// Data of one robot.
struct ServoRobot {
  Range joints;
};

class Servo final : public PerRobotAlgorithm<ServoRobot> {
 public:
  void step(const Step& step, Range range) override {
    for (const ServoRobot& r : robots(range))
      for (const ServoJoint& joint : joints_[r.joints]) drive(joint, step);
  }

 private:
  void read_parameters(const Parameters& p) override {
    const double ratio = p.real("gear_ratio");
    controller_ = {p.text("mode") == "velocity", p.real("stiffness"), p.real("damping"), p.real("integral")};
    encoder_ = {p.real("encoder_resolution"), p.real("speed_filter"), p.real("offset")};
    encoder_on_motor_ = p.text("encoder") == "motor";
    delay_ = p.real("delay");
    has_voltage_ = has_voltage(p);
    const double stall = p.real("stall_torque"), no_load_speed = p.real("no_load_speed");
    const double max_torque = p.real("max_torque");
    if ((stall > 0) != (no_load_speed > 0))
      throw Error("`stall_torque` is " + number_text(stall) + " N m and `no_load_speed` " + number_text(no_load_speed) +
                  " rad/s; the torque-speed line needs both, or leave both out");
    if (stall > 0) motor_.stall = stall * ratio, motor_.slope = stall / no_load_speed * ratio * ratio;
    if (max_torque > 0) motor_.max_effort = max_torque * ratio;
    gear_ = {.rotor_inertia = p.real("rotor_inertia") * ratio * ratio,
             .friction = p.real("friction"),
             .loss = 1 / p.real("efficiency") - 1,
             .viscous = p.real("viscous_friction"),
             .backlash = p.real("backlash"),
             .stiffness = p.real("gear_stiffness")};
    check(p);
  }

  void check(const Parameters& p) const {
    check_kind_of_motor(p, has_voltage_);
    if (has_voltage_) return;
    if (!controller_.follows_velocity && !(controller_.stiffness > 0))
      throw Error("`stiffness` is 0, so a servo of positions does nothing; give it, in N m/rad");
    if (controller_.follows_velocity && !(controller_.stiffness + controller_.damping > 0))
      throw Error("`damping` and `stiffness` are 0, so a servo of speeds does nothing; give `damping`, in N m s/rad");
    if (controller_.follows_velocity && p.given("integral"))
      throw Error("`integral` belongs to mode `position`; in mode `velocity` `stiffness` is the gain of the integral");
    if (gear_.rotor_inertia > 0) return;
    for (const std::string_view name : {"friction", "backlash", "gear_stiffness"})
      if (p.real(name) > 0) throw needs_rotor(name, number_text(p.real(name)));
    if (p.real("efficiency") < 1) throw needs_rotor("efficiency", number_text(p.real("efficiency")));
    if (encoder_on_motor_) throw needs_rotor("encoder", "motor");
  }
  static Error needs_rotor(std::string_view name, const std::string& value) {
    return Error(quote(name) + " is " + value +
                 ", which needs a rotor that moves by itself; give `rotor_inertia`, in kg m^2 (of the motor; "
                 "1e-7 to 1e-5 for small ones)");
  }

  ServoRobot connect_robot(Connector& c, const Item& item) override {
    const RobotView& robot = *item.robot;
    MotorParameters motor_parameters;
    if (has_voltage_) motor_parameters = MotorParameterReader(c, c.parameters()).read();
    const std::vector<double> start = initial_joint_positions(c, robot);
    const std::vector<Inertia> inertias = inertias_of(c, robot);
    std::vector<ServoJoint> joints;
    for (const std::size_t i : driven_links(c, robot)) {
      const ObjectId joint = robot.links[i].joint_object;
      ServoJoint j;
      j.gear = gear_;
      if (gear_.rotor_inertia > 0) {
        j.gear.joint_inertia = joint_inertia(robot.links, inertias, start, i);
        if (!(j.gear.joint_inertia > 0))
          throw Error("joint `" + std::string(c.object_name(joint)) +
                      "` moves no inertia that a gear could turn; give the bodies behind it mass and inertia "
                      "(`inertial`)");
        j.rotor_position = c.variable(joint, rotor_position, start[i]);
        j.rotor_velocity = c.variable(joint, rotor_velocity, 0.0);
      }
      if (!c.constant_array(robot.base(), keys::motion_level_names).empty())
        j.world = c.input(robot.base(), keys::contact_world, kinematic_world);
      if (encoder_.offset != 0) c.set(joint, encoder_offset, encoder_.offset);
      j.initial_command = controller_.follows_velocity ? 0 : start[i] - encoder_.offset;
      j.command =
          c.input(joint, controller_.follows_velocity ? keys::joint_velocity_target : keys::joint_position_target,
                  j.initial_command);
      j.position = c.input(joint, keys::joint_position, start[i]);
      j.velocity = c.input(joint, keys::joint_velocity, 0.0);
      j.effort = c.optional_output(joint, keys::joint_effort_target);
      j.integral = c.variable(joint, integral_effort, 0.0);
      j.encoder_reading = c.variable(joint, encoder_reading, encoder_.reading(start[i]));
      j.measured_speed = c.variable(joint, measured_speed, 0.0);
      j.motor_effort = c.derived(joint, motor_effort);
      if (delay_ > 0) j.commands = c.variable_list(joint, delayed_commands);
      if (has_voltage_)
        j.voltage_drive = VoltageDrive(c, joint, motor_parameters,
                                       joint_inertia(robot.links, inertias, start, i) + robot.links[i].limits.armature);
      joints.push_back(j);
    }
    return {joints_.add(joints)};
  }

  /// Returns the links that the joints to drive move. Without names: of all joints whose motion takes efforts.
  static std::vector<std::size_t> driven_links(Connector& c, const RobotView& robot) {
    const std::span<const std::string_view> names = c.parameters().texts("joints");
    std::vector<std::size_t> links;
    std::vector<std::string> known;
    std::vector<bool> used(names.size());
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      const Link& link = robot.links[i];
      if (link.joint == JointKind::fixed || link.mimic >= 0) continue;
      known.emplace_back(c.object_name(link.joint_object).substr(robot.name.size() + 1));
      bool is_driven = names.empty() && c.is_used(link.joint_object, keys::joint_effort_target, usage::input);
      for (std::size_t k = 0; k < names.size(); ++k) {
        const bool is_named = muro::detail::names_joint(names[k], known.back());
        is_driven = is_driven || is_named;
        used[k] = used[k] || is_named;
      }
      if (is_driven) links.push_back(i);
    }
    std::string all;
    for (const std::string& k : known) all += " `" + k + "`";
    for (std::size_t k = 0; k < names.size(); ++k)
      if (!used[k])
        throw Error("`joints` names `" + std::string(names[k]) + "`, but `" + std::string(robot.name) +
                    "` has no such joint to drive" + did_you_mean(names[k], known) +
                    "; its joints are:" + (all.empty() ? " none" : all));
    if (links.empty())
      c.host().log(LogLevel::info, "motor.servo drives nothing of `" + std::string(robot.name) +
                                       "`: its motion takes no efforts (`joints: effort` there, or `effort_joints`)");
    return links;
  }

  /// Returns the command that was given `delay_` ago.
  double delayed_command(const ServoJoint& j, const Step& step) const {
    const double command = *j.command;
    if (!j.commands) return command;
    const auto runs = std::uint64_t(std::lround(delay_ / step.dt));
    if ((*j.commands).size() != runs) {
      j.commands.clear();
      for (std::uint64_t k = 0; k < runs; ++k) j.commands.push_back(step.index == 0 ? j.initial_command : command);
    }
    if (runs == 0) return command;
    return std::exchange((*j.commands)[step.index % runs], command);
  }

  void drive(const ServoJoint& j, const Step& step) const {
    const double dt = step.dt, q = *j.position, v = *j.velocity;
    Rotor rotor{q, v};
    if (j.rotor_position) rotor = {*j.rotor_position, *j.rotor_velocity};
    const double target = delayed_command(j, step);
    const double position = encoder_.reading(encoder_on_motor_ ? rotor.position : q);
    const double speed = encoder_.measured_speed(position, *j.encoder_reading, *j.measured_speed,
                                                 encoder_on_motor_ ? rotor.velocity : v, dt);
    *j.encoder_reading = position;
    *j.measured_speed = speed;
    if (j.voltage_drive) {
      *j.effort = *j.motor_effort = j.voltage_drive.run(target - position, v, j.acts(), dt);
      return;
    }
    double integral = *j.integral;
    const double wanted = controller_.effort(target, position, speed, motor_.limits(rotor.velocity), integral, dt);
    if (j.acts()) *j.integral = integral;
    if (!j.rotor_position) {
      *j.motor_effort = wanted;
      *j.effort = wanted - gear_.viscous * v;
      return;
    }
    *j.effort = j.gear.effort(rotor, q, v, dt);
    *j.motor_effort = j.gear.advance_rotor(rotor, wanted, motor_, *j.effort, dt);
    *j.rotor_position = rotor.position;
    *j.rotor_velocity = rotor.velocity;
  }

  PidController controller_;
  Encoder encoder_;
  bool encoder_on_motor_ = false;
  double delay_ = 0;  ///< s
  bool has_voltage_ = false;
  Motor motor_;
  Gearbox gear_;  ///< without the inertia of the joint
  PackedLists<ServoJoint> joints_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Servo>(description)};

}  // namespace

MURO_PLUGIN(.name = "motor_servo", .version = description.version, .licence = "MIT", .summary = "Servos of joints",
            .algorithms = algorithms)
