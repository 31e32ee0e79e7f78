// SPDX-License-Identifier: MIT
// Between Bullet's types and muro's.
#pragma once

#include <LinearMath/btTransform.h>

#include "muro/geometry.hpp"

namespace muro::bullet {

inline btVector3 bullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline btQuaternion bullet(const Quat& q) { return {q.x(), q.y(), q.z(), q.w()}; }
inline btTransform bullet(const Pose& p) { return btTransform(bullet(p.orientation), bullet(p.position)); }
inline Vec3 muro_of(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace muro::bullet
