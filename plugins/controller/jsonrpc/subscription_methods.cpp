// SPDX-License-Identifier: MIT
// Methods that start and end subscriptions.
#include <algorithm>

#include "method.hpp"
#include "plugins/common/text/quote.hpp"
#include "values.hpp"

namespace muro::jsonrpc {

namespace {

constexpr std::size_t most_subscribed = 1000;             ///< properties of one subscription
constexpr std::size_t most_subscribed_numbers = 200'000;  ///< for each client

/// Returns all properties that the request names, each once, and their number of values.
std::vector<PropertyName> subscribed(const Call& c, std::size_t& numbers) {
  const SceneNames& scene = c.served.scene;
  std::vector<PropertyName> all;
  const Encoding encoding = encoding_of(c.params);
  std::size_t of_others = 0;
  for (const Subscription& s : c.client.subscriptions) of_others += s.numbers();
  for (const std::string& pattern : c.params.texts("properties", most_subscribed)) {
    const bool is_pattern = pattern.find_first_of("*?") != std::string::npos;
    for (PropertyName& name : scene.properties(pattern, most_subscribed)) {
      const LiveProperty p = scene.live(name);
      if (!has_values(p) && is_pattern) continue;
      if (!has_values(p)) throw RpcError{Code::refused, quote(name.text) + " is not made of numbers"};
      const auto is_same = [&](const PropertyName& other) { return other.text == name.text; };
      if (std::any_of(all.begin(), all.end(), is_same)) continue;
      numbers += cost_of(p, encoding);
      all.push_back(std::move(name));
    }
  }
  if (all.size() > most_subscribed || of_others + numbers > most_subscribed_numbers)
    throw RpcError{Code::too_many, "a subscription has at most " + std::to_string(most_subscribed) +
                                       " properties, and all those of a client have at most " +
                                       std::to_string(most_subscribed_numbers) + " numbers"};
  if (all.empty()) throw RpcError{Code::not_there, "nothing that matches is made of numbers"};
  return all;
}

}  // namespace

void subscribe(Call& c) {
  if (c.client.subscriptions.size() >= Conversation::most_subscriptions)
    throw RpcError{Code::too_many, "a client has at most " + std::to_string(Conversation::most_subscriptions) +
                                       " subscriptions; end one with `unsubscribe`"};
  Subscription::Timing timing;
  timing.encoding = encoding_of(c.params);
  timing.is_on_change = c.params.flag("on_change", false);
  if (timing.is_on_change == c.params.has("rate"))
    throw RpcError{Code::invalid_params, "give either `rate`, in Hz of simulated time, or `on_change`: true"};
  if (!timing.is_on_change) timing.rate = c.params.real("rate", 1e-6, 1e6);
  if (c.params.has("least_period")) {
    if (!timing.is_on_change)
      throw RpcError{Code::invalid_params, "`least_period` is for subscriptions with `on_change`"};
    timing.period = std::int64_t(1e9 * c.params.real("least_period", 0, 1e9));
  }
  std::size_t numbers = 0;
  std::vector<PropertyName> properties = subscribed(c, numbers);
  Reply names = Reply::array();
  for (const PropertyName& p : properties) names.push_back(p.text);
  const std::uint32_t number = ++c.client.last_subscription;
  c.client.subscriptions.emplace_back(number, std::move(properties), numbers, timing);
  c.answer({{"subscription", number}, {"properties", std::move(names)}});
}

void unsubscribe(Call& c) {
  const std::int64_t number = c.params.integer("subscription", 1, 0xffffffff);
  const auto ended = std::erase_if(c.client.subscriptions, [&](const Subscription& s) { return s.number() == number; });
  if (ended == 0) throw RpcError{Code::not_there, "this client has no subscription " + std::to_string(number)};
  c.answer({{"subscription", number}});
}

}  // namespace muro::jsonrpc
