// SPDX-License-Identifier: MIT
// Builders that record their calls.
#pragma once

#include <optional>

#include "call.hpp"
#include "muro/model_reader.hpp"
#include "plugins/common/parser_process/message.hpp"

namespace muro::builder_calls {

/// Writes the calls of a reader to a message. Texts get the numbers 1, 2, ...
class RobotRecorder final : public RobotBuilder {
 public:
  explicit RobotRecorder(parser_process::Writer& out) : out_(out) {}

  void base(std::string_view name) noexcept override;
  void fork() noexcept override;
  void end() noexcept override;
  void translation(const Vec3& offset) noexcept override;
  void rotation(const Quat& turn) noexcept override;
  void revolute(std::string_view name, const Vec3& axis, const JointLimits& limits) noexcept override;
  void prismatic(std::string_view name, const Vec3& axis, const JointLimits& limits) noexcept override;
  void mimic(std::string_view leader, double multiplier, double offset) noexcept override;
  void body(std::string_view name) noexcept override;
  TextId intern(std::string_view text) noexcept override;
  void report(Severity severity, std::string_view text, int line, int column) noexcept override;

 private:
  void set_raw(const KeyInfo& key, const void* data, std::uint32_t count) noexcept override;
  void joint(Call kind, std::string_view name, const Vec3& axis, const JointLimits& limits);

  parser_process::Writer& out_;
  std::uint32_t texts_ = 0;
};

/// Writes the calls of a reader for a world to a message.
class WorldRecorder final : public WorldBuilder {
 public:
  explicit WorldRecorder(parser_process::Writer& out) : out_(out) {}

  void gravity(const Vec3& acceleration) noexcept override;
  void scenery(std::string_view name, const Pose& pose, const Rows<Shape>& collisions,
               const Rows<Shape>& visuals) noexcept override;
  RobotBuilder& model(std::string_view name, const Pose& pose) noexcept override;
  TextId intern(std::string_view text) noexcept override;
  void report(Severity severity, std::string_view text, int line, int column) noexcept override;
  void friction_rule(std::uint32_t rule) noexcept override;

 private:
  parser_process::Writer& out_;
  std::optional<RobotRecorder> model_;
  std::uint32_t texts_ = 0;
};

}  // namespace muro::builder_calls
