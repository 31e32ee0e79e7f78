// SPDX-License-Identifier: MIT
// Height fields of a compiled model as shapes. MuJoCo's compiler stretches the values of a file to 0..1; muro's
// heightmaps have them as they are in the file, so that size and origin make up for it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "muro/shape.hpp"
#include "source.hpp"

namespace muro::mjcf {

/// A height field as a shape: that of a file, or a box where it is flat.
struct PlacedHeights {
  std::string path;  ///< absolute; empty: a box
  Vec3 size;         ///< as Shape::size
  Pose pose;         ///< in the frame of its geom
  double error = 0;  ///< m: how far a node of the file is from MuJoCo's, which reads 8 bits of pictures of 16
};

class HeightFields {
 public:
  HeightFields(const Compiled& compiled, const Source& source);

  /// The height field of a geom; nothing, and why, where it cannot be a shape.
  std::optional<PlacedHeights> of(int geom, std::string& problem);

 private:
  std::optional<PlacedHeights> read(int number, std::string& problem) const;

  const mjModel& m_;
  const Source& source_;
  std::vector<std::string> paths_;  ///< one a height field; empty: it has no file
  struct Known {
    std::optional<PlacedHeights> heights;
    std::string problem;
  };
  std::map<int, Known> known_;
};

}  // namespace muro::mjcf
