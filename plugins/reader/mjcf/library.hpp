// SPDX-License-Identifier: MIT
// MuJoCo's compiler as a library: ownership of its models, and its errors as texts.
#pragma once

#include <mujoco/mujoco.h>

#include <cmath>
#include <memory>
#include <string>

#include "muro/geometry.hpp"

namespace muro::mjcf {

struct ModelDeleter {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
};
using Model = std::unique_ptr<mjModel, ModelDeleter>;

/// Result of MuJoCo's compiler.
struct Compiled {
  Model model;            ///< null if compilation failed; `error` has the reason
  std::string canonical;  ///< the file as MuJoCo writes it, without includes; empty without meshes and height fields
  std::string error, warning;
};

/// Compiles `text`, the contents of a file at `path` (absolute). Included files and meshes are searched relative to it.
Compiled compile(const std::string& text, const std::string& path);

inline Vec3 vector_of(const mjtNum* v) { return {v[0], v[1], v[2]}; }
/// Returns a quaternion of the compiled model, which is normalised, or of a text, which is normalised here.
inline Quat quaternion_of(const mjtNum* q) {
  const Quat quaternion(q[0], q[1], q[2], q[3]);
  if (std::abs(quaternion.squaredNorm() - 1) < 1e-12) return quaternion;
  return Quat(quaternion.normalized());
}
inline Pose pose_of(const mjtNum* position, const mjtNum* orientation) {
  return {vector_of(position), quaternion_of(orientation)};
}

/// Returns the name of an object of the model; empty if it has no name. `addresses`: such as mjModel::name_bodyadr.
inline std::string name_of(const mjModel& m, const int* addresses, int id) { return m.names + addresses[id]; }

}  // namespace muro::mjcf
