// SPDX-License-Identifier: MIT
// Lines and faces that touch: MuJoCo has all of a contact in its point. Here its friction acts in the middle of the
// cell that the point stands for (pressure_cells.hpp).
#pragma once

#include <vector>

#include "mujoco_library.hpp"

namespace muro::mujoco {

/// Of one contact.
struct ContactCell {
  Vec3 shift = Vec3::Zero();  ///< m: from the point to the middle of its cell
  double spin = 0;            ///< rad/s: of the second body over the first about the normal, by degrees of freedom

  /// m/s: of the ends of the cell about its middle, at a spin of `all` (rad/s).
  double speed_of_ends(double all) const;
};

class ContactCells {
 public:
  /// Of all contacts that were found. `is_of_disc(contact)`: see disc_contact.hpp.
  template <class IsOfDisc>
  void find(const mjData& d, const IsOfDisc& is_of_disc) {
    cells_.assign(std::size_t(d.ncon), {});
    for (int begin = 0, end = 0; begin < d.ncon; begin = end) {
      end = end_of_patch(d, begin);
      if (end > begin + 1) find_shifts(d, begin, end, is_of_disc(d.contact[begin]));
    }
  }
  /// After mj_makeConstraint: moves friction of each contact into the middle of its cell.
  void move_friction(const mjModel& m, mjData& d);
  const ContactCell& operator[](int contact) const { return cells_[std::size_t(contact)]; }

 private:
  /// Adjacent contacts of two geoms with one normal.
  static int end_of_patch(const mjData& d, int begin);
  void find_shifts(const mjData& d, int begin, int end, bool is_of_disc);

  std::vector<ContactCell> cells_;
};

}  // namespace muro::mujoco
