// SPDX-License-Identifier: MIT
#include "record.hpp"

#include <cassert>

namespace muro::builder_calls {

namespace {

void write_text(parser_process::Writer& out, Call call, std::string_view text) {
  out.value(call);
  out.text(text);
}

void write_report(parser_process::Writer& out, Call call, Severity severity, std::string_view text, int line,
                  int column) {
  out.value(call);
  out.value(severity);
  out.text(text);
  out.value(line);
  out.value(column);
}

}  // namespace

void RobotRecorder::base(std::string_view name) noexcept { write_text(out_, Call::base, name); }

void RobotRecorder::fork() noexcept { out_.value(Call::fork); }

void RobotRecorder::end() noexcept { out_.value(Call::end); }

void RobotRecorder::translation(const Vec3& offset) noexcept {
  out_.value(Call::translation);
  out_.value(offset);
}

void RobotRecorder::rotation(const Quat& turn) noexcept {
  out_.value(Call::rotation);
  out_.value(turn);
}

void RobotRecorder::revolute(std::string_view name, const Vec3& axis, const JointLimits& limits) noexcept {
  joint(Call::revolute, name, axis, limits);
}

void RobotRecorder::prismatic(std::string_view name, const Vec3& axis, const JointLimits& limits) noexcept {
  joint(Call::prismatic, name, axis, limits);
}

void RobotRecorder::joint(Call kind, std::string_view name, const Vec3& axis, const JointLimits& limits) {
  out_.value(kind);
  out_.text(name);
  out_.value(axis);
  out_.value(limits);
}

void RobotRecorder::mimic(std::string_view leader, double multiplier, double offset) noexcept {
  out_.value(Call::mimic);
  out_.text(leader);
  out_.value(multiplier);
  out_.value(offset);
}

void RobotRecorder::body(std::string_view name) noexcept { write_text(out_, Call::body, name); }

TextId RobotRecorder::intern(std::string_view text) noexcept {
  write_text(out_, Call::intern, text);
  return TextId(++texts_);
}

void RobotRecorder::report(Severity severity, std::string_view text, int line, int column) noexcept {
  write_report(out_, Call::report, severity, text, line, column);
}

void RobotRecorder::set_raw(const KeyInfo& key, const void* data, std::uint32_t count) noexcept {
  for (const auto& [call, known] : constants) {
    if (known->name != key.name) continue;
    out_.value(call);
    switch (call) {
      case Call::inertial:
        return out_.value(*static_cast<const Inertia*>(data));
      case Call::collision_shapes:
      case Call::visual_shapes:
        return out_.list(std::span(static_cast<const Shape*>(data), count));
      case Call::visual_materials:
      case Call::model_subsystems:
        return out_.list(std::span(static_cast<const TextId*>(data), count));
      case Call::model_subsystem_places:
        return out_.list(std::span(static_cast<const std::int32_t*>(data), count));
      case Call::initial_joint_position:
      case Call::joint_drive_stiffness:
      case Call::joint_drive_damping:
      case Call::joint_position_target:
        return out_.value(*static_cast<const double*>(data));
      default:
        return out_.value(*static_cast<const std::uint32_t*>(data));
    }
  }
  assert(!"a constant that Call does not have");
}

void WorldRecorder::gravity(const Vec3& acceleration) noexcept {
  out_.value(Call::gravity);
  out_.value(acceleration);
}

void WorldRecorder::friction_rule(std::uint32_t rule) noexcept {
  out_.value(Call::friction_rule);
  out_.value(rule);
}

void WorldRecorder::scenery(std::string_view name, const Pose& pose, const Rows<Shape>& collisions,
                            const Rows<Shape>& visuals) noexcept {
  out_.value(Call::scenery);
  out_.text(name);
  out_.value(pose);
  out_.list(std::span<const Shape>(std::vector<Shape>(collisions.begin(), collisions.end())));
  out_.list(std::span<const Shape>(std::vector<Shape>(visuals.begin(), visuals.end())));
}

RobotBuilder& WorldRecorder::model(std::string_view name, const Pose& pose) noexcept {
  out_.value(Call::model);
  out_.text(name);
  out_.value(pose);
  return model_.emplace(out_);
}

TextId WorldRecorder::intern(std::string_view text) noexcept {
  write_text(out_, Call::world_intern, text);
  return TextId(++texts_);
}

void WorldRecorder::report(Severity severity, std::string_view text, int line, int column) noexcept {
  write_report(out_, Call::world_report, severity, text, line, column);
}

}  // namespace muro::builder_calls
