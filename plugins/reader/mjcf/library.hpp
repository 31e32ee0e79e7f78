// SPDX-License-Identifier: MIT
// MuJoCo's compiler as a library: who owns what it makes, and its errors as texts.
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

/// What MuJoCo's compiler makes of a file.
struct Compiled {
  Model model;  ///< null: `error` says why
  std::string
      canonical;  ///< the file as MuJoCo writes it: one text without includes; of files with meshes or height fields
  std::string error, warning;
};

/// Compiles `text`, the contents of a file at `path` (absolute), beside which included files and meshes are found.
Compiled compile(const std::string& text, const std::string& path);

inline Vec3 vector_of(const mjtNum* v) { return {v[0], v[1], v[2]}; }
/// Of the compiled model, where it is normalised, or of a text.
inline Quat quaternion_of(const mjtNum* q) {
  const Quat quaternion(q[0], q[1], q[2], q[3]);
  if (std::abs(quaternion.squaredNorm() - 1) < 1e-12) return quaternion;
  return Quat(quaternion.normalized());
}
inline Pose pose_of(const mjtNum* position, const mjtNum* orientation) {
  return {vector_of(position), quaternion_of(orientation)};
}

/// The name of an object of the model; empty where it has none. `addresses`: such as mjModel::name_bodyadr.
inline std::string name_of(const mjModel& m, const int* addresses, int id) { return m.names + addresses[id]; }

}  // namespace muro::mjcf
