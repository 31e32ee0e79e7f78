// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/column.hpp"
#include "core/sparse_bytes.hpp"
#include "muro/connector.hpp"

namespace muro {

/// The user of properties: an algorithm instance, or the set-up itself.
using Accessor = std::uint32_t;
inline constexpr Accessor setup_accessor = 0;

using SlotId = std::uint32_t;

/// One place in memory. Several (object, key) pairs may name it.
struct Slot {
  enum class Class : std::uint8_t { unknown, constant, variable, derived };
  struct User {
    Accessor accessor;
    Usage usage;
  };

  ObjectId object = no_object;  ///< the object through which it was created
  std::uint32_t column = 0;
  Class kind = Class::unknown;
  Multiplicity multiplicity = Multiplicity::single;
  bool initialised = false;
  std::uint32_t count = 1;
  void* place = nullptr;  ///< the value, the first element, or the ListHeader
  ArrayHeader* array = nullptr;
  SumHeader* sum = nullptr;
  std::vector<void*> contributions;  ///< contributions to a sum, in registration order
  std::vector<User> users;

  bool used_as(Usage usage) const;
  /// Returns the user that writes it, or null.
  const User* writer() const;
};

/// All properties of all objects.
///
/// The memory of a property is reserved when it is first mentioned and never moves, so that algorithms can get handles
/// while they connect, in any order. Mistakes are collected, and `check` reports them.
class PropertyStore {
 public:
  PropertyStore();
  ~PropertyStore();
  PropertyStore(const PropertyStore&) = delete;
  PropertyStore& operator=(const PropertyStore&) = delete;

  void add_object(std::string name);
  /// Sets the memory partition of each object, by id; 0 for objects that come later. Memory that is reserved from now
  /// on lies a page apart between partitions.
  void set_partitions(std::vector<std::uint32_t> partitions) { partitions_ = std::move(partitions); }
  const std::string& object_name(ObjectId id) const { return names_[index_of(id)]; }
  Accessor add_accessor(std::string name);
  const std::string& accessor_name(Accessor p) const { return accessors_[p]; }

  /// Sets a constant. `count`: elements, or single_value. A second value for the same property replaces the first.
  void set_constant(ObjectId object, const KeyInfo& key, const void* data, std::uint32_t count);
  /// Returns the value of a constant, or no data.
  ArrayHeader constant(ObjectId object, const KeyInfo& key) const;

  /// Declares two properties equal: they have one place in memory. Allowed before or after they exist, until an
  /// algorithm holds a handle to both.
  void share(ObjectId a, const KeyInfo& key_a, ObjectId b, const KeyInfo& key_b);

  /// Returns a place for `accessor`; see Connector for the arguments. Never fails: a request that clashes gets a place
  /// of its own and adds a problem. `inactive`: the accessor does not write at the start, so its initial value counts
  /// only when there is no other.
  void* bind(Accessor accessor, ObjectId object, const KeyInfo& key, Usage usage, Multiplicity multiplicity,
             std::uint32_t count, const void* initial, bool inactive = false);
  /// Lets these accessors write the same properties of these objects, one at a time.
  void let_alternate(const std::vector<ObjectId>& objects, const std::vector<Accessor>& accessors);
  /// Returns bytes of state that have a name of their own.
  void* state_block(Accessor accessor, ObjectId object, std::string_view name, std::uint32_t size);

  /// Throws SetupError with every problem found. `writers_of(key)` returns the names of algorithms that write a key.
  void check(const std::function<std::string(std::string_view)>& writers_of) const;

  /// Returns the slot of a property, or null.
  const Slot* find(ObjectId object, std::string_view key) const;
  const Slot& slot(SlotId id) const { return slots_[id]; }
  const KeyInfo& key_of(const Slot& s) const { return columns_[s.column].key(); }
  /// All properties of an object with the names that the object uses for them, in order of creation.
  struct NamedSlot {
    std::string_view key;
    SlotId slot;
  };
  const std::vector<NamedSlot>& properties(ObjectId object) const { return objects_[index_of(object)]; }
  std::uint32_t slot_count() const { return std::uint32_t(slots_.size()); }
  /// The slots that `accessor` has bound, in the order of binding.
  const std::vector<SlotId>& slots_of(Accessor accessor) const { return bound_[accessor]; }

  /// A copy of the memory of all properties, without transient values.
  struct Image {
    std::vector<SparseBytes> blocks;
    std::vector<std::vector<std::byte>> lists;
  };
  Image save() const;
  void load(const Image& image);
  /// Sets the value of a property to zero; empties a list.
  void clear(SlotId id);
  /// Returns the hash of the variable properties of one object; it does not depend on the order of declarations.
  std::uint64_t hash(ObjectId object) const;

 private:
  bool alternate(ObjectId object, Accessor a, Accessor b) const {
    return alternating_.count({object, a}) > 0 && alternating_.count({object, b}) > 0;
  }
  std::uint32_t column_of(Accessor accessor, const KeyInfo& key);
  SlotId find_id(ObjectId object, std::string_view key) const;
  SlotId slot_for(Accessor accessor, ObjectId object, const KeyInfo& key);
  std::uint32_t partition_of(ObjectId id) const {
    return index_of(id) < partitions_.size() ? partitions_[index_of(id)] : 0;
  }
  void reserve(Slot& s, Multiplicity multiplicity, std::uint32_t count);
  void use(Slot& s, SlotId id, Accessor accessor, Usage usage);
  void* handle(Slot& s, Usage usage);
  std::string where(ObjectId object, std::string_view key) const;
  std::string who(Accessor p) const;
  struct TwoWriters;
  static void add(std::vector<TwoWriters>& all, TwoWriters found);
  void check_slot(const Slot& s, const std::function<std::string(std::string_view)>& writers_of,
                  std::vector<TwoWriters>& two_writers, std::vector<std::string>& problems) const;

  std::vector<std::string> names_;
  std::vector<std::uint32_t> partitions_;  ///< indexed by object
  std::vector<std::string> accessors_;
  std::vector<Accessor> column_accessor_;  ///< the accessor that declared the key first
  std::deque<Column> columns_;
  std::map<std::string, std::uint32_t, std::less<>> column_index_;
  std::deque<std::string> texts_;  ///< names of state blocks
  std::deque<Slot> slots_;
  std::vector<std::vector<NamedSlot>> objects_;
  std::vector<std::vector<SlotId>> bound_;
  std::deque<ArrayHeader> arrays_;
  std::deque<ListHeader> lists_;
  std::deque<SumHeader> sums_;
  std::set<std::pair<ObjectId, Accessor>> alternating_;
  std::vector<std::string> problems_;
};

}  // namespace muro
