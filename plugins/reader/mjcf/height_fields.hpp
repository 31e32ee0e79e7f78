// SPDX-License-Identifier: MIT
// Height fields of a compiled model as shapes. MuJoCo's compiler scales the values of a file to 0..1. muro's heightmaps
// keep the values of the file, so size and origin of the shape compensate for the difference.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "muro/shape.hpp"
#include "source.hpp"

namespace muro::mjcf {

/// A height field as a shape: a heightmap file, or a box if it is flat.
struct PlacedHeights {
  std::string path;  ///< absolute; empty: a box
  Vec3 size;         ///< see Shape::size
  Pose pose;         ///< in the frame of its geom
  double error = 0;  ///< m: largest difference of a node from MuJoCo, which reads 16-bit pictures with 8 bits
};

class HeightFields {
 public:
  HeightFields(const Compiled& compiled, const Source& source);

  /// Returns the height field of a geom. Returns nothing and sets `problem` if it cannot be a shape.
  std::optional<PlacedHeights> of(int geom, std::string& problem);

 private:
  std::optional<PlacedHeights> read(int number, std::string& problem) const;

  const mjModel& m_;
  const Source& source_;
  std::vector<std::string> paths_;  ///< one for each height field; empty: it has no file
  struct Known {
    std::optional<PlacedHeights> heights;
    std::string problem;
  };
  std::map<int, Known> known_;
};

}  // namespace muro::mjcf
