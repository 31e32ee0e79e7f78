// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "height_fields.hpp"
#include "meshes.hpp"
#include "muro/shape.hpp"

namespace muro::mjcf {

using Intern = std::function<TextId(std::string_view)>;

/// Shapes made of the geoms of a body.
struct Solid {
  std::vector<Shape> collisions, visuals;
  std::vector<TextId> materials;  ///< names, one for each visual
};

/// Geoms of a compiled model as shapes. Geoms that collide with nothing (contype and conaffinity 0) are visuals only.
/// Geoms of groups from 3 on are not visible, as in MuJoCo's viewer.
class Shapes {
 public:
  Shapes(const Compiled& compiled, const Source& source);

  /// Adds geom `number` to `solid`, or records that it has no shape. `body`: pose of its body in the frame of `solid`.
  void add(int number, const Pose& body, const Intern& intern, Solid& solid);
  /// Reports the geoms that were left out, one message for each cause.
  void report_left_out(Problems& problems) const;

  /// Returns "wheel", or "geom 3 of `chassis`" as text without quotes.
  std::string name_of_geom(int number) const;

 private:
  std::optional<Shape> shape_of(int number, const Intern& intern, std::string& problem);
  std::optional<Shape> heights_of(int number, const Intern& intern, std::string& problem);
  Surface surface_of(int number) const;
  /// Whether a geom collides with others.
  bool is_to_touch(int geom) const;

  const mjModel& m_;
  const Source& source_;
  Meshes meshes_;
  HeightFields height_fields_;
  std::vector<std::pair<std::string, std::vector<int>>> left_out_;  ///< reasons, each with its geoms
  std::map<int, double> rounded_;                                   ///< difference of a geom's heights from MuJoCo's, m
};

}  // namespace muro::mjcf
