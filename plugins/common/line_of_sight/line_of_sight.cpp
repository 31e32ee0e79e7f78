// SPDX-License-Identifier: MIT
#include "line_of_sight.hpp"

#include <algorithm>
#include <string>

#include "muro/vocabulary.hpp"
#include "plugins/common/mesh/collision_mesh.hpp"

namespace muro::line_of_sight {

namespace {

/// Height (m) of lines over their ends. For two devices at the height of a floor, only walls on it are obstacles.
constexpr double lift = 1e-3;

/// Returns the same segment from `a` to `b` as from `b` to `a`, so that rounding is the same in both directions.
Segment line(const Vec3& a, const Vec3& b) {
  const Vec3 lifted(0, 0, lift);
  const bool is_in_order = std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  return is_in_order ? Segment::between(a + lifted, b + lifted) : Segment::between(b + lifted, a + lifted);
}

}  // namespace

LineOfSight::Solid LineOfSight::load(Connector& c, const Shape& shape) {
  const std::string path(c.text(shape.mesh));
  if (shape.kind == ShapeKind::heightmap) {
    const Heightmap map = heightmaps_.file(path).heightmap(shape.size);
    grounds_.push_back(std::make_unique<Ground>(Ground{map, heightmap::bounds_of(map).high.z()}));
    return {.ground = grounds_.back().get()};
  }
  const mesh::Mesh& mesh = meshes_.mesh(path, shape.size);
  const TriangleMesh*& known = known_meshes_[&mesh];
  if (known) return {.mesh = known};
  TriangleMesh& made = *triangle_meshes_.emplace_back(std::make_unique<TriangleMesh>());
  made.mesh = &mesh;
  std::vector<Aabb> boxes;
  std::vector<std::uint32_t> all;
  for (const mesh::Triangle& t : mesh.triangles) {
    all.push_back(std::uint32_t(boxes.size()));
    Aabb& box = boxes.emplace_back();
    for (const std::uint32_t corner : t) box.include({mesh.vertices[corner], mesh.vertices[corner]});
  }
  made.tree.build(boxes, all);
  known = &made;
  return {.mesh = known};
}

void LineOfSight::connect(Connector& c) {
  scene_ = c.read(world_object, keys::scene_index);
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    const Rows<Shape> shapes = c.constant_array(ObjectId(i), keys::collision_shapes);
    for (std::uint32_t k = 0; k < shapes.size(); ++k) {
      if (shapes[k].kind != ShapeKind::mesh && shapes[k].kind != ShapeKind::heightmap) continue;
      try {
        solid_of_shape_[{i, k}] = load(c, shapes[k]);
      } catch (const Error& error) {
        mesh::refuse_collision_mesh(c, ObjectId(i), error);
      }
    }
  }
}

void LineOfSight::find_solids() {
  solids_.clear();
  for (const Collider& k : scene_->colliders) {
    const auto found = solid_of_shape_.find({index_of(k.body), k.shape_index});
    solids_.push_back(found == solid_of_shape_.end() ? Solid{} : found->second);
  }
}

bool LineOfSight::is_cut(const Segment& segment, std::uint32_t collider) const {
  const Collider& k = scene_->colliders[collider];
  const Solid& solid = solids_[collider];
  const Segment s = segment.in(k.pose());
  if (solid.ground) return passes_under(s, solid.ground->map, solid.ground->highest);
  if (!solid.mesh) return passes_through(s, *k.shape);
  const mesh::Mesh& mesh = *solid.mesh->mesh;
  return any_on(solid.mesh->tree.view(), s, [&](std::uint32_t i) {
    const mesh::Triangle& t = mesh.triangles[i];
    return crosses(s, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
  });
}

bool LineOfSight::is_cut_by_robot(const Segment& segment, std::uint32_t robot) const {
  const RobotColliders& colliders = scene_->robots[robot];
  if (!segment.touches(colliders.bounds)) return false;
  for (std::uint32_t i = 0; i < colliders.count; ++i)
    if (is_cut(segment, colliders.first + i)) return true;
  return false;
}

std::uint32_t LineOfSight::obstacles(const Vec3& a, const Vec3& b, RobotId own, RobotId other,
                                     std::uint32_t most) const {
  if (!a.allFinite() || !b.allFinite()) return most;
  const Segment segment = line(a, b);
  std::uint32_t count = 0;
  any_on(scene_->scenery, segment, [&](std::uint32_t i) { return is_cut(segment, i) && ++count >= most; });
  if (count >= most) return count;
  any_on(scene_->moving, segment, [&](std::uint32_t robot) {
    const RobotId id{robot};
    return id != own && id != other && is_cut_by_robot(segment, robot) && ++count >= most;
  });
  return count;
}

void LineOfSight::look_around(const Vec3& centre, RobotId own, double reach, std::size_t lines, Fan& fan) const {
  fan.begin(centre, own);
  if (!centre.allFinite()) return;
  const double far = reach * (1 + 1e-9) + 2 * lift;
  const Vec3 half = Vec3::Constant(far);
  const Aabb region{centre - half, centre + half};
  const std::size_t worth_it = 32 * lines;  // boxes: to mark so many costs less than a search for each line
  std::size_t boxes = 0;
  const auto add = [&](const Aabb& box, std::uint32_t item) {
    const Vec3 nearest = centre.cwiseMax(box.low).cwiseMin(box.high);
    return (nearest - centre).squaredNorm() > far * far || (++boxes <= worth_it && fan.add(box, item));
  };
  const bool is_all =
      each_leaf(scene_->scenery, region,
                [&](const BvhNode& leaf, std::uint32_t collider) { return add(leaf.bounds, collider); }) &&
      each_leaf(scene_->moving, region, [&](const BvhNode&, std::uint32_t robot) {
        return RobotId{robot} == own || add(scene_->robots[robot].bounds, first_robot() + robot);
      });
  if (is_all)
    fan.close();
  else
    fan.give_up();
}

std::uint32_t LineOfSight::obstacles(const Fan& fan, const Vec3& to, RobotId other, std::uint32_t most) const {
  if (!fan.is_usable()) return obstacles(fan.centre(), to, fan.own(), other, most);
  if (!fan.centre().allFinite() || !to.allFinite()) return most;
  const Segment segment = line(fan.centre(), to);
  const std::uint32_t other_item = other == no_robot ? UINT32_MAX : first_robot() + index_of(other);
  std::uint32_t count = 0;
  fan.any(to, segment, [&](std::uint32_t item) {
    if (item == other_item) return false;
    const bool cut = item < first_robot() ? is_cut(segment, item) : is_cut_by_robot(segment, item - first_robot());
    return cut && ++count >= most;
  });
  return count;
}

}  // namespace muro::line_of_sight
