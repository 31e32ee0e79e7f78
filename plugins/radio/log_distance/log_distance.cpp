// SPDX-License-Identifier: MIT
// Messages between robots by radio; see README.md.
#include <algorithm>
#include <limits>

#include "muro/plugin.hpp"
#include "muro/toolkit/mounting.hpp"
#include "parameters.hpp"
#include "reception.hpp"
#include "send_queue.hpp"
#include "shared_medium.hpp"

namespace muro::log_distance {
namespace {

constexpr PropertyUse reads[] = {
    {"pose", "of the radio's object"},
    {"scene.index", "of the world, unless `obstacles: ignore`"},
    {"radio.send.number", "another number: there is another message to send"},
    {"radio.send.bytes", "its bytes"},
    {"radio.send.size", "how many"},
    {"radio.send.receiver", "number of the robot that it is for; -1: all"},
};
constexpr PropertyUse writes[] = {
    {"radio.received", "list: headers of the messages that have come"},
    {"radio.received.bytes", "list: their bytes"},
    {"radio.last", "header of the last of them"},
    {"radio.last.bytes", "its bytes"},
    {"radio.counters", "messages sent, received and lost so far"},
    {"radio.frames", "messages of this sender on their way"},
    {"radio.arriving", "messages that have not come yet"},
    {"radio.access", "how the radio gets at the medium"},
    mounting_writes,
};

constexpr Description description{
    .id = "radio.log_distance",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "Messages between robots: log-distance path loss with shadowing, obstacles, bit errors, queues, CSMA-CA",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | world | allocation_free | restorable,
};

class LogDistance final : public Algorithm {
 public:
  void connect(Connector& c) override;
  void start() override;
  std::span<const Phase> phases() const override { return phases_; }
  void step(const Step& step, Range range) override;

 private:
  static Radio bind(Connector& c, std::uint32_t i);
  /// m: so far the strongest sender is received with a power (dBm).
  double reach(double weakest) const;
  void find_distances();
  void send(const Radio& r, double now) const;
  /// What receivers need of all radios, and the medium where they share one. By one thread.
  void look_around(const Step& step);
  void contend(double now, std::uint64_t seed);

  Channel channel_;
  std::optional<line_of_sight::LineOfSight> sight_;
  std::vector<Radio> radios_;
  double hearing_ = 0, sensing_ = 0, disturbing_ = 0;  ///< m: so far the strongest sender does so
  SharedMedium medium_;
  // of the present step
  std::vector<Vec3> places_;            ///< m, of the radios
  std::vector<std::uint32_t> members_;  ///< radios that may be heard
  std::vector<Vec3> member_places_;
  SpatialHash hash_;
  std::uint8_t somebody_receives_ = 0;
  const Phase phases_[3] = {{Phase::IndexSpace::items, Phase::Scope::own_robot},
                            {Phase::IndexSpace::whole},
                            {Phase::IndexSpace::items, Phase::Scope::reads_all, false, &somebody_receives_}};
};

Radio LogDistance::bind(Connector& c, std::uint32_t i) {
  const Item& item = c.items()[i];
  const ObjectId o = item.object;
  if (!item.robot) throw Error("radios are parts of robots; name it in a robot, not under `algorithms`");
  Radio r;
  r.parameters = radio_parameters(c.parameters_of(i));
  r.mounting = mounting_of(c.parameters_of(i));
  r.robot = std::int32_t(item.robot->number);
  r.key = item.robot->key;
  c.set(o, keys::sensor_origin, r.mounting);
  r.pose = c.read(o, keys::pose);
  r.send_bytes = c.input(o, radio::key_send_bytes, Payload{});
  r.send_size = c.input(o, radio::key_send_size, 0u);
  r.send_receiver = c.input(o, radio::key_send_receiver, radio::broadcast);
  r.send_number = c.input(o, radio::key_send_number, std::int64_t(0));
  r.received = c.variable_list(o, radio::key_received);
  r.received_bytes = c.variable_list(o, radio::key_received_bytes);
  r.last = c.variable(o, radio::key_last, radio::Header{});
  r.last_bytes = c.variable(o, radio::key_last_bytes, Payload{});
  r.counters = c.variable(o, radio::key_counters, radio::Counters{});
  r.frames = c.variable_list(o, key_frames);
  r.arriving = c.variable_list(o, key_arriving);
  r.access = c.variable(o, key_access, Access{});
  return r;
}

void LogDistance::connect(Connector& c) {
  if (c.rate() <= 0) throw Error("a radio needs a `rate`: how often it looks for messages to send");
  channel_ = channel_parameters(c.parameters());
  if (channel_.obstacles != Obstacles::ignore) {
    sight_.emplace().connect(c);
    channel_.sight = &*sight_;
  }
  for (std::uint32_t i = 0; i < c.items().size(); ++i) {
    check_same_channel(c.parameters_of(i), c.parameters());
    radios_.push_back(bind(c, i));
  }
  find_distances();
}

/// Beyond four standard deviations of the shadowing nobody listens.
double LogDistance::reach(double weakest) const {
  double strongest = -1e9;
  for (const Radio& r : radios_) strongest = std::max(strongest, r.parameters.tx_power);
  const double bearable = strongest - weakest + 4 * channel_.shadowing_sigma;
  return std::clamp(channel_.path_loss.distance_of(bearable), 1e-6, channel_.max_range);
}

void LogDistance::find_distances() {
  double received = 1e9, sensed = 1e9, noise = 1e9;
  for (const Radio& r : radios_) {
    received = std::min(received, r.parameters.sensitivity);
    sensed = std::min(sensed, r.parameters.carrier_sense);
    noise = std::min(noise, r.parameters.noise_floor);
  }
  hearing_ = reach(received);
  sensing_ = reach(sensed);
  disturbing_ = reach(noise - below_noise);
}

void LogDistance::start() {
  places_.resize(radios_.size());
  members_.reserve(radios_.size());
  member_places_.reserve(radios_.size());
  hash_.reserve(radios_.size());
  medium_.reserve(radios_.size());
}

void LogDistance::step(const Step& step, Range range) {
  if (step.phase == 1) return look_around(step);
  const Surroundings s{channel_, radios_,     places_,  members_,       hash_,
                       medium_,  disturbing_, hearing_, step.seconds(), step.seed};
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    if (step.phase == 0)
      send(radios_[i], s.now);
    else
      receive(s, i);
  }
}

void LogDistance::send(const Radio& r, double now) const {
  forget_messages(r, now);
  end_reception(r);
  if (!channel_.is_shared) forget_frames(r, std::numeric_limits<double>::infinity());
  take_message(r, now);
  if (channel_.is_shared) return;
  transmit(r);
  complete_frames(r, now);
}

void LogDistance::contend(double now, std::uint64_t seed) {
  medium_.advance(channel_, radios_, places_, hash_, sensing_, now, seed);
  double oldest = now;  // what overlaps with this or a later instant is needed
  for (const Radio& r : radios_) {
    complete_frames(r, now);
    for (const Frame& f : *r.frames)
      if (f.stage == Stage::on_air || f.stage == Stage::complete) oldest = std::min(oldest, f.start);
  }
  for (const Radio& r : radios_) forget_frames(r, oldest);
  medium_.list_transmissions(radios_);
}

void LogDistance::look_around(const Step& step) {
  const auto is_complete = [](const Frame& f) { return f.stage == Stage::complete; };
  const auto has_complete = [&](const Radio& r) {
    return std::any_of((*r.frames).begin(), (*r.frames).end(), is_complete);
  };
  members_.clear(), member_places_.clear();
  for (std::uint32_t i = 0; i < radios_.size(); ++i) {
    places_[i] = *radios_[i].pose * radios_[i].mounting.position;
    if (!channel_.is_shared && !has_complete(radios_[i])) continue;
    members_.push_back(i);
    member_places_.push_back(places_[i]);
  }
  hash_.build(member_places_, hearing_);
  if (sight_) sight_->begin_step();
  if (channel_.is_shared) contend(step.seconds(), step.seed);
  somebody_receives_ = std::any_of(radios_.begin(), radios_.end(),
                                   [&](const Radio& r) { return !(*r.arriving).empty() || has_complete(r); });
}

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<LogDistance>(description)};

}  // namespace
}  // namespace muro::log_distance

MURO_PLUGIN(.name = "radio_log_distance", .version = muro::log_distance::description.version, .licence = "MIT",
            .summary = "Radio messages between robots", .algorithms = muro::log_distance::algorithms)
