// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "muro/shape.hpp"
#include "problems.hpp"

namespace muro::model_file {

/// Returns the inertia of shapes of uniform density and the total mass `mass` (kg), in the frame of their body.
/// Overlaps count twice, and meshes are omitted. Without any volume it is that of a ball of water.
Inertia uniform_density_inertia(std::span<const Shape> shapes, double mass);

enum class TensorError {
  none,
  not_positive_definite,
  violates_triangle_inequality,  ///< one principal moment exceeds the sum of the others, by more than 0.1 %
};
/// Principal moments of a tensor of inertia (kg m^2, about the centre of mass), rising, and its error.
struct TensorCheck {
  Vec3 moments;
  TensorError error;
};
TensorCheck check_tensor(const Mat3& tensor);

/// Returns the inertia of a link to which its file gives `given` in `frame`, the pose of the inertial frame in that of
/// the link. A tensor that is not positive definite is replaced by that of `shapes` with uniform density. `owner` names
/// the link in messages. Without mass, and after an error, the result is all zero.
Inertia checked_inertia(const Inertia& given, const Pose& frame, std::span<const Shape> shapes,
                        const std::string& owner, const FileLocation& location, Problems& problems);

}  // namespace muro::model_file
