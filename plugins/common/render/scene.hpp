// SPDX-License-Identifier: MIT
// What of the world is drawn.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "image.hpp"
#include "muro/connector.hpp"
#include "muro/shape.hpp"
#include "surface.hpp"

namespace muro::render {

enum class Look {
  as_seen,      ///< by eyes and cameras: `visual.shapes`, or `collision.shapes` where a body has none
  as_collides,  ///< by range finders: `collision.shapes`, without paint
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

/// A solid shape on a body: to tell whether an eye is in it.
struct Volume {
  Shape shape;
  In<Pose> body;  ///< of a robot; unset for scenery
  Pose place;     ///< of scenery
  ObjectId object = no_object;
  std::int32_t robot = -1;  ///< number; -1: scenery
  double radius = 0;        ///< m, of a ball about the body's origin that holds it; infinite for a plane

  /// Whether it holds a point of the world (m); a mesh holds none.
  bool holds(const Vec3& point) const;
};

class Scene {
 public:
  /// Finds all shapes and binds the poses of their bodies. Circles get so many corners that they lie at most `chord`
  /// (m) inside of themselves. What cannot be read of how things look is told as a warning, and left out. [setup]
  void connect(Connector& c, Look look, double chord);

  const std::vector<Surface>& surfaces() const { return surfaces_; }
  const std::vector<Image>& pictures() const { return pictures_; }
  const std::vector<Piece>& pieces() const { return pieces_; }
  const std::vector<Volume>& volumes() const { return volumes_; }

 private:
  struct Part {
    std::uint32_t surface = 0;
    Vec3 color = Vec3::Ones();
  };

  void add_body(Connector& c, ObjectId object, const Piece& of_body, Look look);
  void add_shape(Connector& c, const Shape& shape, Piece piece, Look look);
  void add_mesh(Connector& c, const Shape& shape, Piece piece, Look look);
  /// The surface of a kind of shape with so many corners, and a picture (-1: none).
  std::uint32_t basic(const std::string& name, int corners, std::int32_t picture);
  std::uint32_t keep(Surface surface);
  std::int32_t picture_of(Connector& c, const std::string& path, std::span<const std::uint8_t> bytes = {});

  double chord_ = 0;
  std::map<std::tuple<std::string, int, std::int32_t>, std::uint32_t> basics_;
  /// By file and what paints them, and scale.
  std::map<std::tuple<std::string, double, double, double>, std::vector<Part>> meshes_;
  std::map<std::string, std::int32_t> picture_numbers_;
  std::vector<double> radii_;  ///< of the surfaces
  std::vector<Surface> surfaces_;
  std::vector<Image> pictures_;
  std::vector<Piece> pieces_;
  std::vector<Volume> volumes_;
};

}  // namespace muro::render
