// SPDX-License-Identifier: MIT
#pragma once

#include "muro/algorithm.hpp"
#include "muro/robot_builder.hpp"
#include "muro/shape.hpp"

namespace muro {

/// Takes the content of a world file: scenery, and models that can move. The host reports misuse.
class WorldBuilder {
 public:
  virtual void gravity(const Vec3& acceleration) noexcept = 0;  ///< m/s^2, world axes
  /// A body that stands still: its shapes for collision, and those that cameras see.
  virtual void scenery(std::string_view name, const Pose& pose, const Rows<Shape>& collisions,
                       const Rows<Shape>& visuals) noexcept = 0;
  /// Begins a model whose base stands at `pose`; the builder is valid until the next call of this class.
  virtual RobotBuilder& model(std::string_view name, const Pose& pose) noexcept = 0;
  virtual TextId intern(std::string_view text) noexcept = 0;
  /// See RobotBuilder::report.
  virtual void report(Severity severity, std::string_view text, int line = 0, int column = 0) noexcept = 0;
  /// The rule for the friction of a pair of shapes: a FrictionRule (toolkit/pair_surface.hpp). A rule of the scenario
  /// has priority.
  virtual void friction_rule(std::uint32_t rule) noexcept = 0;
  /// Returns the host's extension of this name, version and layout, or null. [setup]
  virtual void* find_extension(const ExtensionId&) noexcept { return nullptr; }

 protected:
  ~WorldBuilder() = default;
};

/// Reads a robot model from a file: the second kind of class that a plugin can offer.
class ModelReader {
 public:
  ModelReader() = default;
  ModelReader(const ModelReader&) = delete;
  ModelReader& operator=(const ModelReader&) = delete;
  virtual ~ModelReader() = default;

  /// Reads `path` (absolute) and builds the robot. All problems go to `builder.report`; throws muro::Error only when
  /// nothing can be read at all. [setup]
  virtual void read(std::string_view path, RobotBuilder& builder) = 0;

  /// Reads a file that describes a world. [setup]
  virtual void read_world(std::string_view path, WorldBuilder& builder) {
    static_cast<void>(builder);
    throw Error(std::string(path) + " describes a robot, not a world; name it as the `model` of a robot");
  }
};

}  // namespace muro
