// SPDX-License-Identifier: MIT
#include "tests/robots/body_shapes.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "muro/toolkit/link_pose.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/files.hpp"

namespace muro::robots {

namespace {

std::vector<Vec3> after_word(const std::string& text, const std::string& word) {
  std::vector<Vec3> points;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line);
    std::string first;
    Vec3 p;
    if (in >> first && first == word && in >> p.x() >> p.y() >> p.z()) points.push_back(p);
  }
  return points;
}

std::vector<Vec3> of_collada(const std::string& text) {
  std::vector<Vec3> points;
  const std::size_t begin = text.find("<float_array");
  if (begin == std::string::npos) return points;
  std::istringstream in(text.substr(text.find('>', begin) + 1));
  for (Vec3 p; in >> p.x() >> p.y() >> p.z();) points.push_back(p);
  return points;
}

/// Returns how far a shape reaches below its centre if `up` is the vertical in the axes of the shape.
double reach_down(const Shape& s, const Vec3& up) {
  switch (s.kind) {
    case ShapeKind::sphere:
      return s.size.x();
    case ShapeKind::box:
      return 0.5 * s.size.dot(up.cwiseAbs());
    case ShapeKind::cylinder:
      return 0.5 * s.size.z() * std::abs(up.z()) + s.size.x() * std::hypot(up.x(), up.y());
    case ShapeKind::capsule:
      return 0.5 * s.size.z() * std::abs(up.z()) + s.size.x();
    case ShapeKind::plane:
    case ShapeKind::mesh:
    case ShapeKind::heightmap:
      break;
  }
  return -std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<Vec3> vertices_of(const std::string& path) {
  const std::string text = test::text_of(path);
  std::string ending = std::filesystem::path(path).extension();
  for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
  if (ending == ".stl") return after_word(text, "vertex");
  if (ending == ".obj") return after_word(text, "v");
  if (ending == ".dae") return of_collada(text);
  return {};
}

std::vector<Solid> solids_of(const RobotTree& tree) {
  std::vector<Solid> solids;
  for (std::size_t i = 0; i < tree.links().size(); ++i)
    for (const RobotTree::Constant& c : tree.components()[std::size_t(tree.links()[i].body)].constants) {
      if (c.key.name != keys::collision_shapes.name) continue;
      for (std::size_t k = 0; k < c.data.size() / sizeof(Shape); ++k) {
        Solid solid{.link = i, .shape = {}, .vertices = {}};
        std::memcpy(static_cast<void*>(&solid.shape), c.data.data() + k * sizeof(Shape), sizeof(Shape));
        if (solid.shape.kind == ShapeKind::mesh) {
          solid.vertices = vertices_of(tree.texts()[solid.shape.mesh]);
          for (Vec3& v : solid.vertices) v = v.cwiseProduct(solid.shape.size);
          if (solid.vertices.empty()) continue;
        }
        solids.push_back(std::move(solid));
      }
    }
  return solids;
}

double lowest_point(std::span<const Solid> solids, std::span<const Pose> poses, bool with_meshes) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Solid& s : solids) {
    const Pose pose = poses[s.link] * s.shape.origin;
    if (s.shape.kind == ShapeKind::mesh) {
      if (!with_meshes) continue;
      for (const Vec3& v : s.vertices) lowest = std::min(lowest, (pose * v).z());
    } else {
      lowest = std::min(lowest, pose.position.z() - reach_down(s.shape, pose.orientation.conjugate() * Vec3::UnitZ()));
    }
  }
  return lowest;
}

std::vector<double> start_positions(const RobotTree& tree) {
  std::vector<double> q(tree.links().size(), 0.0);
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Link& link = tree.links()[i].link;
    if (link.joint != JointKind::fixed && link.mimic < 0)
      q[i] = std::min(std::max(0.0, link.limits.lower), std::max(link.limits.lower, link.limits.upper));
  }
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Link& link = tree.links()[i].link;
    if (link.mimic >= 0) q[i] = link.mimic_offset + link.mimic_multiplier * q[std::size_t(link.mimic)];
  }
  return q;
}

std::vector<Pose> poses_of(const RobotTree& tree, const Pose& base, std::span<const double> positions) {
  std::vector<Pose> poses{base};
  for (std::size_t i = 1; i < tree.links().size(); ++i) {
    const Link& link = tree.links()[i].link;
    poses.push_back(poses[std::size_t(link.parent)] * pose_in_parent(link, positions[i]));
  }
  return poses;
}

}  // namespace muro::robots
