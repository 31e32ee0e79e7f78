// SPDX-License-Identifier: MIT
#pragma once

#include "muro/algorithm.hpp"
#include "muro/robot_builder.hpp"
#include "muro/shape.hpp"

namespace muro {

/// Takes a whole world from a file that describes one: scenery and models that can move. Misuse is reported by the
/// host.
class WorldBuilder {
 public:
  virtual void gravity(const Vec3& acceleration) noexcept = 0;  ///< m/s^2, world axes
  /// A body that stands still: what others touch, and what is seen of it.
  virtual void scenery(std::string_view name, const Pose& pose, std::span<const Shape> collisions,
                       std::span<const Shape> visuals) noexcept = 0;
  /// Begins a model whose base stands at `pose`; the builder is valid until the next call of this class.
  virtual RobotBuilder& model(std::string_view name, const Pose& pose) noexcept = 0;
  virtual TextId intern(std::string_view text) noexcept = 0;
  /// As RobotBuilder::report.
  virtual void report(Severity severity, std::string_view text, int line = 0, int column = 0) noexcept = 0;
  /// How the friction of a pair follows from those of its shapes: a FrictionRule (toolkit/pair_surface.hpp). It counts
  /// where the scenario names none.
  virtual void friction_rule(std::uint32_t rule) noexcept = 0;

 protected:
  ~WorldBuilder() = default;
};

/// Reads a robot model from a file. The second kind of thing a plugin can offer.
class ModelReader {
 public:
  ModelReader() = default;
  ModelReader(const ModelReader&) = delete;
  ModelReader& operator=(const ModelReader&) = delete;
  virtual ~ModelReader() = default;

  /// Reads `path` (absolute) and builds the robot. Problems go to `builder.report`, as many as there
  /// are; throw muro::Error only when nothing can be read at all. [setup]
  virtual void read(std::string_view path, RobotBuilder& builder) = 0;

  /// The same for a file that describes a world. [setup]
  virtual void read_world(std::string_view path, WorldBuilder& builder) {
    static_cast<void>(builder);
    throw Error(std::string(path) + " describes a robot, not a world; name it as the `model` of a robot");
  }
};

}  // namespace muro
