// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "muro/ext/inspection.hpp"
#include "rpc_error.hpp"

namespace muro::jsonrpc {

/// A property by its names. It is searched again for each read, because lists move in memory.
struct PropertyName {
  ObjectId object = no_object;
  std::string key;
  std::string text;  ///< "object:property"
};

/// The objects of a scene and their properties, by name.
class SceneNames {
 public:
  explicit SceneNames(Inspection& inspection);

  /// Adds a robot's name for its base: "rover" is then the same object as "rover/base_link".
  void add_robot(std::string name, ObjectId base) { robots_.emplace(std::move(name), base); }

  /// Adds a property that several algorithms add to, with its binding. Inspection does not show such sums.
  void add_sum(ObjectId object, const KeyInfo& key, const SumHeader* sum);

  Inspection& inspection() const { return inspection_; }
  /// Returns the object of a name. Throws RpcError with the nearest name when there is none.
  ObjectId object(std::string_view name) const;
  /// Returns the property "object:property". Throws RpcError with the nearest name when there is none.
  PropertyName property(std::string_view name) const;
  /// Returns the property as it is in memory now; valid until the next call.
  LiveProperty live(const PropertyName& name) const;

  /// Returns at most `most` names that match a pattern, in order of creation; `left_out`: number of further names. A
  /// pattern without a colon matches objects, a pattern with a colon "object:property".
  std::vector<std::string> matching(std::string_view pattern, std::size_t most, std::size_t& left_out) const;
  /// Returns the properties that a pattern "object:property" matches, or the property of a name without wildcards.
  /// Throws RpcError when there is none, or when there are more than `most`.
  std::vector<PropertyName> properties(std::string_view pattern, std::size_t most) const;

 private:
  template <class Visit>
  void each(std::string_view pattern, Visit visit) const;

  Inspection& inspection_;
  /// Returns all properties of an object; valid until the next call.
  const std::vector<LiveProperty>& all_of(ObjectId object) const;

  struct Sum {
    std::string key, unit;
    KeyInfo info;  ///< its texts are those of this struct
    const SumHeader* header;
    std::vector<double> total;
  };
  std::map<std::string, ObjectId, std::less<>> objects_, robots_;
  mutable std::multimap<ObjectId, Sum> sums_;
  mutable std::vector<LiveProperty> all_;
};

}  // namespace muro::jsonrpc
