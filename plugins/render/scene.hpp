// SPDX-License-Identifier: MIT
// What of the world is drawn.
#pragma once

#include <string>
#include <vector>

#include "muro/connector.hpp"
#include "muro/shape.hpp"
#include "surface.hpp"

namespace muro::render {

enum class Look {
  as_seen,      ///< by eyes and cameras: `visual.shapes`, or `collision.shapes` where a body has none
  as_collides,  ///< by range finders: `collision.shapes`
};

/// A surface at a place on a body.
struct Piece {
  std::uint32_t surface = 0;  ///< number in Scene::surfaces
  Pose origin;                ///< in the frame of the body
  Vec3 scale = Vec3::Ones();  ///< of the surface, along its axes; m
  Vec3 color = Vec3::Ones();  ///< 0..1
  In<Pose> body;              ///< of a robot; unset for scenery
  Pose place;                 ///< of scenery
  ObjectId object = no_object;
  std::int32_t robot = -1;  ///< number; -1: scenery
  double radius = 0;        ///< m, of a ball about the origin that holds it
  bool endless = false;     ///< a plane: drawn as far as one sees

  Pose pose() const { return (body ? *body : place) * origin; }
};

class Scene {
 public:
  /// Finds all shapes and binds the poses of their bodies. Circles get `corners` corners. [setup]
  void connect(Connector& c, Look look, int corners);

  const std::vector<Surface>& surfaces() const { return surfaces_; }
  const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  void add_body(Connector& c, ObjectId object, const Piece& of_body, Look look);
  void add_shape(const Connector& c, const Shape& shape, Piece piece);
  std::uint32_t surface(const std::string& name, const Vec3& scale);

  int corners_ = 0;
  std::vector<std::string> names_;  ///< of the surfaces
  std::vector<double> radii_;       ///< of the surfaces
  std::vector<Surface> surfaces_;
  std::vector<Piece> pieces_;
};

}  // namespace muro::render
