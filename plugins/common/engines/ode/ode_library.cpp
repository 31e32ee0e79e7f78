// SPDX-License-Identifier: MIT
#include "ode_library.hpp"

#include "error_trap.hpp"
#include "muro/algorithm.hpp"

namespace muro::ode {

void start_library() {
  struct Library {  // ODE counts its users: others in the process may use it as well
    bool runs = dInitODE2(0) != 0;
    ~Library() {
      if (runs) dCloseODE();
    }
  };
  static const Library library;
  if (!library.runs) throw Error("ODE cannot be started");
  set_error_handlers();
}

void prepare_this_thread() {
  thread_local const bool prepared = dAllocateODEDataForThread(dAllocateMaskAll) != 0;
  if (!prepared) throw Error("ODE has no memory for a thread");
}

dGeomID create_primitive(const Shape& shape, dSpaceID space) {
  const Vec3& size = shape.size;
  switch (shape.kind) {
    case ShapeKind::box:
      return dCreateBox(space, size.x(), size.y(), size.z());
    case ShapeKind::sphere:
      return dCreateSphere(space, size.x());
    case ShapeKind::cylinder:
      return dCreateCylinder(space, size.x(), size.z());
    case ShapeKind::capsule:
      return dCreateCapsule(space, size.x(), size.z());
    case ShapeKind::plane:
    case ShapeKind::mesh:
    case ShapeKind::heightmap:
      break;
  }
  return nullptr;
}

}  // namespace muro::ode
