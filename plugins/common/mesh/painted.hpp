// SPDX-License-Identifier: MIT
// Meshes as they look: with normals, materials and pictures.
#pragma once

#include "mesh.hpp"

namespace muro::mesh {

/// A corner as its file has it.
struct Corner {
  Vec3 position;                                      ///< m
  Vec3 normal;                                        ///< unit
  Eigen::Vector2d picture = Eigen::Vector2d::Zero();  ///< place on the picture: across and down, 0..1, repeated
};

/// What of a mesh has one material.
struct PaintedPart {
  std::vector<Corner> corners;
  std::vector<Triangle> triangles;
  Eigen::Vector4d color = Eigen::Vector4d(0.7, 0.7, 0.7, 1);  ///< red, green, blue, alpha, 0..1
  std::string picture;                                        ///< path of its picture, or a name; empty: none
  std::string missing;  ///< what the file calls a picture that is not there, or not to be read; empty: none
  std::vector<std::uint8_t> picture_bytes;  ///< of a file that holds its pictures itself: as a PNG or JPEG file
};

/// Reads a file as load() does, but for what it is for: corners are not joined, and each part has the material that the
/// file gives it (the diffuse or base colour). Corners without a normal get one, common to faces that meet at less than
/// 40 degrees. Pictures are looked for beside the file. [setup]
std::vector<PaintedPart> load_painted(const std::string& path, const Vec3& scale);

}  // namespace muro::mesh
