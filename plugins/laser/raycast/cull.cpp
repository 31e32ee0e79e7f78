// SPDX-License-Identifier: MIT
#include "cull.hpp"

#include <algorithm>

namespace muro::raycast {

namespace {

constexpr double rounding = 1e-9;  // m, and relative: bounds are wider by this

/// Whether a box is all above or all below the rays of the pattern. Its centre lies `high` (m) above the device, its
/// corners at most `tall` above and below that; `distance2` is from device to centre, `radius` from there to a corner.
bool outside_elevations(double high, double tall, double distance2, double radius, const Pattern& pattern) {
  const double flat = std::sqrt(std::max(0.0, distance2 - high * high));
  const double near = std::max(0.0, flat - radius), far = flat + radius;
  const double bottom = high - tall - rounding, top = high + tall + rounding;
  const double low = pattern.min_slope(), steep = pattern.max_slope();
  return top < low * (low > 0 ? near : far) || bottom > steep * (steep > 0 ? far : near);
}

}  // namespace

void ConeList::reserve(std::size_t count) {
  const std::size_t room = (count + block - 1) / block * block;
  if (x_.size() >= room) return;
  for (std::vector<double>* column : {&x_, &y_, &z_, &cosine_, &sine_, &near_}) column->resize(room);
  candidate_.resize(room);
}

void ConeList::push_back(const Cone& cone, double near, std::uint32_t candidate) {
  const std::size_t i = size_++;
  reserve(size_);
  x_[i] = cone.axis.x();
  y_[i] = cone.axis.y();
  z_[i] = cone.axis.z();
  cosine_[i] = cone.cosine;
  sine_[i] = cone.sine;
  near_[i] = near;
  candidate_[i] = candidate;
}

void ConeList::push_back(const ConeList& from, std::size_t i) {
  push_back({{from.x_[i], from.y_[i], from.z_[i]}, from.cosine_[i], from.sine_[i]}, from.near_[i], from.candidate_[i]);
}

void ConeList::may_meet(const Cone& cone, std::size_t first, double (&margins)[block]) const {
  const double ax = cone.axis.x(), ay = cone.axis.y(), az = cone.axis.z();
  const double *x = &x_[first], *y = &y_[first], *z = &z_[first], *cosine = &cosine_[first], *sine = &sine_[first];
  for (std::size_t j = 0; j < block; ++j)
    margins[j] = x[j] * ax + y[j] * ay + z[j] * az - (cosine[j] * cone.cosine - sine[j] * cone.sine) + rounding;
}

void Candidates::reserve(std::size_t colliders, std::size_t nodes) {
  shapes_.reserve(colliders);
  places_.reserve(colliders);
  planes_.reserve(colliders);
  stack_.reserve(nodes);
  cones_.reserve(colliders);
}

double Candidates::distance2(const Aabb& box) const {
  const Vec3& p = view_.device.position;
  return (p - p.cwiseMax(box.low).cwiseMin(box.high)).squaredNorm();
}

/// Calls visit(item) for the items of all leaves in reach.
template <class Visit>
void Candidates::search(const Bvh& tree, Visit visit) {
  const double reach2 = view_.max_range * view_.max_range;
  stack_.clear();
  if (!tree.nodes.empty()) stack_.push_back(0);
  while (!stack_.empty()) {
    const BvhNode& node = tree.nodes[stack_.back()];
    stack_.pop_back();
    if (distance2(node.bounds) >= reach2) continue;
    if (node.count > 0) {
      for (const std::uint32_t item : tree.items.subspan(node.first, node.count)) visit(item);
    } else {
      stack_.push_back(node.first);
      stack_.push_back(node.first + 1);
    }
  }
}

void Candidates::gather(const SceneIndex& scene, const View& view, const Pattern& pattern) {
  view_ = view;
  to_device_ = view.device.orientation.toRotationMatrix().transpose();
  shapes_.clear();
  places_.clear();
  planes_.clear();
  cones_.clear();

  search(scene.scenery, [&](std::uint32_t collider) { consider(scene, collider, pattern); });
  search(scene.moving, [&](std::uint32_t robot) {
    const RobotColliders& r = scene.robots[robot];
    if (std::int32_t(robot) == view.ignored_robot || distance2(r.bounds) >= view.max_range * view.max_range) return;
    for (std::uint32_t i = r.first; i < r.first + r.count; ++i) consider(scene, i, pattern);
  });
  std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) {
    return a.near != b.near ? a.near < b.near : a.collider < b.collider;
  });
  for (const Place& place : places_) {
    const Candidate& c = shapes_[place.candidate];
    const double radius = std::sqrt(c.reach.squaredNorm()) * (1 + rounding) + rounding, distance = c.centre.norm();
    Cone cone;  // of all directions, when the device is within the ball around the shape
    if (distance > radius) {
      const double sine = radius / distance;
      cone = {c.centre / distance, std::sqrt(1 - sine * sine), sine};
    }
    cones_.push_back(cone, place.near, place.candidate);
  }
  for (const std::uint32_t i : scene.planes) {
    const Collider& c = scene.colliders[i];
    if (c.robot >= 0 && c.robot == view.ignored_robot) continue;
    const Vec3 normal = c.pose().orientation * Vec3::UnitZ();
    planes_.push_back({c.body, to_device_ * normal, normal.dot(view.device.position - c.pose().position)});
  }
}

void Candidates::consider(const SceneIndex& scene, std::uint32_t collider, const Pattern& pattern) {
  const Collider& source = scene.colliders[collider];
  const Shape& shape = *source.shape;
  if (shape.kind == ShapeKind::plane || shape.kind == ShapeKind::mesh) return;
  if (distance2(source.bounds()) >= view_.max_range * view_.max_range) return;
  const Vec3 half = half_extents(shape), away = source.pose().position - view_.device.position;
  const Mat3 axes = source.pose().orientation.toRotationMatrix();  // of the shape in the world
  const Vec3 up = to_device_.row(2);                             // of the device in the world
  const double tall = (up.transpose() * axes).cwiseAbs().dot(half);
  if (outside_elevations(up.dot(away), tall, away.squaredNorm(), half.norm(), pattern)) return;
  Candidate c;
  c.kind = shape.kind;
  c.body = source.body;
  c.origin = -(axes.transpose() * away);
  const double near = (c.origin.cwiseAbs() - half).cwiseMax(0.0).norm() * (1 - rounding);
  if (near >= view_.max_range) return;
  const Mat3 turned = to_device_ * axes;
  c.centre = to_device_ * away;
  c.reach = turned * half.asDiagonal();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) c.turn[3 * row + column] = turned(column, row);
  c.sx = shape.kind == ShapeKind::box ? half.x() : shape.size.x();
  c.sy = half.y();
  c.sz = 0.5 * shape.size.z();
  places_.push_back({near, collider, std::uint32_t(shapes_.size())});
  shapes_.push_back(c);
}

}  // namespace muro::raycast
