// SPDX-License-Identifier: MIT
// Trots: diagonal pairs of legs swing in turn to where Raibert's rule puts their feet, the others push so that the body
// keeps its height, its attitude and its speed. Joints are driven by efforts. All numbers of the robot are tunables and
// arguments (model.hpp, README.md); by default those of examples/models/quadruped.urdf.
#include <algorithm>
#include <array>
#include <cmath>

#include "balance.hpp"
#include "estimate.hpp"
#include "gait.hpp"
#include "leg.hpp"
#include "model.hpp"
#include "muro_controller.hpp"
#include "placement.hpp"
#include "vector.hpp"

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
    const Sensed seen = sense(now);
    if (now.index() == 0) begin(seen);
    follow(command_of(now), now.period());
    decide(seen, now);
    s.clock.advance(model_.gait, now.period(), !wants_to_step(seen, now, 0.5));
    lift_and_land(seen, now);
    const Vector force = seen.level * seen.force;
    s.body.update(seen.feet, stands(), force - Vector{0, 0, model_.gravity}, seen.rotation.z, model_.trust,
                  model_.settling, now.period());
    drive(seen, now);
    tell(now);
  }

  static constexpr std::size_t save_size = 512;
  void save(Saver& to) const { to.put(state_); }
  void load(Loader& from) { state_ = from.get<State>(); }

 private:
  enum Input { at_position, at_velocity, at_orientation, at_rotation, at_acceleration, at_contact, at_command };
  enum Output { efforts, told_velocity, told_height, told_stands };

  /// What the sensors say, in a level frame with the heading of the body.
  struct Sensed {
    Rotation level;                                       ///< from the frame of the body
    Angles attitude;                                      ///< rad
    Vector rotation;                                      ///< rad/s
    Vector force;                                         ///< m/s^2, specific force, frame of the body
    std::array<Vector, legs> angles, rates;               ///< rad, rad/s
    std::array<Leg::Jacobian, legs> jacobians, contacts;  ///< of the middle of the foot, and of its lowest point
    std::array<FootState, legs> feet;                     ///< the middle; velocity of the lowest point
    std::array<bool, legs> touches;
    bool feels = false;  ///< whether the feet tell what they touch
  };

  /// Of a leg, kept from step to step.
  struct LegState {
    double swings = 0, touched = 1;  ///< 1: yes. touched: it has found the ground since it was lifted
    Vector lifted_at;                ///< m, seen from the body, level
    Vector angles;                   ///< rad: what its joints are sent to
  };
  struct State {
    GaitClock clock;
    BodyState body;
    std::array<LegState, legs> leg;
    Command wanted;      ///< what it follows, as fast as it may
    Vector trim;         ///< m/s: by which it aims beyond what is wanted
    double heading = 0;  ///< rad: wanted
    double height = 0;   ///< m: wanted, of the origin above the ground
    double has_fallen = 0;
  };
  static_assert(sizeof(State) <= save_size);

  Sensed sense(const Step& now) const {
    Sensed seen;
    const Rotation r = Rotation::of(now.input(at_orientation));
    seen.attitude = Angles::of(r);
    seen.level = levelled(r, seen.attitude.yaw);
    const auto gyro = now.input(at_rotation), force = now.input(at_acceleration);
    const Vector turning{gyro[0], gyro[1], gyro[2]};
    seen.rotation = seen.level * turning;
    seen.force = {force[0], force[1], force[2]};
    seen.feels = !now.input(at_contact).empty();
    for (int i = 0; i < legs; ++i) {
      const std::size_t at = std::size_t(i);
      const Leg& leg = model_.leg[at];
      seen.angles[at] = model_.joints.angles(i, now.input(at_position));
      seen.rates[at] = model_.joints.rates(i, now.input(at_velocity));
      const Vector below = seen.level.back({0, 0, -model_.foot_radius});
      seen.jacobians[at] = leg.jacobian(seen.angles[at]);
      seen.contacts[at] = leg.jacobian(seen.angles[at], below);
      const Vector foot = leg.hip + leg.foot(seen.angles[at]);
      seen.feet[at].position = seen.level * foot;
      seen.feet[at].velocity = seen.level * (seen.contacts[at] * seen.rates[at] + cross(turning, foot + below));
      seen.touches[at] = seen.feels && now.input(at_contact)[std::size_t(model_.joints.place[at])] > 0.5;
    }
    return seen;
  }

  void begin(const Sensed& seen) {
    state_.heading = seen.attitude.yaw;
    double ground = 0;
    for (const FootState& foot : seen.feet) ground += foot.position.z / legs;
    state_.height = std::max(0.0, model_.foot_radius - ground);
  }

  Command command_of(const Step& now) const {
    const auto twist = now.input(at_command);
    if (!twist.empty()) return {twist[0], twist[1], twist[5]};
    return {now.tunable(tunable::forward), now.tunable(tunable::left), now.tunable(tunable::turn)};
  }

  static double nearer(double from, double to, double most) { return from + std::clamp(to - from, -most, most); }

  /// Commands and the height come evenly.
  void follow(const Command& told, double dt) {
    State& s = state_;
    s.height = nearer(s.height, model_.height, model_.climb * dt);
    const Command go = s.clock.runs == 0 ? Command{} : told;
    s.wanted.forward = nearer(s.wanted.forward, go.forward, model_.acceleration * dt);
    s.wanted.left = nearer(s.wanted.left, go.left, model_.acceleration * dt);
    s.wanted.turn = nearer(s.wanted.turn, go.turn, model_.turn_acceleration * dt);
    s.heading += s.wanted.turn * dt;
    // a push, which the feet answer by themselves, is not to wind it up
    const auto missing = [&](double is, double told_speed) {
      return std::clamp(told_speed - is, -slow_error, slow_error);
    };
    const double gain = s.clock.runs * model_.gains.trim * dt;
    const double x = s.trim.x + gain * missing(s.body.velocity.x, s.wanted.forward);
    const double y = s.trim.y + gain * missing(s.body.velocity.y, s.wanted.left);
    s.trim = {std::clamp(x, -most_trim, most_trim), std::clamp(y, -most_trim, most_trim), 0};
    if (s.clock.runs == 0) s.trim = {};
  }

  /// What the speed is held to.
  Command aim() const {
    Command c = state_.wanted;
    c.forward += state_.trim.x, c.left += state_.trim.y;
    return c;
  }

  /// `bound` of what a push may do before it steps, in fractions.
  bool wants_to_step(const Sensed& seen, const Step& now, double bound) const {
    const Command told = command_of(now), &w = state_.wanted;
    if (now.tunable(tunable::step_in_place) > 0.5) return true;
    if (std::hypot(told.forward, told.left) > 0.01 || std::abs(told.turn) > 0.02) return true;
    if (std::hypot(w.forward, w.left) > 0.02 || std::abs(w.turn) > 0.05) return true;
    if (std::hypot(state_.body.velocity.x, state_.body.velocity.y) > bound * push_speed) return true;
    for (int i = 0; i < legs; ++i) {
      const Vector away = seen.feet[std::size_t(i)].position - model_.below_hip(i);
      if (std::hypot(away.x, away.y) > bound * misplaced) return true;
    }
    return false;
  }

  void decide(const Sensed& seen, const Step& now) {
    State& s = state_;
    if (std::max(std::abs(seen.attitude.roll), std::abs(seen.attitude.pitch)) > fallen) s.has_fallen = 1;
    const bool is_up = std::abs(s.height - model_.height) < 1e-9 && now.time() > rest;
    if (s.clock.runs == 0 && is_up && wants_to_step(seen, now, 1)) s.clock.start(model_.gait);
  }

  void lift_and_land(const Sensed& seen, const Step&) {
    for (int i = 0; i < legs; ++i) {
      const std::size_t at = std::size_t(i);
      LegState& leg = state_.leg[at];
      const LegPhase phase = state_.clock.of(model_.gait, i);
      if (phase.swings && leg.swings == 0) leg.touched = 0, leg.lifted_at = seen.feet[at].position;
      leg.swings = phase.swings;
      if (!seen.feels)
        leg.touched = !phase.swings;
      else if (seen.touches[at] && (!phase.swings || phase.progress > landing))
        leg.touched = 1;
    }
  }

  std::array<bool, legs> stands() const {
    std::array<bool, legs> all{};
    for (std::size_t i = 0; i < legs; ++i) all[i] = state_.leg[i].touched != 0;
    return all;
  }

  /// What the feet have to do to the body.
  BodyWrench wanted_wrench(const Sensed& seen) const {
    const State& s = state_;
    const BodyGains& g = model_.gains;
    const Vector& v = s.body.velocity;
    const double height = model_.foot_radius - s.body.ground;
    const Command aimed = aim();
    Vector acceleration{g.speed * (aimed.forward - v.x), g.speed * (aimed.left - v.y),
                        model_.gravity + g.height * (s.height - height) - g.climb * v.z};
    if (s.clock.runs == 0) {
      for (int i = 0; i < legs; ++i) {
        const Vector away = seen.feet[std::size_t(i)].position - model_.below_hip(i);
        acceleration.x += g.place / legs * away.x, acceleration.y += g.place / legs * away.y;
      }
    }
    const double yaw = std::clamp(std::remainder(s.heading - seen.attitude.yaw, 2 * pi), -most_yaw, most_yaw);
    const Vector& w = seen.rotation;
    const Vector turning{-g.attitude * seen.attitude.roll - g.rotation * w.x,
                         -g.attitude * seen.attitude.pitch - g.rotation * w.y,
                         g.heading * yaw + g.turn * (s.wanted.turn - w.z)};
    acceleration.z = std::max(acceleration.z, 0.2 * model_.gravity);
    return {model_.mass * acceleration,
            {model_.inertia.x * turning.x, model_.inertia.y * turning.y, model_.inertia.z * turning.z}};
  }

  void drive(const Sensed& seen, const Step& now) {
    std::array<Vector, legs> arms;
    const Vector middle = seen.level * model_.center, below{0, 0, -model_.foot_radius};
    for (std::size_t i = 0; i < legs; ++i) arms[i] = seen.feet[i].position + below - middle;
    const std::array<Vector, legs> forces = model_.distribution.share(wanted_wrench(seen), stands(), arms);
    const std::span<double> target = now.output(efforts);
    for (int i = 0; i < legs; ++i) {
      const std::size_t at = std::size_t(i);
      Vector effort;
      if (state_.leg[at].touched != 0)
        effort = seen.contacts[at].efforts(seen.level.back(-forces[at]));
      else
        effort = swing_effort(seen, i);
      const double most[] = {model_.effort.x, model_.effort.y, model_.effort.z}, e[] = {effort.x, effort.y, effort.z};
      for (int j = 0; j < joints_of_leg; ++j) {
        const std::size_t joint = model_.joints.at(i, j);
        target[joint] = state_.has_fallen != 0 ? 0 : model_.joints.sign[joint] * std::clamp(e[j], -most[j], most[j]);
      }
    }
  }

  /// On its way to the next place, or, where the ground should be and is not, straight down.
  Vector swing_effort(const Sensed& seen, int i) {
    const std::size_t at = std::size_t(i);
    LegState& leg = state_.leg[at];
    const LegPhase phase = state_.clock.of(model_.gait, i);
    const Vector spin{0, 0, seen.rotation.z};
    Motion way;  // level frame
    if (leg.swings != 0) {
      Vector to = model_.placement.target(model_.below_hip(i), state_.body.velocity, aim(), model_.gait.stance_time());
      to.z = state_.body.ground - model_.press;
      const Vector ground = -(state_.body.velocity + cross(spin, to));
      way = Arc{leg.lifted_at, model_.lift, model_.gait.swing_time()}.at(phase.progress, to, {ground.x, ground.y, 0});
      leg.angles = model_.leg[at].angles(seen.level.back(way.position) - model_.leg[at].hip);
    } else {
      way.position = seen.feet[at].position;
      way.velocity = -(state_.body.velocity + cross(spin, way.position));
      way.velocity.z = -model_.reach_speed;
      leg.angles = seen.angles[at];
    }
    // the same velocity seen from the body, which turns
    const Vector moving = way.velocity + cross(spin - seen.rotation, way.position);
    const Vector rates = seen.jacobians[at].rates(
        seen.level.back(moving), stretched * model_.leg[at].thigh * model_.leg[at].thigh * model_.leg[at].shank);
    const auto effort = [&](double to, double from, double rate, double is) {
      const double bounded = std::clamp(rate, -model_.rate_most, model_.rate_most);
      return model_.swing_stiffness * (to - from) + model_.swing_damping * (bounded - is);
    };
    const Vector &q = seen.angles[at], &v = seen.rates[at];
    return {effort(leg.angles.x, q.x, rates.x, v.x), effort(leg.angles.y, q.y, rates.y, v.y),
            effort(leg.angles.z, q.z, rates.z, v.z)};
  }

  void tell(const Step& now) const {
    const Vector& v = state_.body.velocity;
    const double components[] = {v.x, v.y, v.z};
    std::copy_n(components, 3, now.output(told_velocity).begin());
    now.output(told_height)[0] = model_.foot_radius - state_.body.ground;
    for (std::size_t i = 0; i < legs; ++i) now.output(told_stands)[i] = state_.leg[i].touched;
  }

  static constexpr double pi = 3.14159265358979323846;
  static constexpr double rest = 0.3;        // s: before it trots
  static constexpr double landing = 0.5;     // part of a swing after which it may touch
  static constexpr double push_speed = 0.3;  // m/s: it steps when it stands and is pushed
  static constexpr double misplaced = 0.08;  // m: a foot from its place, before it steps
  static constexpr double most_yaw = 0.4;    // rad: what it answers to
  static constexpr double most_trim = 0.2;   // m/s
  static constexpr double slow_error = 0.1;  // m/s
  static constexpr double fallen = 1.2;      // rad: from there on its drives are off
  static constexpr double stretched = 0.05;  // 1: determinant of a leg that is nearly straight

  Model model_;
  State state_;
};

}  // namespace quadruped

using quadruped::Trot;
MURO_CONTROLLER(Trot)
