// SPDX-License-Identifier: MIT
#include "read_mesh.hpp"

#include <algorithm>

#include "mesh_file.hpp"
#include "muro/algorithm.hpp"
#include "muro/base/limits.hpp"

namespace muro::mesh {
namespace {

/// All components except positions and faces.
constexpr unsigned unused_by_collision = aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                         aiComponent_COLORS | aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS |
                                         aiComponent_ANIMATIONS | aiComponent_TEXTURES | aiComponent_LIGHTS |
                                         aiComponent_CAMERAS | aiComponent_MATERIALS;

void add(const aiMesh& m, const Eigen::Matrix4d& at, Mesh& out) {
  const bool is_mirrored = at.topLeftCorner<3, 3>().determinant() < 0;
  const auto first = std::uint32_t(out.vertices.size());
  for (unsigned v = 0; v < m.mNumVertices; ++v) {
    const aiVector3D& p = m.mVertices[v];
    out.vertices.push_back((at * Eigen::Vector4d(double(p.x), double(p.y), double(p.z), 1)).head<3>());
  }
  for (unsigned f = 0; f < m.mNumFaces; ++f) {
    const aiFace& face = m.mFaces[f];
    if (face.mNumIndices != 3) continue;  // a point or a line
    Triangle t{first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]};
    if (is_mirrored) std::swap(t[1], t[2]);
    out.triangles.push_back(t);
  }
}

bool is_position(const Vec3& v) { return limits::within(limits::position, v); }

}  // namespace

Mesh read_mesh(const std::string& path, const Vec3& scale) {
  const auto fail = [&](const std::string& what) -> Error { return Error("mesh " + path + " " + what); };
  const MeshFile file(path, scale, unused_by_collision, 0);
  Mesh m;
  file.each_mesh([&](const aiMesh& mesh, const Eigen::Matrix4d& at) { add(mesh, at, m); });
  if (!std::all_of(m.vertices.begin(), m.vertices.end(), is_position))
    throw fail("has a vertex with a coordinate that is not from -1e8 to 1e8 m; write the file anew, in metres");
  const std::size_t triangles = m.triangles.size();
  clean(m);
  if (m.triangles.empty())
    throw fail("has no triangle with an area (" + std::to_string(triangles) +
               " without); a shape needs a surface made of faces");
  if (is_closed(m) && volume_of(m) < 0)
    for (Triangle& t : m.triangles) std::swap(t[1], t[2]);
  return m;
}

}  // namespace muro::mesh
