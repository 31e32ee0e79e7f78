// SPDX-License-Identifier: MIT
// Bullet's ray test: one call for each ray, against a world of collision objects without dynamics.
#include "tests/bench/baselines/bullet_world.hpp"
#include "tests/bench/baselines/scanners.hpp"

namespace muro::bench {

namespace {

class BulletScanners final : public Scanners {
 public:
  BulletScanners(const City& city, const Pattern& pattern, double range)
      : bullet_(city, {}), pattern_(pattern), range_(range), ranges_(std::size_t(pattern.size() * city.vehicles())) {
    auto rover = std::make_unique<btCompoundShape>();
    rover->addChildShape(btTransform::getIdentity(),
                         &bullet_.keep(std::make_unique<btBoxShape>(
                             btVector3(0.5 * Rover::length, 0.5 * Rover::width, 0.5 * Rover::height))));
    btCollisionShape& wheel = bullet_.keep(std::make_unique<btCylinderShape>(
        btVector3(Rover::wheel_radius, 0.5 * Rover::wheel_width, Rover::wheel_radius)));
    for (int w = 0; w < 4; ++w)
      rover->addChildShape(btTransform(btQuaternion::getIdentity(), bullet(Rover::wheel_centre(w))), &wheel);
    btCollisionShape& shape = bullet_.keep(std::move(rover));
    for (const Pose& start : city.starts()) vehicles_.push_back(&bullet_.add(shape, start, 0));
  }

  void scan(std::span<const Pose> poses, bool moved) override {
    for (std::size_t v = 0; v < poses.size() && moved; ++v) {
      vehicles_[v]->setWorldTransform(bullet(poses[v]));
      bullet_.world.updateSingleAabb(vehicles_[v]);
    }
    std::size_t next = 0;
    for (const Pose& pose : poses) {
      const btTransform frame = bullet(pose);
      const btVector3 from = frame * btVector3(0, 0, scanner_height);
      for (std::size_t i = 0; i < std::size_t(pattern_.size()); ++i) {
        const btVector3 along(double(pattern_.x[i]), double(pattern_.y[i]), double(pattern_.z[i]));
        const btVector3 to = from + range_ * (frame.getBasis() * along);
        btCollisionWorld::ClosestRayResultCallback nearest(from, to);
        bullet_.world.rayTest(from, to, nearest);
        ranges_[next++] = range_ * nearest.m_closestHitFraction;
      }
    }
  }
  double range(int vehicle, int ray) const override { return ranges_[std::size_t(vehicle * pattern_.size() + ray)]; }

 private:
  BulletWorld bullet_;
  Pattern pattern_;
  double range_;
  std::vector<double> ranges_;
  std::vector<btRigidBody*> vehicles_;
};

}  // namespace

std::unique_ptr<Scanners> bullet_scanners(const City& city, const Pattern& pattern, double range) {
  return std::make_unique<BulletScanners>(city, pattern, range);
}

}  // namespace muro::bench
