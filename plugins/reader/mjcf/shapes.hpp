// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "height_fields.hpp"
#include "meshes.hpp"
#include "muro/shape.hpp"

namespace muro::mjcf {

using Intern = std::function<TextId(std::string_view)>;

/// What geoms become.
struct Solid {
  std::vector<Shape> collisions, visuals;
  std::vector<TextId> materials;  ///< names, of the visuals
};

/// Geoms of a compiled model as shapes. Those that collide with nothing (contype and conaffinity 0) are only seen;
/// groups from 3 on, which MuJoCo's viewer hides, are not seen.
class Shapes {
 public:
  Shapes(const Compiled& compiled, const Source& source);

  /// Adds geom `number`, in a frame in which that of its body has pose `body`. Notes those that have no shape.
  void add(int number, const Pose& body, const Intern& intern, Solid& solid);
  /// Tells, once for each cause, which geoms were left out.
  void report_left_out(Problems& problems) const;

  /// "wheel", or "geom 3 of `chassis`" as text without quotes.
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
  std::vector<std::pair<std::string, std::vector<int>>> left_out_;  ///< why, and which geoms
  std::map<int, double> rounded_;                                   ///< geoms whose heights differ from MuJoCo's, by m
};

}  // namespace muro::mjcf
