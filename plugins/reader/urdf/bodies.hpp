// SPDX-License-Identifier: MIT
#pragma once

#include <urdf_model/link.h>

#include <map>

#include "model.hpp"
#include "muro/shape.hpp"
#include "plugins/common/model_file/missing_meshes.hpp"

namespace muro::urdf {

inline Pose pose_of(const ::urdf::Pose& p, const Quat& rotation) {
  return {{p.position.x, p.position.y, p.position.z}, rotation};
}

/// Sets the constants of a link's body: inertial and shapes.
class Bodies {
 public:
  Bodies(const Places& places, RobotBuilder& builder, Problems& problems)
      : places_(places), builder_(builder), problems_(problems) {}

  /// Sets the constants of the last part of the builder.
  void fill(const ::urdf::Link& link, const LinkInfo& info);
  /// Returns the mass of all bodies so far, kg.
  double mass() const { return mass_; }
  void report_missing_meshes() const { missing_.report(problems_); }

 private:
  enum class Purpose { collision, visual };

  void add_shape(std::vector<Shape>& shapes, Purpose purpose, const ::urdf::Geometry& geometry,
                 const ::urdf::Pose& origin, const LinkInfo::ShapeInfo& place, const LinkInfo& link);
  void add_texture(Shape& shape, const std::string& name, const ::urdf::Link& link, const LinkInfo& info);
  bool add_mesh(Shape& shape, Purpose purpose, const ::urdf::Mesh& mesh, const Location& location);
  Inertia inertial_of(const ::urdf::Link& link, const LinkInfo& info, std::span<const Shape> shapes);

  const Places& places_;
  RobotBuilder& builder_;
  Problems& problems_;
  std::map<std::string, model_file::MeshPath> meshes_;  ///< meshes by their name in the file
  model_file::MissingMeshes missing_;
  double mass_ = 0;
};

}  // namespace muro::urdf
