// SPDX-License-Identifier: MIT
#include "pair_kernel.hpp"

#include <cstddef>

#include "muro/simd/rows.hpp"

namespace muro::penalty {
namespace {

using namespace lane;
using namespace law;

constexpr int motion_numbers = 6, spring_numbers = 5, patch_numbers = 4, listed_numbers = 8;
static_assert(offsetof(PairPoint, ahead) == offsetof(PairPoint, velocity) + 4 * sizeof(double) &&
              offsetof(PairPoint, spin) == offsetof(PairPoint, velocity) + 5 * sizeof(double) &&
              offsetof(PairPoint, moment) == offsetof(PairPoint, force) + 3 * sizeof(double) &&
              offsetof(PairPoint, zeta) == offsetof(PairPoint, displacement) + 4 * sizeof(double));

/// Returns `number(point)` of each point. If there are fewer points than S has values, the first is repeated.
template <class S, class T, class Number>
MURO_INLINE Places<S, T> places_of(PairPoint* points, int count, const Number& number) {
  Places<S, T> at;
  for (int i = 0; i < count_of<S>; ++i) at.at[i] = number(points[i < count ? i : 0]);
  return at;
}

template <class S>
MURO_INLINE void move_some(PairPoint* points, int count, double h, bool with_lag) {
  const auto from = [&](const double* PairPoint::*numbers) {
    return places_of<S, const double>(points, count, [&](const PairPoint& p) { return p.*numbers; });
  };
  S c[6];
  load_rows(from(&PairPoint::contact), 0, c);
  const V3<S> at{c[0], c[1], c[2]}, normal{c[3], c[4], c[5]};
  const auto velocity_of = [&](const Places<S>& pose, const TwistOf<S>& motion) {
    return motion.linear + cross(motion.angular, at - load_vector(pose));
  };
  const TwistOf<S> own_motion = load_twist(from(&PairPoint::twist)),
                   other_motion = load_twist(from(&PairPoint::other_twist));
  const V3<S> own = velocity_of(from(&PairPoint::pose), own_motion),
              other = velocity_of(from(&PairPoint::other_pose), other_motion);
  const V3<S> velocity = own - other;
  const S spin = dot(own_motion.angular - other_motion.angular, normal);
  S ahead(0);
  if (with_lag) {
    S lags[2];
    load_rows(places_of<S, const double>(points, count, [](const PairPoint& p) { return &p.lag; }), 0, lags);
    ahead = S(h) * dot(normal, lags[0] * own - lags[1] * other);
  }
  store_rows(places_of<S, double>(points, count, [](PairPoint& p) { return p.velocity; }), 0,
             {velocity.x, velocity.y, velocity.z, -dot(velocity, normal), ahead, spin}, first_lanes(count));
}

template <class S>
MURO_INLINE void push_some(PairPoint* points, int count, const Stiffness& stiffness, double elapsed) {
  const auto from = [&](const auto& numbers) { return places_of<S, const double>(points, count, numbers); };
  S c[listed_numbers], motion[motion_numbers], spring[spring_numbers], patch[patch_numbers];
  load_rows(from([](const PairPoint& p) { return p.contact; }), 0, c);
  load_rows(from([](const PairPoint& p) { return p.velocity; }), 0, motion);
  load_rows(from([](const PairPoint& p) { return p.displacement; }), 0, spring);
  load_rows(from([](const PairPoint& p) { return p.patch; }), 0, patch);
  const V3<S> turn = load_vector(from([](const PairPoint&p) { return p.turn; })), spin = motion[5] * turn;
  const V3<S> normal{c[3], c[4], c[5]}, velocity{motion[0], motion[1], motion[2]};
  const S approach = motion[3], along = patch[0], across = patch[1], inverse_across = patch[2], load = patch[3];
  const V3<S> slip = velocity + approach * normal + spin;
  const S depth = c[6] - spring[3] + motion[4];
  const S pressed = along * NormalLaw<S>(stiffness, spring[4], load).force(depth, approach);
  V3<S> displacement = V3<S>{spring[0], spring[1], spring[2]} + slip * S(elapsed);
  displacement -= normal * dot(normal, displacement);
  const V3<S> friction =
      across *
      FrictionLaw<S>(stiffness, load).force(displacement, slip, c[7] * pressed * inverse_across, speed_of_ends(spin));
  const V3<S> force = pressed * normal + friction;
  const unsigned used = first_lanes(count);
  store_vector(places_of<S, double>(points, count, [](PairPoint& p) { return p.displacement; }), 0, displacement, used);
  store_rows(places_of<S, double>(points, count, [](PairPoint& p) { return p.force; }), 0,
             {force.x, force.y, force.z, dot(turn, friction)}, used);
}

/// Calls `some` for packs of eight points, then for the remaining ones.
template <class Some>
MURO_INLINE void each_pack(PairPoint* points, int count, const Some& some) {
  for (int first = 0; first < count; first += 8)
    in_lanes(count - first < 8 ? count - first : 8, [&]<class S>(int begin, int used) {
      some.template operator()<S>(points + first + begin, used);
      return 0u;
    });
}

void move(PairPoint* points, int count, double h, bool with_lag) {
  each_pack(points, count, [&]<class S>(PairPoint* some, int used) { move_some<S>(some, used, h, with_lag); });
}
void push(PairPoint* points, int count, const Stiffness& stiffness, double elapsed) {
  each_pack(points, count, [&]<class S>(PairPoint* some, int used) { push_some<S>(some, used, stiffness, elapsed); });
}

}  // namespace

namespace MURO_ISA {
extern const PairKernels pair_kernels;
const PairKernels pair_kernels{&move, &push};
}  // namespace MURO_ISA

}  // namespace muro::penalty
