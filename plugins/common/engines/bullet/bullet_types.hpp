// SPDX-License-Identifier: MIT
// Conversions between Bullet's types and muro's.
#pragma once

#include <LinearMath/btTransform.h>

#include "muro/geometry.hpp"

namespace muro::bullet {

inline btVector3 to_bullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline btQuaternion to_bullet(const Quat& q) { return {q.x(), q.y(), q.z(), q.w()}; }
inline btTransform to_bullet(const Pose& p) { return btTransform(to_bullet(p.orientation), to_bullet(p.position)); }
inline Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace muro::bullet
