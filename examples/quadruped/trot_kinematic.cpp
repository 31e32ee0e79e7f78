// SPDX-License-Identifier: MIT
// Trots without forces, for levels at which the base moves as commanded (motion.point). Joints are driven by positions,
// so that standing feet stay where they are on level ground while the base moves on. Gait, legs and places of feet are
// those of `trot`, with the same tunables and arguments.
#include <algorithm>
#include <array>
#include <cmath>

#include "../common/vector.hpp"
#include "gait.hpp"
#include "model.hpp"
#include "muro_controller.hpp"
#include "placement.hpp"

namespace quadruped {

using namespace muro::controller;

class TrotKinematic {
 public:
  static constexpr const char* name = "trot_kinematic";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Trots on four legs of three joints, driven by positions, without forces";
  static constexpr muro_port inputs[] = {{"trot.command", "m/s, rad/s", 6, MURO_PORT_OPTIONAL}};
  static constexpr muro_port outputs[] = {{"joint.position.target", "rad", joints, 0},
                                          {"command.twist", "m/s, rad/s", 6, 0}};
  static constexpr auto& tunables = tunable::all;

  explicit TrotKinematic(const Setup& setup) : model_(setup) {
    for (int i = 0; i < legs; ++i) state_.foot[std::size_t(i)] = resting(i);
  }

  void step(const Step& now) {
    const double dt = now.period();
    const Command wanted = command_of(now);
    follow(wanted, dt);
    const Command& v = state_.velocity;
    const bool goes = now.tunable(tunable::step_in_place) > 0.5 || v.forward != 0 || v.left != 0 || v.turn != 0;
    if (goes && state_.clock.runs == 0) state_.clock.start(model_.gait);
    state_.clock.advance(model_.gait, dt, !goes);
    for (int i = 0; i < legs; ++i) move(i, wanted, dt);
    tell(now);
  }

  static constexpr std::size_t save_size = 512;
  void save(Saver& to) const { to.put(state_); }
  void load(Loader& from) { state_ = from.get<State>(); }

 private:
  enum Input { at_command };
  enum Output { targets, twist };

  struct State {
    GaitClock clock;
    Command velocity;                          // velocity of the base
    std::array<Vector, legs> foot, lifted_at;  // m, seen from the base, level
    std::array<double, legs> swings{};         // 1: in the air
  };
  static_assert(sizeof(State) <= save_size);

  Vector on_ground(Vector p) const {
    p.z = model_.foot_radius - model_.height;
    return p;
  }
  Vector resting(int i) const { return on_ground(model_.below_hip(i)); }

  Command command_of(const Step& now) const {
    const auto told = now.input(at_command);
    if (!told.empty()) return {told[0], told[1], told[5]};
    return {now.tunable(tunable::forward), now.tunable(tunable::left), now.tunable(tunable::turn)};
  }
  void follow(const Command& wanted, double dt) {
    const auto approach = [](double& value, double to, double most) { value += std::clamp(to - value, -most, most); };
    approach(state_.velocity.forward, wanted.forward, model_.acceleration * dt);
    approach(state_.velocity.left, wanted.left, model_.acceleration * dt);
    approach(state_.velocity.turn, wanted.turn, model_.turn_acceleration * dt);
  }

  /// Moves a foot. A standing foot goes back as the base goes on; a swinging foot goes to the place of Raibert's rule.
  /// A foot that came down or was lifted since the last step did so between the two steps.
  void move(int i, const Command& wanted, double dt) {
    const std::size_t at = std::size_t(i);
    Vector& foot = state_.foot[at];
    const LegPhase phase = state_.clock.of(model_.gait, i);
    const Vector velocity{state_.velocity.forward, state_.velocity.left, 0};
    const double stance = model_.gait.stance_time(), swing = model_.gait.swing_time();
    const Vector to = on_ground(model_.placement.target(model_.below_hip(i), velocity, wanted, stance));
    const bool swung = state_.swings[at] != 0;
    state_.swings[at] = phase.swings;
    if (!phase.swings) {
      foot = swung ? carried(to, std::min(dt, phase.progress * stance)) : carried(foot, dt);
      return;
    }
    if (!swung) state_.lifted_at[at] = carried(foot, std::max(0.0, dt - phase.progress * swing));
    const Vector ground = -1.0 * (velocity + cross(Vector{0, 0, state_.velocity.turn}, foot));
    foot = Arc{state_.lifted_at[at], model_.lift, swing}.at(phase.progress, to, ground).position;
  }
  /// Returns where a point of the ground is after the base has moved for `dt` s along its arc.
  Vector carried(const Vector& p, double dt) const {
    const Command& v = state_.velocity;
    const double angle = v.turn * dt, half_c = muro_cos(0.5 * angle), half_s = muro_sin(0.5 * angle);
    const double chord = std::abs(angle) > 1e-6 ? muro_sin(0.5 * angle) / (0.5 * angle) : 1;
    const double x = p.x - chord * dt * (half_c * v.forward - half_s * v.left);
    const double y = p.y - chord * dt * (half_s * v.forward + half_c * v.left);
    const double c = muro_cos(angle), s = muro_sin(angle);
    return {c * x + s * y, c * y - s * x, p.z};
  }

  void tell(const Step& now) const {
    const auto angles = now.output(targets);
    for (int i = 0; i < legs; ++i) {
      const Leg& leg = model_.leg[std::size_t(i)];
      const Vector q = leg.angles(state_.foot[std::size_t(i)] - leg.hip);
      const double of_joint[] = {q.x, q.y, q.z};
      for (int j = 0; j < joints_of_leg; ++j) {
        const std::size_t at = model_.joints.at(i, j);
        angles[at] = model_.joints.sign[at] * (of_joint[j] - model_.joints.offset[at]);
      }
    }
    const auto base = now.output(twist);
    base[0] = state_.velocity.forward, base[1] = state_.velocity.left, base[5] = state_.velocity.turn;
  }

  Model model_;
  State state_;
};

}  // namespace quadruped

MURO_CONTROLLER(quadruped::TrotKinematic)
