// SPDX-License-Identifier: MIT
#include "parameters.hpp"

#include <algorithm>
#include <string>

namespace muro::log_distance {

namespace {

/// Of the channel: the same for all radios of a world.
constexpr std::string_view shared_numbers[] = {
    "frequency",     "reference_loss", "reference_distance", "exponent",        "shadowing_sigma",
    "obstacle_loss", "max_range",      "propagation_speed",  "noise_bandwidth", "capture"};
constexpr std::string_view shared_words[] = {"shadowing", "obstacles", "modulation", "medium"};

template <std::size_t n>
std::size_t place_of(std::string_view word, const std::string_view (&words)[n]) {
  return std::size_t(std::find(words, words + n, word) - words);
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
  const double d0 = p.real("reference_distance"), speed = p.real("propagation_speed");
  c.path_loss = {p.given("reference_loss") ? p.real("reference_loss") : free_space_loss(d0, p.real("frequency"), speed),
                 d0, p.real("exponent")};
  c.shadowing_sigma = p.real("shadowing_sigma");
  c.shadowing = Shadowing(place_of(p.text("shadowing"), shadowings));
  c.obstacles = Obstacles(place_of(p.text("obstacles"), obstacle_rules));
  c.obstacle_loss = p.real("obstacle_loss");
  c.max_range = p.real("max_range");
  c.speed = speed;
  c.noise_bandwidth = p.real("noise_bandwidth");
  constexpr Modulation models[] = {Modulation::none, Modulation::psk, Modulation::psk, Modulation::oqpsk};
  c.modulation = models[place_of(p.text("modulation"), modulations)];
  c.capture = p.real("capture");
  c.is_shared = p.text("medium") == "shared";
  c.key = fnv1a(p.text("world"));
  return c;
}

void check_same_channel(const Parameters& p, const Parameters& of_the_first) {
  const auto refuse = [&](std::string_view name, const std::string& value, const std::string& first) {
    throw Error(std::string(name) + " is " + value + ", but " + first +
                " for other radios of the same channel; give all of them the same, or another `world` to some");
  };
  for (const std::string_view name : shared_numbers)
    if (p.real(name) != of_the_first.real(name) || p.given(name) != of_the_first.given(name))
      refuse(name, p.given(name) ? std::to_string(p.real(name)) : "not given",
             of_the_first.given(name) ? std::to_string(of_the_first.real(name)) : "not given");
  for (const std::string_view name : shared_words)
    if (p.text(name) != of_the_first.text(name))
      refuse(name, std::string(p.text(name)), std::string(of_the_first.text(name)));
}

}  // namespace muro::log_distance
