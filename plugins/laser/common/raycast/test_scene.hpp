// SPDX-License-Identifier: MIT
// Scenes for tests of the kernels: an index that is built here, and a reference that is independent of the kernels.
#pragma once

#include <algorithm>
#include <deque>
#include <random>
#include <vector>

#include "muro/base/bounds.hpp"
#include "muro/scene.hpp"

namespace muro::raycast::test {

/// The index of a scene, with object ids 1, 2, ... for its bodies in order of creation.
class TestScene {
 public:
  struct PlacedShape {
    Shape shape;
    Pose pose;  ///< in the world
  };

  ObjectId add_scenery(const Shape& shape, const Pose& pose) {
    scenery_.push_back({shape, pose});
    return ObjectId(std::uint32_t(scenery_.size()));
  }
  /// Adds a robot. All scenery must be added before. All shapes of a robot belong to one object.
  ObjectId add_robot(std::vector<PlacedShape> shapes) {
    robots_.push_back(std::move(shapes));
    return ObjectId(std::uint32_t(scenery_.size() + robots_.size()));
  }
  std::vector<PlacedShape>& robot(std::size_t number) { return robots_[number]; }
  std::size_t robot_count() const { return robots_.size(); }

  /// Returns the index, which is valid until the scene changes.
  const SceneIndex& index() {
    colliders_.clear();
    planes_.clear();
    boxes_.clear();
    std::uint32_t body = 1;
    for (const PlacedShape& p : scenery_) add(p, ObjectId(body++), no_robot, 0);
    std::vector<std::uint32_t> items;
    std::vector<Aabb> bounds;
    for (std::uint32_t i = 0; i < colliders_.size(); ++i) {
      bounds.push_back(bounds_of(colliders_[i]));
      if (colliders_[i].shape->kind != ShapeKind::plane) items.push_back(i);
    }
    scenery_items_ = items;
    build(scenery_nodes_, scenery_items_, bounds);
    items.clear();
    bounds.clear();
    for (std::uint32_t r = 0; r < robots_.size(); ++r, ++body) {
      RobotColliders box;
      box.first = std::uint32_t(colliders_.size());
      box.count = std::uint32_t(robots_[r].size());
      for (std::uint32_t k = 0; k < robots_[r].size(); ++k) {
        add(robots_[r][k], ObjectId(body), RobotId{r}, k);
        box.bounds.include(bounds_of(colliders_.back()));
      }
      boxes_.push_back(box);
      items.push_back(r);
      const Vec3 margin = Vec3::Constant(0.1 + 0.05 * r);
      bounds.push_back({box.bounds.low - margin, box.bounds.high + margin});
    }
    robot_items_ = items;
    build(robot_nodes_, robot_items_, bounds);
    index_ = {colliders_, boxes_, planes_, {scenery_nodes_, scenery_items_}, {robot_nodes_, robot_items_}};
    return index_;
  }

 private:
  void add(const PlacedShape& p, ObjectId body, RobotId robot, std::uint32_t shape_index) {
    if (p.shape.kind == ShapeKind::plane) planes_.push_back(std::uint32_t(colliders_.size()));
    colliders_.push_back({&p.shape, &p.pose, body, robot, shape_index});
  }

  /// Halves the items along the longest side until two items remain.
  static void build(std::vector<BvhNode>& nodes, std::vector<std::uint32_t>& items, const std::vector<Aabb>& bounds) {
    nodes.clear();
    if (items.empty()) return;
    nodes.push_back({});
    split(nodes, 0, items, bounds, 0, std::uint32_t(items.size()));
  }
  static void split(std::vector<BvhNode>& nodes, std::uint32_t node, std::vector<std::uint32_t>& items,
                    const std::vector<Aabb>& bounds, std::uint32_t first, std::uint32_t count) {
    Aabb all;
    for (std::uint32_t i = first; i < first + count; ++i) all.include(bounds[items[i]]);
    nodes[node].bounds = all;
    if (count <= 2) {
      nodes[node].first = first;
      nodes[node].count = count;
      return;
    }
    int axis = 0;
    Vec3(all.high - all.low).maxCoeff(&axis);
    const auto begin = items.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [&](std::uint32_t a, std::uint32_t b) {
      return bounds[a].low[axis] + bounds[a].high[axis] < bounds[b].low[axis] + bounds[b].high[axis];
    });
    const std::uint32_t left = std::uint32_t(nodes.size());
    nodes[node].first = left;
    nodes.resize(nodes.size() + 2);
    split(nodes, left, items, bounds, first, count / 2);
    split(nodes, left + 1, items, bounds, first + count / 2, count - count / 2);
  }

  std::deque<PlacedShape> scenery_;
  std::deque<std::vector<PlacedShape>> robots_;
  std::vector<Collider> colliders_;
  std::vector<RobotColliders> boxes_;
  std::vector<std::uint32_t> planes_, scenery_items_, robot_items_;
  std::vector<BvhNode> scenery_nodes_, robot_nodes_;
  SceneIndex index_;
};

/// Finds the first point of a solid along a ray, in long double. Each face, end and side is intersected alone, points
/// off the solid are dropped, and the smallest distance counts. Uses no hierarchy and no intervals.
class Reference {
 public:
  using Real = long double;
  struct Vector {
    Real x, y, z;
  };
  struct Hit {
    Real distance;
    ObjectId body = no_object;
  };

  static Hit cast(const SceneIndex& scene, const Pose& device, const Vec3& direction, double min_range,
                  double max_range, RobotId ignored_robot) {
    const Vector start = of(device.position), d = rotated(device.orientation, of(direction), 1);
    Hit best{max_range, no_object};
    for (const Collider& c : scene.colliders) {
      if (c.robot != no_robot && c.robot == ignored_robot) continue;
      const Vector p = of(c.pose().position);
      const Vector o = rotated(c.pose().orientation, {start.x - p.x, start.y - p.y, start.z - p.z}, -1);
      const Real t = enter(*c.shape, o, rotated(c.pose().orientation, d, -1));
      if (t < best.distance) best = {t, c.body};
    }
    best.distance = std::max(best.distance, Real(min_range));
    return best;
  }

  static Real enter(const Shape& s, const Vector& o, const Vector& d) {
    const Real x = s.size.x(), y = s.size.y(), z = s.size.z();
    Search search{o, d};
    switch (s.kind) {
      case ShapeKind::box: {
        const auto in = [=](const Vector& p) {
          return std::abs(p.x) <= x / 2 + slack && std::abs(p.y) <= y / 2 + slack && std::abs(p.z) <= z / 2 + slack;
        };
        if (in(o)) return 0;
        for (const int side : {-1, 1}) {
          if (d.x != 0) search.try_at((side * x / 2 - o.x) / d.x, in);
          if (d.y != 0) search.try_at((side * y / 2 - o.y) / d.y, in);
          if (d.z != 0) search.try_at((side * z / 2 - o.z) / d.z, in);
        }
        break;
      }
      case ShapeKind::sphere: {
        if (o.x * o.x + o.y * o.y + o.z * o.z <= x * x) return 0;
        search.try_quadratic(1, o.x * d.x + o.y * d.y + o.z * d.z, o.x * o.x + o.y * o.y + o.z * o.z - x * x,
                             [](const Vector&) { return true; });
        break;
      }
      case ShapeKind::cylinder: {
        const auto between = [=](const Vector& p) { return std::abs(p.z) <= z / 2; };
        const auto within = [=](const Vector& p) { return p.x * p.x + p.y * p.y <= x * x; };
        if (between(o) && within(o)) return 0;
        for (const int side : {-1, 1})
          if (d.z != 0) search.try_at((side * z / 2 - o.z) / d.z, within);
        search.try_quadratic(d.x * d.x + d.y * d.y, o.x * d.x + o.y * d.y, o.x * o.x + o.y * o.y - x * x, between);
        break;
      }
      case ShapeKind::capsule: {
        const auto to_axis2 = [=](const Vector& p) {
          const Real dz = p.z - std::clamp(p.z, -z / 2, z / 2);
          return p.x * p.x + p.y * p.y + dz * dz;
        };
        if (to_axis2(o) <= x * x) return 0;
        search.try_quadratic(d.x * d.x + d.y * d.y, o.x * d.x + o.y * d.y, o.x * o.x + o.y * o.y - x * x,
                             [=](const Vector& p) { return std::abs(p.z) <= z / 2; });
        for (const int side : {-1, 1}) {
          const Real oz = o.z - side * z / 2;
          search.try_quadratic(1, o.x * d.x + o.y * d.y + oz * d.z, o.x * o.x + o.y * o.y + oz * oz - x * x,
                               [=](const Vector& p) { return side * p.z >= z / 2; });
        }
        break;
      }
      case ShapeKind::plane:
        if (o.z <= 0) return 0;
        if (d.z < 0) return -o.z / d.z;
        break;
      case ShapeKind::mesh:
      case ShapeKind::heightmap:
        break;
    }
    return search.best;
  }

 private:
  static constexpr Real slack = 1e-15L;

  struct Search {
    Vector o, d;
    Real best = std::numeric_limits<Real>::infinity();
    template <class On>
    void try_at(Real t, On on) {
      if (t >= 0 && t < best && on({o.x + t * d.x, o.y + t * d.y, o.z + t * d.z})) best = t;
    }
    /// Tries both solutions of a t^2 + 2 b t + c = 0.
    template <class On>
    void try_quadratic(Real a, Real b, Real c, On on) {
      const Real discriminant = b * b - a * c;
      if (a == 0 || discriminant < 0) return;
      const Real q = -(b + std::copysign(std::sqrt(discriminant), b));
      try_at(q / a, on);
      if (q != 0) try_at(c / q, on);
    }
  };

  static Vector of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
  /// Rotates by the quaternion (sense 1) or back (-1): v + 2 w (u x v) + 2 u x (u x v), with the unit quaternion.
  static Vector rotated(const Quat& q, const Vector& v, int sense) {
    const Real norm = std::sqrt(Real(q.x()) * q.x() + Real(q.y()) * q.y() + Real(q.z()) * q.z() + Real(q.w()) * q.w());
    const Vector u{sense * q.x() / norm, sense * q.y() / norm, sense * q.z() / norm};
    const Real w = q.w() / norm;
    const Vector a = cross(u, v), b = cross(u, a);
    return {v.x + 2 * (w * a.x + b.x), v.y + 2 * (w * a.y + b.y), v.z + 2 * (w * a.z + b.z)};
  }
  static Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};

/// A source of random geometry.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vec3 in_box(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  Quat rotation() {
    Quat q(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1));
    q.normalize();
    return q;
  }
  Pose pose(double half) { return {in_box(half), rotation()}; }
  Shape shape(double min, double max) {
    const double a = between(min, max), b = between(min, max), c = between(min, max);
    switch (int(between(0, 4))) {
      case 0:
        return Shape::box({a, b, c});
      case 1:
        return Shape::sphere(a);
      case 2:
        return Shape::cylinder(a, b);
      default:
        return Shape::capsule(a, b);
    }
  }

 private:
  std::mt19937 engine_;
};

}  // namespace muro::raycast::test
