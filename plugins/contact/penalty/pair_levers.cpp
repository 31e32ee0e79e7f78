// SPDX-License-Identifier: MIT
// Levers of contacts in the middle of a step, on bodies that move on until then.
#include "pair_contacts.hpp"
#include "plugins/common/lanes/vectors.hpp"
#include "rolling_point.hpp"

namespace muro::penalty {

/// Finds the shifts (m) of the levers at which the force of a contact acts, from those at the start of the step.
/// `before`: the anchor of the step before; null: there is none; `detail`: of it.
void PairContacts::find_lever_shifts(std::uint32_t self, const ContactPatch& patch, const Vec3& at,
                                     const FrictionAnchor* before, const AnchorDetail& detail, Computed& c) const {
  const bool lasts = before && context_.elapsed > 0;
  if (patch.other != not_dynamic)
    find_shared_lever_shifts(self, patch, at, lasts ? before : nullptr, c);
  else
    find_own_lever_shift(self, patch, at, lasts ? before : nullptr, detail, c);
}

/// Finds the shifts for two robots. If poses and twists are of one instant, levers are those of the middle of the step;
/// if twists lag by half a step, those of its start. So the pair keeps its angular momentum.
void PairContacts::find_shared_lever_shifts(std::uint32_t self, const ContactPatch& patch, const Vec3& at,
                                            const FrictionAnchor* before, Computed& c) const {
  const Vec3 &v = patch.velocity, &u = patch.other_velocity;
  Vec3 point_velocity = 0.5 * (v + u);  // the point belongs to no body
  if (before) {
    const Vec3 seen = (at - before->point) / context_.elapsed;
    if ((seen - point_velocity).norm() <= (v - u).norm()) point_velocity = seen;  // otherwise it is another point
  }
  const double half = 0.5 * context_.stiffness.h;
  const double lag = *bodies_.robots[self].lag, other_lag = *bodies_.robots[std::size_t(patch.other)].lag;
  c.lever_shift = half * (point_velocity - (1 - 2 * lag) * v);
  c.other_lever_shift = half * (point_velocity - (1 - 2 * other_lag) * u);
}

/// Finds the shift for one body that rolls over something that no force moves.
void PairContacts::find_own_lever_shift(std::uint32_t self, const ContactPatch& patch, const Vec3& at,
                                        const FrictionAnchor* before, const AnchorDetail& detail, Computed& c) const {
  c.lever_shift.setZero();
  c.way.setZero();
  if (!before || !bodies_.robots[self].is_one_link || *bodies_.robots[self].lag != 0) return;
  const Vec3 way = at - before->point;
  if (!(way.squaredNorm() < law::square_of_reach(mobility(std::int32_t(self), patch.body)))) return;
  c.way = way;
  const double half = 0.5 * context_.stiffness.h;
  c.lever_shift = half / context_.elapsed * vector_of(law::way_ahead(plain(way), plain(detail.way))) -
                  half * centre_velocity(std::int32_t(self), patch.body);
}

}  // namespace muro::penalty
