// SPDX-License-Identifier: MIT
// Messages between robots by radio; see README.md.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "delivery.hpp"
#include "muro/base/number_text.hpp"
#include "muro/plugin.hpp"
#include "muro/toolkit/mounting.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "parameters.hpp"
#include "plugins/common/text/quote.hpp"
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
    {"radio.keep", "how long messages are listed, whole steps; a constant"},
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

/// Shadowing beyond this number of standard deviations is neglected.
constexpr double most_deviations = 4;

class LogDistance final : public Algorithm {
 public:
  void connect(Connector& c) override;
  void start() override;
  std::span<const Phase> phases() const override { return phases_; }
  void step(const Step& step, Range range) override;

 private:
  static Radio bind(Connector& c, std::uint32_t i);
  /// Returns the distance in m within which the strongest sender is received with at least `weakest` (dBm).
  double reach(double weakest) const;
  void find_distances();
  void tell_of_mistakes(Connector& c) const;
  CallNote* note() const { return notes_ ? &notes_->of_this_thread() : nullptr; }
  void send(const Radio& r, double now) const;
  /// Collects what receivers need of all radios, and advances the medium if it is shared. Called by one thread.
  void look_around(const Step& step);
  void contend(double now, std::uint64_t seed);

  CallNotes* notes_ = nullptr;
  Channel channel_;
  std::optional<line_of_sight::LineOfSight> sight_;
  std::vector<Radio> radios_;
  double hearing_ = 0, sensing_ = 0, disturbing_ = 0;  ///< m: ranges of the strongest sender
  SharedMedium medium_;
  // data of the present step
  std::vector<Vec3> places_;             ///< m, positions of the radios
  std::vector<CompleteFrame> complete_;  ///< complete frames of all radios
  std::vector<Vec3> complete_from_;      ///< m: positions of their senders
  SpatialHash hash_;                     ///< over complete_from_
  std::uint8_t somebody_receives_ = 0;
  const Phase phases_[3] = {{Phase::IndexSpace::items, Phase::Scope::own_robot},
                            {Phase::IndexSpace::whole},
                            {Phase::IndexSpace::items, Phase::Scope::reads_all, false, &somebody_receives_}};
};

Radio LogDistance::bind(Connector& c, std::uint32_t i) {
  const Item& item = c.items()[i];
  const ObjectId o = item.object;
  Radio r;
  r.parameters = radio_parameters(c.parameters_of(i));
  r.mounting = mounting_of(c.parameters_of(i));
  r.robot = item.robot->id;
  r.key = item.robot->key;
  c.set(o, keys::sensor_origin, r.mounting);
  c.set(o, keys::radio_keep, std::max(1.0, std::ceil(r.parameters.keep * c.rate() * (1 - 1e-9))) / c.rate());
  r.pose = c.read(o, keys::pose);
  r.send_bytes = c.input(o, keys::radio_send_bytes, Payload{});
  r.send_size = c.input(o, keys::radio_send_size, 0u);
  r.send_receiver = c.input(o, keys::radio_send_receiver, radio::broadcast);
  r.send_number = c.input(o, keys::radio_send_number, std::int64_t(0));
  r.received = c.variable_list(o, keys::radio_received);
  r.received_bytes = c.variable_list(o, keys::radio_received_bytes);
  r.last = c.variable(o, keys::radio_last, radio::Header{});
  r.last_bytes = c.variable(o, keys::radio_last_bytes, Payload{});
  r.counters = c.variable(o, keys::radio_counters, radio::Counters{});
  r.frames = c.variable_list(o, key_frames);
  r.arriving = c.variable_list(o, key_arriving);
  r.access = c.variable(o, key_access, Access{});
  return r;
}

void LogDistance::connect(Connector& c) {
  if (c.rate() <= 0)
    throw Error("a radio needs a `rate` in Hz, not on_demand: how often it looks for messages to send");
  channel_ = channel_parameters(c.parameters());
  if (channel_.obstacles != Obstacles::ignore) {
    sight_.emplace().connect(c);
    channel_.sight = &*sight_;
  }
  notes_ = CallNotes::of(c.host());
  CallNote* const noted = note();
  for (const Item& item : c.items()) {
    const auto i = std::uint32_t(radios_.size());
    if (noted) noted->set_item(i);
    if (!item.robot) throw Error("radios are parts of robots; name it in a robot, not under `algorithms`");
    check_same_channel(c.parameters_of(i), c.parameters(), c.items()[0].robot->name);
    radios_.push_back(bind(c, i));
  }
  tell_of_mistakes(c);
  find_distances();
}

/// Warns once about each setting that is possible but probably not intended.
void LogDistance::tell_of_mistakes(Connector& c) const {
  std::set<std::string> told;
  for (std::uint32_t i = 0; i < c.items().size(); ++i)
    for (const std::string& text : without_effect(c.parameters_of(i)))
      if (told.insert(text).second)
        c.host().log(LogLevel::warning, "robot " + quote(c.items()[i].robot->name) + ": " + text);
  const auto strongest = std::max_element(radios_.begin(), radios_.end(), [](const Radio& a, const Radio& b) {
    return a.parameters.tx_power < b.parameters.tx_power;
  });
  const double power = strongest->parameters.tx_power - channel_.path_loss.reference_loss;
  const auto hears = [&](const Radio& r) {
    return r.parameters.sensitivity <= power + most_deviations * channel_.shadowing_sigma;
  };
  if (std::none_of(radios_.begin(), radios_.end(), hears))
    c.host().log(LogLevel::warning,
                 "no radio of this channel hears another, however near: the strongest `tx_power` is "
                 "received with at most " +
                     number_text(power) + " dBm, which is below each `sensitivity`");
}

/// Neglects shadowing of more than `most_deviations` standard deviations.
double LogDistance::reach(double weakest) const {
  double strongest = -1e9;
  for (const Radio& r : radios_) strongest = std::max(strongest, r.parameters.tx_power);
  const double bearable = strongest - weakest + most_deviations * channel_.shadowing_sigma;
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

/// Reserves memory for `elements` elements, so that steps rarely allocate.
template <class T>
void make_room(const ListOut<T>& list, std::size_t elements) {
  if (!(*list).empty()) return;
  for (std::size_t i = 0; i < elements; ++i) list.push_back({});
  list.clear();
}

void LogDistance::start() {
  constexpr std::size_t memory = 32 << 20;  // bytes, for all radios together
  const std::size_t messages = std::clamp<std::size_t>(memory / (512 * radios_.size()), 4, 64);
  for (const Radio& r : radios_) {
    make_room(r.frames, messages / 4);
    make_room(r.arriving, messages / 8);
    make_room(r.received, messages);
    make_room(r.received_bytes, 32 * messages);
  }
  places_.resize(radios_.size());
  complete_.reserve(radios_.size());
  complete_from_.reserve(radios_.size());
  hash_.reserve(radios_.size());
  medium_.reserve(radios_.size());
}

void LogDistance::step(const Step& step, Range range) {
  if (step.phase == 1) return look_around(step);
  const Surroundings s{channel_, radios_,     places_,  complete_,      hash_,
                       medium_,  disturbing_, hearing_, step.seconds(), step.seed};
  if (step.phase == 0)
    for (const Radio& r : NotedSpan(radios_.data(), range, note())) send(r, s.now);
  else
    for (std::uint32_t i = range.begin; i < range.end; ++i) receive(s, i);
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
  medium_.advance(channel_, radios_, places_, sensing_, now, seed);
  double oldest = now;  // frames that overlap with this or a later instant are still needed
  for (const Radio& r : radios_) {
    complete_frames(r, now);
    for (const Frame& f : *r.frames)
      if (f.stage == Stage::on_air || f.stage == Stage::complete) oldest = std::min(oldest, f.start);
  }
  for (const Radio& r : radios_) forget_frames(r, oldest);
}

void LogDistance::look_around(const Step& step) {
  for (std::uint32_t i = 0; i < radios_.size(); ++i) places_[i] = *radios_[i].pose * radios_[i].mounting.position;
  if (sight_) sight_->begin_step();
  if (channel_.is_shared) contend(step.seconds(), step.seed);
  complete_.clear(), complete_from_.clear();
  bool something_arrives = false;
  for (std::uint32_t i = 0; i < radios_.size(); ++i) {
    something_arrives = something_arrives || !(*radios_[i].arriving).empty();
    for (const Frame& f : *radios_[i].frames) {
      if (f.stage != Stage::complete) continue;
      complete_.push_back({&f, f.receiver, i});
      complete_from_.push_back(places_[i]);
    }
  }
  somebody_receives_ = something_arrives || !complete_.empty();
  if (!somebody_receives_) return;
  hash_.build(complete_from_, hearing_);
  if (channel_.is_shared) medium_.list_transmissions(radios_, places_, disturbing_);
}

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<LogDistance>(description)};

}  // namespace
}  // namespace muro::log_distance

MURO_PLUGIN(.name = "radio_log_distance", .version = muro::log_distance::description.version, .licence = "MIT",
            .summary = "Radio messages between robots", .algorithms = muro::log_distance::algorithms)
