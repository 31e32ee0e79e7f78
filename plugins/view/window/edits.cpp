// SPDX-License-Identifier: MIT
#include "edits.hpp"

#include <cstring>

#include "muro/vocabulary.hpp"
#include "property_scalars.hpp"

namespace muro::view {

namespace {

template <class T>
void take(T& value, const LiveProperty& p) {
  std::memcpy(static_cast<void*>(&value), p.data, sizeof value);
}

}  // namespace

void Edits::enter(Inspection& simulation, ObjectId object, const LiveProperty& property, std::uint32_t i,
                  double value) {
  problem_.clear();
  const std::uint32_t size = property.key->type->size, element = i / property.key->type->scalars();
  std::vector<std::byte> bytes(std::size_t(size) * property.count);
  std::memcpy(bytes.data(), property.data, bytes.size());
  LiveProperty changed = property;
  changed.data = bytes.data();
  if (!Scalars(changed).set(i, value)) {
    problem_ = "this value is out of range";
    return;
  }
  const std::string name(property.key->name);
  if (name == keys::pose.name || name == keys::twist.name) return place(simulation, object, changed);
  control_->set(object, name, element, {reinterpret_cast<const char*>(bytes.data()) + element * size, size}, 0, this);
}

void Edits::place(Inspection& simulation, ObjectId object, const LiveProperty& changed) {
  Placement placement{object};
  for (const LiveProperty& p : simulation.properties(object)) {
    if (p.key->name == keys::pose.name) take(placement.pose, p);
    if (p.key->name == keys::twist.name) take(placement.twist, p);
  }
  if (changed.key->type->name == ValueTraits<Pose>::name)
    take(placement.pose, changed);
  else
    take(placement.twist, changed);
  control_->place(placement, 0, this);
}

void Edits::done(std::uint64_t, std::string_view problem) noexcept { problem_ = problem; }

}  // namespace muro::view
