// SPDX-License-Identifier: MIT
// Meshes for rendering: with normals, materials and textures.
#pragma once

#include "mesh.hpp"

namespace muro::mesh {

struct TexturedVertex {
  Vec3 position;                                                  ///< m
  Vec3 normal;                                                    ///< unit
  Eigen::Vector2d texture_coordinates = Eigen::Vector2d::Zero();  ///< across and down, 0..1, repeated
};

/// The part of a mesh that has one material.
struct Submesh {
  std::vector<TexturedVertex> vertices;
  std::vector<Triangle> triangles;
  Eigen::Vector4d color = Eigen::Vector4d(0.7, 0.7, 0.7, 1);  ///< red, green, blue, alpha, 0..1
  std::string texture;          ///< path of the texture, or the name of an embedded one; empty: none
  std::string missing_texture;  ///< name, in the file, of a texture that is not found or not supported; empty: none
  std::vector<std::uint8_t> texture_bytes;  ///< of an embedded texture: a PNG or JPEG file
};

/// Reads a file as load() does, but does not join vertices. Each submesh has the material that the file gives it (the
/// diffuse or base colour). Vertices without a normal get one, common to faces that meet at less than 40 degrees.
/// Textures are searched beside the file. [setup]
std::vector<Submesh> load_submeshes(const std::string& path, const Vec3& scale);

}  // namespace muro::mesh
