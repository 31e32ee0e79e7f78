// SPDX-License-Identifier: MIT
#include "contact_cells.hpp"

#include <algorithm>

namespace muro::mujoco {

namespace {

/// An entry of the constraint Jacobian, which may be sparse.
struct Entry {
  mjtNum* number;
  mjtNum* transposed;  ///< null when there is no transposed matrix
};
Entry entry_of(const mjModel& m, mjData& d, int row, int column) {
  if (!mj_isSparse(&m)) return {d.efc_J + std::ptrdiff_t(row) * m.nv + column, nullptr};
  const auto place = [](const int* list, int count, int wanted) {
    return std::lower_bound(list, list + count, wanted) - list;
  };
  const int in_row = d.efc_J_rowadr[row], in_column = d.efc_JT_rowadr[column];
  return {d.efc_J + in_row + place(d.efc_J_colind + in_row, d.efc_J_rownnz[row], column),
          d.efc_JT + in_column + place(d.efc_JT_colind + in_column, d.efc_JT_rownnz[column], row)};
}

/// Calls `sink(number)` for each degree of freedom that moves a body, from the body to the root.
template <class Sink>
void each_dof(const mjModel& m, int body, const Sink& sink) {
  while (body != 0 && m.body_dofnum[body] == 0) body = m.body_parentid[body];
  for (int i = m.body_dofadr[body] + m.body_dofnum[body] - 1; body != 0 && i >= 0; i = m.dof_parentid[i]) sink(i);
}

}  // namespace

void ContactCells::move_friction(const mjModel& m, mjData& d) {
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& c = d.contact[i];
    ContactCell& cell = cells_[std::size_t(i)];
    if (c.efc_address < 0 || c.dim < 3 || cell.shift.isZero(0)) continue;
    const auto add = [&](int body, double sign) {
      each_dof(m, body, [&](int dof) {
        const Vec3 axis = sign * vector_of(d.cdof + 6 * dof);
        cell.spin += axis.dot(vector_of(c.frame)) * d.qvel[dof];
        const Vec3 more = axis.cross(cell.shift);
        for (int k = 1; k < 3; ++k) {
          const Entry entry = entry_of(m, d, c.efc_address + k, dof);
          *entry.number += more.dot(vector_of(c.frame + 3 * k));
          if (entry.transposed) *entry.transposed = *entry.number;
        }
      });
    };
    add(m.geom_bodyid[c.geom1], -1);
    add(m.geom_bodyid[c.geom2], 1);
  }
}

}  // namespace muro::mujoco
