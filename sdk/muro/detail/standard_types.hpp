// SPDX-License-Identifier: MIT
// Traits of numbers and of the types of geometry.hpp, included by value_type.hpp.
#pragma once

#include "muro/value_type.hpp"

namespace muro {

namespace detail {
template <Scalar S>
struct ScalarTraits {
  static constexpr Scalar scalar = S;
  static constexpr std::span<const std::string_view> labels{};
};
inline constexpr std::string_view xyz_labels[] = {"x", "y", "z"};
inline constexpr std::string_view pose_labels[] = {"x", "y", "z", "qx", "qy", "qz", "qw"};
inline constexpr std::string_view quat_labels[] = {"qx", "qy", "qz", "qw"};
inline constexpr std::string_view twist_labels[] = {"vx", "vy", "vz", "wx", "wy", "wz"};
inline constexpr std::string_view wrench_labels[] = {"fx", "fy", "fz", "tx", "ty", "tz"};
inline constexpr std::string_view inertia_labels[] = {"mass", "cx",  "cy",  "cz",  "ixx",
                                                      "iyy",  "izz", "ixy", "ixz", "iyz"};
}  // namespace detail

#define MURO_SCALAR_TYPE(TYPE, KIND)                              \
  template <>                                                     \
  struct ValueTraits<TYPE> : detail::ScalarTraits<Scalar::KIND> { \
    static constexpr std::string_view name = #KIND;               \
  };
MURO_SCALAR_TYPE(double, f64)
MURO_SCALAR_TYPE(float, f32)
MURO_SCALAR_TYPE(std::int64_t, i64)
MURO_SCALAR_TYPE(std::int32_t, i32)
MURO_SCALAR_TYPE(std::uint64_t, u64)
MURO_SCALAR_TYPE(std::uint32_t, u32)
MURO_SCALAR_TYPE(std::uint8_t, u8)
#undef MURO_SCALAR_TYPE

MURO_VALUE_TYPE(Vec3, "muro.Vec3", f64, detail::xyz_labels);
MURO_VALUE_TYPE(Quat, "muro.Quat", f64, detail::quat_labels);
MURO_VALUE_TYPE(Pose, "muro.Pose", f64, detail::pose_labels);
MURO_VALUE_TYPE(Twist, "muro.Twist", f64, detail::twist_labels);
MURO_VALUE_TYPE(Wrench, "muro.Wrench", f64, detail::wrench_labels);
MURO_VALUE_TYPE(Inertia, "muro.Inertia", f64, detail::inertia_labels);

}  // namespace muro
