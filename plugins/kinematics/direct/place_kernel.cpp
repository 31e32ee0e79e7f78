// SPDX-License-Identifier: MIT
#include "link.hpp"
#include "muro/lane/rows.hpp"
#include "muro/lane/trig.hpp"

namespace muro::kinematics {
namespace {

using namespace lane;

/// Pose and twist of the frame that others are placed from.
template <class S>
struct Carrier {
  V3<S> position;
  Q4<S> orientation;
  V3<S> linear, angular;
  M3<S> axes;
};

template <class S>
MURO_INLINE Carrier<S> load_carrier(const Places<S>& pose, const Places<S>& twist) {
  S p[7], t[6];
  load_rows(pose, 0, p);
  load_rows(twist, 0, t);
  const Q4<S> q{p[3], p[4], p[5], p[6]};
  return {{p[0], p[1], p[2]}, q, {t[0], t[1], t[2]}, {t[3], t[4], t[5]}, q.matrix()};
}

template <class S>
MURO_INLINE void place(const Link* links, std::uint32_t count, const Body* robots) {
  constexpr int n = count_of<S>;
  Places<S> pose, twist;
  const auto carrier_of = [&](std::uint32_t frame) {
    for (int i = 0; i < n; ++i) {
      pose.at[i] = frame == 0 ? robots[i].pose : robots[i].places[frame - 1].pose;
      twist.at[i] = frame == 0 ? robots[i].twist : robots[i].places[frame - 1].twist;
    }
    return load_carrier<S>(pose, twist);
  };
  std::uint32_t parent = 0;
  Carrier<S> from = carrier_of(0);
  for (std::uint32_t k = 0; k < count; ++k) {
    const Link& link = links[k];
    if (link.parent != parent) from = carrier_of(parent = link.parent);  // neighbours mostly share their parent
    V3<S> arm = from.axes * splat<S>(link.offset);
    Q4<S> orientation = from.orientation;
    V3<S> linear = from.linear, angular = from.angular;
    if (link.joint != Link::Joint::fixed) {
      Places<S> position, velocity;
      for (int i = 0; i < n; ++i) {
        position.at[i] = robots[i].places[k].position;
        velocity.at[i] = robots[i].places[k].velocity;
      }
      const S q = load<S>(position, 0), rate = load<S>(velocity, 0);
      const V3<S> axis = from.axes * splat<S>(link.axis);
      if (link.joint == Link::Joint::revolute) {
        const SinCos<S> half = sincos(S(0.5) * q);
        orientation = orientation * Q4<S>{half.sin * S(link.axis[0]), half.sin * S(link.axis[1]),
                                          half.sin * S(link.axis[2]), half.cos};
        angular += axis * rate;
      } else {
        arm += axis * q;
        linear += axis * rate;
      }
    }
    if (link.turned)
      orientation = orientation * Q4<S>{S(link.turn[0]), S(link.turn[1]), S(link.turn[2]), S(link.turn[3])};
    linear += cross(from.angular, arm);
    const V3<S> at = from.position + arm;
    Places<S, double> to_pose, to_twist;
    for (int i = 0; i < n; ++i) {
      to_pose.at[i] = robots[i].places[k].pose;
      to_twist.at[i] = robots[i].places[k].twist;
    }
    constexpr unsigned all = (1u << n) - 1;
    store_rows(to_pose, 0, {at.x, at.y, at.z, orientation.x, orientation.y, orientation.z, orientation.w}, all);
    store_rows(to_twist, 0, {linear.x, linear.y, linear.z, angular.x, angular.y, angular.z}, all);
  }
}

void place_one(const Link* links, std::uint32_t count, const Body* robot) { place<double>(links, count, robot); }
void place_eight(const Link* links, std::uint32_t count, const Body* robots) { place<Double8>(links, count, robots); }

}  // namespace

namespace MURO_ISA {
extern const Kernels kernels;
const Kernels kernels{&place_one, &place_eight};
}  // namespace MURO_ISA

}  // namespace muro::kinematics
