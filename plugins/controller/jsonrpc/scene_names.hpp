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

/// A property by its names. It is looked up anew wherever it is read: lists move.
struct PropertyName {
  ObjectId object = no_object;
  std::string key;
  std::string text;  ///< "object:property"
};

/// The objects of a scene and their properties, by name.
class SceneNames {
 public:
  explicit SceneNames(Inspection& inspection);

  /// "rover" is the base of the robot `rover`, as is "rover/base_link".
  void add_robot(std::string name, ObjectId base) { robots_.emplace(std::move(name), base); }

  /// A property that several algorithms add to, which inspection does not show, as it was bound.
  void add_sum(ObjectId object, const KeyInfo& key, const SumHeader* sum);

  Inspection& inspection() const { return inspection_; }
  /// Throws RpcError with the nearest name where there is none.
  ObjectId object(std::string_view name) const;
  /// "object:property". Throws RpcError with the nearest name where there is none.
  PropertyName property(std::string_view name) const;
  /// As it lies in memory now; good until the next call.
  LiveProperty live(const PropertyName& name) const;

  /// Names that match a pattern in order of creation, `most` at most; `left_out`: how many more there are. A pattern
  /// without a colon names objects, one with a colon "object:property".
  std::vector<std::string> matching(std::string_view pattern, std::size_t most, std::size_t& left_out) const;
  /// What a pattern "object:property" matches, or the one property of a name without wildcards. Throws RpcError where
  /// there is none, or more than `most`.
  std::vector<PropertyName> properties(std::string_view pattern, std::size_t most) const;

 private:
  template <class Visit>
  void each(std::string_view pattern, Visit visit) const;

  Inspection& inspection_;
  /// All properties of an object; good until the next call.
  const std::vector<LiveProperty>& all_of(ObjectId object) const;

  struct Sum {
    std::string key, unit;
    KeyInfo info;  ///< with these texts
    const SumHeader* header;
    std::vector<double> total;
  };
  std::map<std::string, ObjectId, std::less<>> objects_, robots_;
  mutable std::multimap<ObjectId, Sum> sums_;
  mutable std::vector<LiveProperty> all_;
};

}  // namespace muro::jsonrpc
