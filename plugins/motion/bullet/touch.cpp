// SPDX-License-Identifier: MIT
#include "touch.hpp"

#include <algorithm>

namespace muro::bullet {

namespace {

constexpr double same_place = 0.02;  ///< m: a point that has moved farther in a step is another one

constexpr double taken = -1;  ///< stands for the other collider of a point that has been recalled

std::size_t shapes_of(const multibody::RobotModel& model) {
  std::size_t n = 0;
  for (const multibody::Part& p : model.parts) n += p.shapes.size();
  return n;
}

}  // namespace

std::size_t Memory::size_of(const multibody::RobotModel& model) {
  return model.parts.size() - 1 + shapes_of(model) * points * numbers;
}

Memory::Memory(const multibody::RobotModel& model, std::span<double> memory)
    : drives_(memory.first(model.parts.size() - 1)), contacts_(memory.subspan(model.parts.size() - 1)) {}

void Memory::forget() const {
  std::fill(drives_.begin(), drives_.end(), 0);
  std::fill(contacts_.begin(), contacts_.end(), 0);
}

void Memory::recall(std::span<Touch> touches) const {
  for (Touch& t : touches) {
    t.impulse = Vec3::Zero();
    double nearest = same_place * same_place;
    double* found = nullptr;
    for (std::size_t i = 0; i < points; ++i) {
      double* m = &contacts_[(t.a->place * points + i) * numbers];
      if (m[0] == 0) break;
      if (m[0] != double(t.b->number) + 1) continue;
      const double distance = (Vec3(m[1], m[2], m[3]) - t.at.point).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      found = m;
    }
    if (!found) continue;
    t.impulse = Vec3(found[4], found[5], found[6]);
    found[0] = taken;
  }
}

void Memory::keep(std::span<const Touch> touches) const {
  for (std::size_t i = 0; i < contacts_.size(); i += numbers) contacts_[i] = 0;
  for (const Touch& t : touches) {
    if (t.row < 0 || t.impulse.isZero(0)) continue;
    for (std::size_t i = 0; i < points; ++i) {
      double* m = &contacts_[(t.a->place * points + i) * numbers];
      if (m[0] != 0) continue;
      m[0] = double(t.b->number) + 1;
      std::copy_n(t.at.point.data(), 3, m + 1);
      std::copy_n(t.impulse.data(), 3, m + 4);
      break;
    }
  }
}

}  // namespace muro::bullet
