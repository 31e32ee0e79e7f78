// SPDX-License-Identifier: MIT
#include "subscription.hpp"

#include <cmath>

#include "values.hpp"

namespace muro::jsonrpc {

bool Subscription::is_due(std::int64_t time, bool at_step) {
  if (last_time_ == never) {
    begin_ = time;
    next_ = 0;
    return true;
  }
  if (timing_.is_on_change) return time - last_time_ >= timing_.period;
  return at_step && double(time - begin_) >= std::floor(double(next_) * 1e9 / timing_.rate);
}

bool Subscription::has_changed(const SceneNames& scene) {
  std::string bytes;
  for (const PropertyName& name : properties_) {
    const LiveProperty p = scene.live(name);
    bytes.append(reinterpret_cast<const char*>(&p.count), sizeof p.count);
    if (p.data) bytes.append(static_cast<const char*>(p.data), std::size_t(p.count) * p.key->type->size);
  }
  const bool is_first = last_time_ == never;
  if (bytes == last_bytes_ && !is_first) return false;
  last_bytes_ = std::move(bytes);
  return true;
}

Reply Subscription::update(const SceneNames& scene, std::int64_t time, bool at_step, bool has_room) {
  if (!is_due(time, at_step)) return nullptr;
  is_repeated_ = timing_.is_on_change && !has_changed(scene);
  if (is_repeated_ && lost_ == 0) return nullptr;
  last_time_ = time;
  if (!timing_.is_on_change)  // an instant after several due updates gives one update for all of them
    next_ = std::uint64_t(std::floor(double(time - begin_) * timing_.rate / 1e9 + 1e-9)) + 1;
  if (!has_room) {
    was_lost();
    return nullptr;
  }
  Reply values = Reply::object();
  for (const PropertyName& name : properties_)
    values.push_back({name.text, value_of(scene.live(name), scene.inspection(), timing_.encoding)});
  Reply params{{"subscription", number_}, {"time", time}, {"values", std::move(values)}};
  if (lost_ > 0) params["dropped"] = lost_;
  return {{"jsonrpc", "2.0"}, {"method", "update"}, {"params", std::move(params)}};
}

}  // namespace muro::jsonrpc
