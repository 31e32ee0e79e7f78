// SPDX-License-Identifier: MIT
#include "scenery_kernel.hpp"

#include "lanes/contact_passes.hpp"
#include "lanes/line_pass.hpp"

namespace muro::penalty {
namespace {

unsigned apply_forces(const KernelBatch& batch, const KernelRobot* const* robots, int count) {
  return lane::in_lanes(count, [&]<class S>(int first, int used) {
    return law::RobotContacts<S>(batch, robots + first, used).apply_forces();
  });
}

}  // namespace

namespace MURO_ISA {
extern const SceneryKernels scenery_kernels;
const SceneryKernels scenery_kernels{&apply_forces};
}  // namespace MURO_ISA

}  // namespace muro::penalty
