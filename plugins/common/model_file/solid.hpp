// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "muro/shape.hpp"

namespace muro::model_file {

/// Mass, centre and inertia of shapes of even density, `mass` kg in all, in the frame of their body.
/// Overlaps count twice; meshes are left out. Without any volume: a ball of water.
Inertia even_solid(std::span<const Shape> shapes, double mass);

/// How a tensor of inertia (kg m^2, about the centre of mass) can be wrong.
enum class TensorFault {
  none,
  not_positive,  ///< a principal moment is not above 0
  no_body,       ///< one principal moment exceeds the sum of the others, by more than 0.1 %: no mass has it
};
/// The principal moments of `tensor`, rising, and what is wrong with them.
struct TensorCheck {
  Vec3 moments;
  TensorFault fault;
};
TensorCheck check_tensor(const Mat3& tensor);

}  // namespace muro::model_file
