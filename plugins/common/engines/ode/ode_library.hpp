// SPDX-License-Identifier: MIT
// Start of the Open Dynamics Engine in a process, and conversions between its types and muro's.
#pragma once

#include <ode/ode.h>

#include "muro/shape.hpp"

namespace muro::ode {

/// Starts ODE in this process, and closes it when the process ends. One call is enough. Throws Error. [any thread]
void start_library();
/// Allocates what ODE needs for each thread that collides. One call a thread is enough. Throws Error. [any thread]
void prepare_this_thread();

inline Vec3 vector_of(const dReal* v) { return {v[0], v[1], v[2]}; }
inline Quat quaternion_of(const dReal* q) { return Quat(q[0], q[1], q[2], q[3]); }
inline void copy_quaternion(dQuaternion to, const Quat& q) {
  to[0] = q.w();
  to[1] = q.x();
  to[2] = q.y();
  to[3] = q.z();
}

/// Creates a box, sphere, cylinder or capsule in `space` (null: in none). Returns null for other shapes.
dGeomID create_primitive(const Shape& shape, dSpaceID space);

}  // namespace muro::ode
