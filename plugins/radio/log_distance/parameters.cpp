// SPDX-License-Identifier: MIT
#include "parameters.hpp"

#include <algorithm>
#include <initializer_list>
#include <string>

#include "muro/base/number_text.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::log_distance {

namespace {

/// Parameters of the channel, equal for all radios of a world.
constexpr std::string_view shared_numbers[] = {
    "frequency",     "reference_loss", "reference_distance", "exponent",        "shadowing_sigma",
    "obstacle_loss", "max_range",      "propagation_speed",  "noise_bandwidth", "capture"};
constexpr std::string_view shared_words[] = {"shadowing", "obstacles", "modulation", "medium"};

template <std::size_t n>
std::size_t place_of(std::string_view word, const std::string_view (&words)[n]) {
  return std::size_t(std::find(words, words + n, word) - words);
}

/// Returns the given value, or the loss in free space (dB) when none is given.
double reference_loss(const Parameters& p) {
  if (p.given("reference_loss")) return p.real("reference_loss");
  return free_space_loss(p.real("reference_distance"), p.real("frequency"), p.real("propagation_speed"));
}

}  // namespace

RadioParameters radio_parameters(const Parameters& p) {
  if (p.integer("min_exponent") > p.integer("max_exponent"))
    throw Error("min_exponent (" + std::to_string(p.integer("min_exponent")) + ") is above max_exponent (" +
                std::to_string(p.integer("max_exponent")) + "); exchange them");
  return {.tx_power = p.real("tx_power"),
          .sensitivity = p.real("sensitivity"),
          .noise_floor = p.real("noise_floor"),
          .bit_rate = p.real("bit_rate"),
          .overhead = p.real("overhead"),
          .queue = std::size_t(p.integer("queue")),
          .keep = p.real("keep"),
          .carrier_sense = p.real("carrier_sense"),
          .turnaround = p.real("turnaround"),
          .backoff_slot = p.real("backoff_slot"),
          .min_exponent = std::uint32_t(p.integer("min_exponent")),
          .max_exponent = std::uint32_t(p.integer("max_exponent")),
          .max_backoffs = std::uint32_t(p.integer("max_backoffs"))};
}

Channel channel_parameters(const Parameters& p) {
  Channel c;
  const double d0 = p.real("reference_distance");
  c.path_loss = {reference_loss(p), d0, p.real("exponent")};
  c.shadowing_sigma = p.real("shadowing_sigma");
  c.shadowing = Shadowing(place_of(p.text("shadowing"), shadowings));
  c.obstacles = Obstacles(place_of(p.text("obstacles"), obstacle_rules));
  c.obstacle_loss = p.real("obstacle_loss");
  c.max_range = p.real("max_range");
  c.speed = p.real("propagation_speed");
  c.noise_bandwidth = p.real("noise_bandwidth");
  constexpr Modulation models[] = {Modulation::none, Modulation::psk, Modulation::psk, Modulation::oqpsk};
  c.modulation = models[place_of(p.text("modulation"), modulations)];
  c.capture = p.real("capture");
  c.is_shared = p.text("medium") == "shared";
  c.key = fnv1a(p.text("world"));
  return c;
}

void check_same_channel(const Parameters& p, const Parameters& of_the_first, std::string_view first) {
  const auto refuse = [&](std::string_view name, const std::string& value, const std::string& other) {
    throw Error(quote(name) + " is " + value + ", but " + other + " for the radio of " + quote(first) +
                ", which is of the same channel; give both the same, or another `world` to one of them");
  };
  for (const std::string_view name : shared_numbers) {
    const bool has_own_default = name == "reference_loss";
    const double value = has_own_default ? reference_loss(p) : p.real(name);
    const double other = has_own_default ? reference_loss(of_the_first) : of_the_first.real(name);
    if (value != other) refuse(name, number_text(value), number_text(other));
  }
  for (const std::string_view name : shared_words)
    if (p.text(name) != of_the_first.text(name)) refuse(name, quote(p.text(name)), quote(of_the_first.text(name)));
}

std::vector<std::string> without_effect(const Parameters& p) {
  std::vector<std::string> names;
  const auto add = [&](std::initializer_list<std::string_view> all, bool has_effect, std::string_view why) {
    for (const std::string_view name : all)
      if (!has_effect && p.given(name)) names.push_back(quote(name) + " has no effect with " + quote(why));
  };
  const std::string_view medium = p.text("medium"), modulation = p.text("modulation"), obstacles = p.text("obstacles");
  add({"carrier_sense", "turnaround", "backoff_slot", "min_exponent", "max_exponent", "max_backoffs", "capture"},
      medium == "shared", "medium: separate");
  add({"capture"}, medium != "shared" || modulation == "none", "modulation: " + std::string(modulation));
  add({"noise_bandwidth"}, modulation != "none", "modulation: none");
  add({"noise_floor"}, modulation != "none" || medium == "shared", "modulation: none");
  add({"obstacle_loss"}, obstacles == "loss", "obstacles: " + std::string(obstacles));
  add({"shadowing"}, p.real("shadowing_sigma") > 0, "shadowing_sigma: 0");
  return names;
}

}  // namespace muro::log_distance
