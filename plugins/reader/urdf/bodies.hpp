// SPDX-License-Identifier: MIT
#pragma once

#include <urdf_model/link.h>

#include <filesystem>
#include <map>

#include "model.hpp"
#include "muro/shape.hpp"
#include "plugins/common/model_file/mesh_path.hpp"

namespace muro::urdf {

inline Pose pose_of(const ::urdf::Pose& p, const Quat& rotation) {
  return {{p.position.x, p.position.y, p.position.z}, rotation};
}

/// Sets the constants of a link's body: inertial and shapes.
class Bodies {
 public:
  Bodies(std::filesystem::path folder, RobotBuilder& builder, Problems& problems)
      : folder_(std::move(folder)), builder_(builder), problems_(problems) {}

  /// For the last part of the builder.
  void fill(const ::urdf::Link& link, const LinkInfo& info);
  /// kg, of all bodies so far.
  double mass() const { return mass_; }

 private:
  enum class Purpose { collision, visual };
  struct NamedMesh {
    model_file::MeshPath found;
    bool is_told = false, is_error = false;  ///< where it is not found
  };

  void add_shape(std::vector<Shape>& shapes, Purpose purpose, const ::urdf::Geometry& geometry, const Pose& origin,
                 const ::urdf::Link& link, const LinkInfo& info);
  void add_texture(Shape& shape, const std::string& name, const ::urdf::Link& link, const LinkInfo& info);
  bool add_mesh(Shape& shape, Purpose purpose, const ::urdf::Mesh& mesh, const ::urdf::Link& link,
                const LinkInfo& info);
  void report_missing(NamedMesh& mesh, Purpose purpose, const std::string& name, const ::urdf::Link& link,
                      const LinkInfo& info);
  Inertia inertial_of(const ::urdf::Link& link, const LinkInfo& info, std::span<const Shape> shapes);

  std::filesystem::path folder_;
  RobotBuilder& builder_;
  Problems& problems_;
  std::map<std::string, NamedMesh> meshes_;  ///< by the name in the file
  double mass_ = 0;
};

}  // namespace muro::urdf
