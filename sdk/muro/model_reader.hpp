// SPDX-License-Identifier: MIT
#pragma once

#include "muro/algorithm.hpp"
#include "muro/robot_builder.hpp"

namespace muro {

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
};

}  // namespace muro
