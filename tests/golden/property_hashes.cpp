// SPDX-License-Identifier: MIT
#include "tests/golden/property_hashes.hpp"

#include <cstdio>
#include <optional>
#include <set>

#include "core/hash.hpp"
#include "muro/base/random.hpp"

namespace muro::test {

namespace {

/// Names in the order of Slot::Class.
constexpr const char* class_names[] = {"unknown", "constant", "variable", "derived"};

std::string text_of(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

/// Returns the hash of the present value of a property, or nothing if it has no memory.
std::optional<std::uint64_t> hash_of(const Slot& slot, std::size_t element_size) {
  if (slot.multiplicity == Multiplicity::list && slot.place) {
    const auto& list = *static_cast<const ListHeader*>(slot.place);
    return hash_bytes(list.data, list.size * element_size, 0);
  }
  if (slot.multiplicity == Multiplicity::array && slot.array)
    return hash_bytes(slot.array->data, slot.array->size * element_size, 0);
  if (slot.place) return hash_bytes(slot.place, element_size, 0);
  if (slot.contributions.empty()) return std::nullopt;
  std::uint64_t h = 0;  // A sum is hashed as its contributions, one after the other.
  for (const void* contribution : slot.contributions) h = hash_bytes(contribution, element_size, h);
  return h;
}

}  // namespace

std::map<std::string, std::string> property_hashes(const World& world) {
  std::map<std::string, std::string> all;
  const PropertyStore& store = world.store();
  for (std::uint32_t i = 0; i < world.object_count(); ++i) {
    for (const PropertyStore::NamedSlot& named : store.properties(ObjectId{i})) {
      const Slot& slot = store.slot(named.slot);
      const ValueType& type = *store.key_of(slot).type;
      const std::optional<std::uint64_t> hash = hash_of(slot, type.size);
      if (!hash || slot.kind == Slot::Class::unknown || type.scalar == Scalar::transient) continue;
      all[world.object_name(ObjectId{i}) + ":" + std::string(named.key)] =
          std::string(class_names[std::size_t(slot.kind)]) + " " + text_of(*hash);
    }
  }
  return all;
}

std::map<std::string, std::string> hashes_by_key(const std::map<std::string, std::string>& of_properties) {
  struct OfKey {
    std::set<std::string> classes;
    std::uint64_t hash = fnv1a("");
  };
  std::map<std::string, OfKey> found;
  for (const auto& [name, value] : of_properties) {
    const std::size_t colon = name.rfind(':');
    OfKey& of = found[name.substr(colon + 1)];
    of.classes.insert(value.substr(0, value.find(' ')));
    of.hash = fnv1a(name.substr(0, colon) + " " + value + "\n", of.hash);
  }
  std::map<std::string, std::string> all;
  for (const auto& [key, of] : found) {
    std::string classes;
    for (const std::string& c : of.classes) classes += (classes.empty() ? "" : "+") + c;
    all[key] = classes + " " + text_of(of.hash);
  }
  return all;
}

}  // namespace muro::test
