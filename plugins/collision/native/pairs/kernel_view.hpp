// SPDX-License-Identifier: MIT
#pragma once

#include "pairs/conversions.hpp"

namespace muro::native {

/// A transformed shape with the interface of lanes::ShapeInWorld.
struct KernelView {
  const TransformedShape& shape;

  KernelShapeKind kind() const { return KernelShapeKind(shape.kind); }
  const double* half() const { return shape.half.data(); }
  lane::V3<double> centre() const { return lane::splat<double>(shape.centre); }
  lane::V3<double> axis(int k) const { return lane::splat<double>(shape.axes.col(k)); }
};

}  // namespace muro::native
