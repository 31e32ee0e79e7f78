// SPDX-License-Identifier: MIT
// Touching lines and faces. MuJoCo lets all forces of a contact act at its point. Here friction acts in the middle of
// the cell that the point represents (pressure_cells.hpp).
#pragma once

#include <vector>

#include "mujoco_library.hpp"
#include "plugins/common/contact_geometry/contact_patches.hpp"

namespace muro::mujoco {

/// The cell of one contact.
struct ContactCell {
  Vec3 shift = Vec3::Zero();  ///< m: from the point to the middle of its cell
  double spin = 0;            ///< rad/s: of the second body relative to the first, about the normal, by its dofs
};

class ContactCells {
 public:
  /// Finds the cells of all contacts in `d`. `is_of_disc(contact)`: see disc_contact.hpp.
  template <class IsOfDisc>
  void find(const mjData& d, const IsOfDisc& is_of_disc) {
    const auto belongs = [&d](std::size_t begin, std::size_t i) {
      const mjContact &first = d.contact[begin], &c = d.contact[i];
      return c.geom1 == first.geom1 && c.geom2 == first.geom2 &&
             vector_of(c.frame).dot(vector_of(first.frame)) > contact_geometry::same_direction;
    };
    cells_.assign(std::size_t(d.ncon), {});
    contact_geometry::each_patch(cells_.size(), belongs, [&](std::size_t begin, std::size_t end) {
      if (end == begin + 1) return;
      contact_geometry::find_cells(
          end - begin, is_of_disc(d.contact[begin]), [&](std::size_t i) { return d.contact[begin + i].pos; },
          [&](std::size_t i, const Vec3& shift) { cells_[begin + i].shift = shift; });
    });
  }
  /// Moves friction of each contact to the middle of its cell. Call it after mj_makeConstraint.
  void move_friction(const mjModel& m, mjData& d);
  const ContactCell& operator[](int contact) const { return cells_[std::size_t(contact)]; }

 private:
  std::vector<ContactCell> cells_;
};

}  // namespace muro::mujoco
