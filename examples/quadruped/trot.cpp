// SPDX-License-Identifier: MIT
// Trots: diagonal pairs of legs swing in turn to the places of Raibert's rule. The others push so that the body keeps
// its height, its attitude and its speed. Joints are driven by efforts. All numbers of the robot are tunables and
// arguments (tunables.hpp, README.md); the defaults are those of examples/models/quadruped.urdf.
#include <algorithm>
#include <array>
#include <cmath>

#include "../common/angle.hpp"
#include "../common/vector.hpp"
#include "balance.hpp"
#include "course.hpp"
#include "estimate.hpp"
#include "gait.hpp"
#include "model.hpp"
#include "muro_controller.hpp"
#include "placement.hpp"
#include "sensed.hpp"
#include "stride.hpp"

namespace quadruped {

using namespace muro::controller;

class Trot {
 public:
  static constexpr const char* name = "trot";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Trots on four legs of three joints, driven by efforts";
  static constexpr muro_port inputs[] = {{"joint.position", "rad", joints, 0},
                                         {"joint.velocity", "rad/s", joints, 0},
                                         {"orientation", "1", 4, 0},
                                         {"angular_velocity", "rad/s", 3, 0},
                                         {"linear_acceleration", "m/s^2", 3, 0},
                                         {"foot.contact", "1", legs, MURO_PORT_OPTIONAL},
                                         {"command.twist", "m/s, rad/s", 6, MURO_PORT_OPTIONAL}};
  static constexpr muro_port outputs[] = {{"joint.effort.target", "N m", joints, 0},
                                          {"trot.velocity", "m/s", 3, MURO_PORT_OWN},
                                          {"trot.height", "m", 1, MURO_PORT_OWN},
                                          {"trot.stands", "1", legs, MURO_PORT_OWN}};
  static constexpr auto& tunables = tunable::all;

  explicit Trot(const Setup& setup) : model_(setup) {}

  void step(const Step& now) {
    State& s = state_;
    const Sensed seen(model_, {now.input(at_position), now.input(at_velocity), now.input(at_orientation),
                               now.input(at_rotation), now.input(at_acceleration), now.input(at_contact)});
    if (s.age == 0) begin(seen);
    s.age += now.period();
    s.course.follow(model_, command_of(now), s.clock.runs != 0, s.body.velocity, now.period());
    start_and_stop(seen, now);
    s.stride.advance(model_.gait, s.clock, seen, now.period());
    s.body.update(seen.feet, s.stride.believed(), seen.force - Vector{0, 0, model_.gravity}, seen.rotation.z,
                  model_.trust, model_.settling, now.period());
    s.body.incline(seen.feet, s.stride.believed(), seen.rotation.z, model_.leaning, now.period());
    drive(seen, now);
    tell(now);
  }

  static constexpr std::size_t save_size = 512;
  void save(Saver& to) const { to.put(state_); }
  void load(Loader& from) { state_ = from.get<State>(); }

 private:
  enum Input { at_position, at_velocity, at_orientation, at_rotation, at_acceleration, at_contact, at_command };
  enum Output { efforts, told_velocity, told_height, told_stands };

  struct State {
    GaitClock clock;
    BodyState body;
    Stride stride;
    Course course;
    double age = 0;  // s
    double has_fallen = 0;
  };
  static_assert(sizeof(State) <= save_size);

  /// Begins in the present place, at the present height.
  void begin(const Sensed& seen) {
    double ground = 0;
    for (const FootState& foot : seen.feet) ground += foot.position.z / legs;
    state_.course.heading = seen.attitude.yaw;
    state_.course.height = std::max(0.0, model_.foot_radius - ground);
    state_.stride.begin(seen);
  }

  Command command_of(const Step& now) const {
    const auto twist = now.input(at_command);
    if (!twist.empty()) return {twist[0], twist[1], twist[5]};
    return {now.tunable(tunable::forward), now.tunable(tunable::left), now.tunable(tunable::turn)};
  }

  /// Starts steps, once the robot is up, on a command, when a push moves it, and when its feet stand badly.
  void start_and_stop(const Sensed& seen, const Step& now) {
    State& s = state_;
    if (std::max(std::abs(seen.attitude.roll), std::abs(seen.attitude.pitch)) > fallen) s.has_fallen = 1;
    const bool is_up = std::abs(s.course.height - model_.height) < 1e-9 && s.age > rest;
    if (s.clock.runs == 0 && is_up && wants_to_step(seen, now, 1)) s.clock.start(model_.gait);
    s.clock.advance(model_.gait, now.period(), !wants_to_step(seen, now, 0.5));
  }
  /// `bound`: share of the thresholds above which a standing robot steps.
  bool wants_to_step(const Sensed& seen, const Step& now, double bound) const {
    const auto is_told = [](const Command& c) {
      return muro_hypot(c.forward, c.left) > 0.02 || std::abs(c.turn) > 0.02;
    };
    if (now.tunable(tunable::step_in_place) > 0.5 || is_told(command_of(now)) || is_told(state_.course.wanted))
      return true;
    if (muro_hypot(state_.body.velocity.x, state_.body.velocity.y) > bound * push_speed) return true;
    for (int i = 0; i < legs; ++i) {
      const Vector away = seen.feet[std::size_t(i)].position - model_.below_hip(i);
      if (muro_hypot(away.x, away.y) > bound * misplaced) return true;
    }
    return false;
  }

  /// Returns the wrench that the feet have to exert on the body.
  BodyWrench wanted_wrench(const Sensed& seen) const {
    const State& s = state_;
    const BodyGains& g = model_.gains;
    const Vector &v = s.body.velocity, &w = seen.rotation;
    const Command aim = s.course.aim();
    const double height = model_.foot_radius - s.body.ground;
    const double climb = g.height * (s.course.height - height) - g.climb * v.z;
    Vector push{g.speed * (aim.forward - v.x), g.speed * (aim.left - v.y),
                model_.gravity + std::max(climb, -0.8 * model_.gravity)};
    for (int i = 0; i < legs && s.clock.runs == 0; ++i) {
      const Vector away = seen.feet[std::size_t(i)].position - model_.below_hip(i);
      push = push + (g.place / legs) * Vector{away.x, away.y, 0};
    }
    const double yaw = std::clamp(examples::wrapped(s.course.heading - seen.attitude.yaw), -most_yaw, most_yaw);
    return {model_.mass * push,
            {model_.inertia.x * (-g.attitude * seen.attitude.roll - g.rotation * w.x),
             model_.inertia.y * (-g.attitude * seen.attitude.pitch - g.rotation * w.y),
             model_.inertia.z * (g.heading * yaw + g.turn * (aim.turn - w.z))}};
  }

  void drive(const Sensed& seen, const Step& now) const {
    const Vector middle = seen.level * seen.center_of_mass(model_), below{0, 0, -model_.foot_radius};
    std::array<Vector, legs> arms;
    for (std::size_t i = 0; i < legs; ++i) arms[i] = seen.feet[i].position + below - middle;
    const std::array<bool, legs> stands = state_.stride.stands();
    const std::array<Vector, legs> forces = model_.distribution.share(wanted_wrench(seen), stands, arms);
    const Rotation to_body = seen.level.inverse();
    const Vector up = to_body * Vector{0, 0, 1};
    for (int i = 0; i < legs; ++i) {
      const std::size_t at = std::size_t(i);
      const Vector weight = model_.leg[at].weight(seen.angles[at], model_.leg_masses, up, model_.gravity);
      const Vector push = stands[at] ? seen.contacts[at].efforts(to_body * -forces[at]) : swing_effort(seen, i);
      set_efforts(i, state_.has_fallen != 0 ? Vector{} : weight + push, now.output(efforts));
    }
  }
  void set_efforts(int i, const Vector& effort, std::span<double> targets) const {
    const double e[] = {effort.x, effort.y, effort.z}, most[] = {model_.effort.x, model_.effort.y, model_.effort.z};
    for (int j = 0; j < joints_of_leg; ++j) {
      const std::size_t joint = model_.joints.at(i, j);
      targets[joint] = model_.joints.sign[joint] * std::clamp(e[j], -most[j], most[j]);
    }
  }

  /// Returns the wanted motion of a foot that does not push, level frame: on its way to the next place, or straight
  /// down when there is no ground where it should be.
  Motion way_of(const Sensed& seen, int i) const {
    const std::size_t at = std::size_t(i);
    const LegState& leg = state_.stride.leg[at];
    const BodyState& body = state_.body;
    const Vector spin{0, 0, seen.rotation.z}, here = seen.feet[at].position;
    if (leg.swings == 0) {
      const Vector ground = -(body.velocity + cross(spin, here));
      return {here, {ground.x, ground.y, -model_.reach_speed}};
    }
    Vector to =
        model_.placement.target(model_.below_hip(i), body.velocity, state_.course.aim(), model_.gait.stance_time());
    to.z = body.ground + dot(body.slope, to) - model_.press;
    const Vector ground = -(body.velocity + cross(spin, to));
    return Arc{leg.lifted_at, model_.lift, model_.gait.swing_time()}.at(state_.clock.of(model_.gait, i).progress, to,
                                                                        {ground.x, ground.y, 0});
  }
  /// Returns efforts by a spring and a damper of each joint about this motion.
  Vector swing_effort(const Sensed& seen, int i) const {
    const std::size_t at = std::size_t(i);
    const Leg& leg = model_.leg[at];
    const Motion way = way_of(seen, i);
    const Rotation to_body = seen.level.inverse();
    const Vector missing = leg.angles(to_body * way.position - leg.hip) - seen.angles[at];
    // its velocity seen from the body, which turns
    const Vector moving = way.velocity + cross(Vector{0, 0, seen.rotation.z} - seen.rotation, way.position);
    const double least = stretched * leg.thigh * leg.thigh * leg.shank;
    const Vector rates = seen.jacobians[at].rates(to_body * moving, least), &is = seen.rates[at];
    const auto effort = [&](double stiffness, double damping, double angle, double rate, double rate_now) {
      return stiffness * angle + damping * (std::clamp(rate, -model_.speed, model_.speed) - rate_now);
    };
    const Vector &k = model_.stiffness, &d = model_.damping;
    return {effort(k.x, d.x, missing.x, rates.x, is.x), effort(k.y, d.y, missing.y, rates.y, is.y),
            effort(k.z, d.z, missing.z, rates.z, is.z)};
  }

  void tell(const Step& now) const {
    const Vector& v = state_.body.velocity;
    const double components[] = {v.x, v.y, v.z};
    std::copy_n(components, 3, now.output(told_velocity).begin());
    now.output(told_height)[0] = model_.foot_radius - state_.body.ground;
    for (std::size_t i = 0; i < legs; ++i) now.output(told_stands)[i] = state_.stride.leg[i].touched;
  }

  static constexpr double rest = 0.3;        // s: time before it trots
  static constexpr double push_speed = 0.3;  // m/s: a standing robot that is pushed steps from this speed on
  static constexpr double misplaced = 0.08;  // m: distance of a foot from its place, above which the robot steps
  static constexpr double most_yaw = 0.4;    // rad: greatest error that it corrects
  static constexpr double fallen = 1.2;      // rad: from this tilt on its drives are off
  static constexpr double stretched = 0.05;  // 1: determinant of a leg that is nearly straight

  Model model_;
  State state_;
};

}  // namespace quadruped

using quadruped::Trot;
MURO_CONTROLLER(Trot)
