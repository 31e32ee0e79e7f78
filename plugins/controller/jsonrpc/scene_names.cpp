// SPDX-License-Identifier: MIT
#include "scene_names.hpp"

#include <algorithm>

#include "plugins/common/text/glob.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::jsonrpc {

namespace {

/// Most names that a wrong name is compared with, because comparing takes time.
constexpr std::size_t most_candidates = 5000;

template <class Names>
std::vector<std::string> some_of(const Names& names) {
  std::vector<std::string> some;
  for (const auto& [name, unused] : names)
    if (some.size() < most_candidates) some.push_back(name);
  return some;
}

bool has_wildcards(std::string_view pattern) { return pattern.find_first_of("*?") != std::string_view::npos; }

}  // namespace

SceneNames::SceneNames(Inspection& inspection) : inspection_(inspection) {
  for (std::uint32_t i = 0; i < inspection.object_count(); ++i)
    objects_.emplace(inspection.object_name(ObjectId{i}), ObjectId{i});
}

void SceneNames::add_sum(ObjectId object, const KeyInfo& key, const SumHeader* header) {
  Sum& sum = sums_.emplace(object, Sum{std::string(key.name), std::string(key.unit), key, header, {}})->second;
  sum.info.name = sum.key;
  sum.info.unit = sum.unit;
  sum.info.doc = {};
  sum.total.resize(key.type->scalars());
}

const std::vector<LiveProperty>& SceneNames::all_of(ObjectId object) const {
  const std::span<const LiveProperty> shown = inspection_.properties(object);
  all_.assign(shown.begin(), shown.end());
  const auto [begin, end] = sums_.equal_range(object);
  for (auto i = begin; i != end; ++i) {
    Sum& sum = i->second;
    std::fill(sum.total.begin(), sum.total.end(), 0.0);
    for (std::uint64_t k = 0; k < sum.header->size; ++k)
      for (std::size_t c = 0; c < sum.total.size(); ++c)
        sum.total[c] += static_cast<const double*>(sum.header->slots[k])[c];
    all_.push_back({&sum.info, Multiplicity::single, 1, sum.total.data(), false, false, {}});
  }
  return all_;
}

ObjectId SceneNames::object(std::string_view name) const {
  if (const auto found = objects_.find(name); found != objects_.end()) return found->second;
  if (const auto found = robots_.find(name); found != robots_.end()) return found->second;
  throw RpcError{Code::not_there, "there is no object " + quote(name), nearest_as_data(name, some_of(objects_))};
}

PropertyName SceneNames::property(std::string_view name) const {
  const std::size_t colon = name.rfind(':');
  if (colon == std::string_view::npos)
    throw RpcError{Code::invalid_params,
                   quote(name) + " must be \"object:property\", such as \"rover/base_link:pose\"; `list` has all"};
  const ObjectId object_id = object(name.substr(0, colon));
  const std::string_view key = name.substr(colon + 1);
  const std::string object_name(inspection_.object_name(object_id));
  std::vector<std::string> keys;
  for (const LiveProperty& p : all_of(object_id)) {
    if (p.key->name == key) return {object_id, std::string(key), object_name + ":" + std::string(key)};
    keys.emplace_back(p.key->name);
  }
  Reply data = nearest_as_data(key, keys);
  if (!data.is_null()) data["did_you_mean"] = object_name + ":" + data["did_you_mean"].get<std::string>();
  throw RpcError{Code::not_there, quote(object_name) + " has no property " + quote(key), std::move(data)};
}

LiveProperty SceneNames::live(const PropertyName& name) const {
  for (const LiveProperty& p : all_of(name.object))
    if (p.key->name == name.key) return p;
  throw RpcError{Code::not_there, quote(name.text) + " is not there any more"};
}

/// Calls `visit` with the object, the key ("" for objects) and the name of each match.
template <class Visit>
void SceneNames::each(std::string_view pattern, Visit visit) const {
  const bool names_objects = pattern.find(':') == std::string_view::npos;
  for (std::uint32_t i = 0; i < inspection_.object_count(); ++i) {
    const ObjectId id{i};
    std::string name(inspection_.object_name(id));
    if (names_objects) {
      if (matches(pattern, name)) visit(id, std::string_view(), name);
      continue;
    }
    name += ':';
    const std::size_t stem = name.size();
    for (const LiveProperty& p : all_of(id)) {
      name.resize(stem);
      name += p.key->name;
      if (matches(pattern, name)) visit(id, p.key->name, name);
    }
  }
}

std::vector<std::string> SceneNames::matching(std::string_view pattern, std::size_t most, std::size_t& left_out) const {
  std::vector<std::string> names;
  left_out = 0;
  each(pattern, [&](ObjectId, std::string_view, const std::string& name) {
    if (names.size() < most)
      names.push_back(name);
    else
      ++left_out;
  });
  return names;
}

std::vector<PropertyName> SceneNames::properties(std::string_view pattern, std::size_t most) const {
  if (!has_wildcards(pattern) || pattern.find(':') == std::string_view::npos) return {property(pattern)};
  std::vector<PropertyName> found;
  each(pattern, [&](ObjectId object, std::string_view key, const std::string& name) {
    if (found.size() >= most)
      throw RpcError{Code::too_many, quote(pattern) + " matches more than " + std::to_string(most) + " properties"};
    found.push_back({object, std::string(key), name});
  });
  if (found.empty()) throw RpcError{Code::not_there, "no property matches " + quote(pattern)};
  return found;
}

}  // namespace muro::jsonrpc
