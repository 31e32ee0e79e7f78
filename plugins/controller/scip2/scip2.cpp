// SPDX-License-Identifier: MIT
// Hokuyo laser scanners for drivers outside of the simulation, by SCIP 2.0; see README.md.
#include <array>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "device.hpp"
#include "laser.hpp"
#include "muro/plugin.hpp"
#include "plugins/controller/common/stream/stream.hpp"
#include "settings.hpp"

namespace {

using namespace muro;
using namespace muro::scip2;

constexpr auto parameters = [] {
  std::array<Parameter, device_parameters.size() + 2> all{};
  all[0] = stream::stream_parameter().required();
  all[1] = text("session", "power_cycle",
                "at a reset of the simulation: power_cycle: the device is switched off and on; keep: it goes on")
               .one_of(session_choices);
  for (std::size_t i = 0; i < device_parameters.size(); ++i) all[i + 2] = device_parameters[i];
  return all;
}();
constexpr PropertyUse reads[] = {{"ranges", "of the laser that it is on"},
                                 {"ranges.measured", "where the laser has a sensor.error"},
                                 {"laser.incidence", "for intensities, where the laser has it"}};
constexpr PropertyUse writes[] = {{"state.controller.scip2*", "what the device remembers, on the laser"}};
constexpr Description description{
    .id = "controller.scip2",
    .kind = Kind::controller,
    .version = "1.0.0",
    .summary = "A Hokuyo laser scanner (URG-04LX and others) for drivers outside of the simulation: SCIP 2.0",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable | runs_alone,
};

constexpr stream::Framing lines{.size_of_first = stream::line_size, .longest = 256, .keeps_too_long = true};
constexpr stream::Limits limits{.has_late_replies = true};

constexpr std::string_view state_name = "controller.scip2";

/// Returns the suffix for names of a device: empty, or ".2" and so on when a laser has several devices.
std::string suffix_of(const Connector& c, ObjectId laser) {
  std::string suffix;
  const auto is_taken = [&] {
    for (const FoundProperty& p : c.properties(laser))
      if (p.key->name == "state." + std::string(state_name) + suffix) return true;
    return false;
  };
  for (int number = 2; is_taken(); ++number) suffix = "." + std::to_string(number);
  return suffix;
}

/// Returns the bit rate of a line with transmission time; 0: bytes take no time, or the rate is unknown.
std::uint32_t line_rate(const stream::Address& a) {
  return a.is_timed || a.kind == stream::Address::Kind::serial ? a.baud : 0;
}

/// One device, its laser and its stream.
class Station final : private DeviceHost {
 public:
  Station(Connector& c, std::uint32_t number, const Model& model)
      : item_(c.items()[number]),
        laser_object_(Laser::find(c, item_)),
        suffix_(suffix_of(c, laser_object_)),
        stream_(c, std::string(c.object_name(laser_object_)) + suffix_,
                stream::read_address(c, number, c.parameters().texts("stream")), lines, limits),
        device_(model, Laser::is_swept(c, laser_object_), line_rate(stream_.address())) {
    state_ = static_cast<State*>(c.state_block(laser_object_, std::string(state_name) + suffix_, device_.state_size()));
    leaving_.reserve(stream_.address().clients);
  }
  ~Station() = default;

  void bind(Connector& c) {
    laser_.bind(c, laser_object_, device_.model());
    readings_ = std::make_unique<Readings>(device_.model(), laser_.grid());
  }

  void open() {
    while (unanswered_ > 0) answered();
    stream_.open();
  }

  void finish() { stream_.finish(); }

  /// Copies the state at `time` to a place that a reset does not change. No copy is needed if the device has had no
  /// client event and no scan since the last copy: then only its mirror has turned.
  void keep(std::int64_t time) {
    kept_time_ = time;
    if (!has_acted_ && has_kept()) return;
    has_acted_ = false;
    kept_.resize(device_.state_size());
    std::memcpy(kept_.data(), static_cast<const void*>(state_), kept_.size());
  }
  bool has_kept() const { return !kept_.empty(); }
  /// Handles a snapshot that has replaced the state: lines that are not in it need no answer any more.
  void restored() {
    while (unanswered_ > state_->pending_count) answered();
    has_acted_ = true;
    stream_.set_baud(state_->bit_rate);
  }
  /// Continues from the copy at `time`.
  void resume(std::int64_t time) {
    std::memcpy(static_cast<void*>(state_), kept_.data(), kept_.size());
    device_.shift(*state_, time - kept_time_);
  }

  void step(std::int64_t time) {
    stream_.begin(time);
    while (const stream::Event* event = stream_.next()) take(*event);
    if (!state_->is_on) stream_.set_baud(0);
    device_.advance(*state_, time, *this);
    std::erase_if(leaving_, [&](std::uint32_t client) {
      if (Device::owes(*state_, client)) return false;
      stream_.disconnect(client);
      return true;
    });
    stream_.set_subscribed(Device::sends_scans(*state_));
  }

 private:
  void take(const stream::Event& event) {
    has_acted_ = true;
    if (event.kind == stream::Event::Kind::disconnected) {
      device_.forget(*state_, event.client, *this);
      leaving_.push_back(event.client);
    }
    if (event.kind != stream::Event::Kind::message) return;
    ++unanswered_;
    std::string_view line = event.bytes;
    while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.remove_suffix(1);
    device_.receive(*state_, event.client, line, *this);
  }

  void send(std::uint32_t client, std::string_view bytes) override {
    has_acted_ = true;
    stream_.send(client, bytes);
  }
  void read_scan(std::span<std::uint32_t> distances, std::span<std::uint32_t> intensities) override {
    has_acted_ = true;
    laser_.read(*readings_, distances, intensities);
  }
  void answered() override {
    if (unanswered_ == 0) return;  // a restored snapshot has its own lines
    --unanswered_;
    stream_.answered();
  }
  void set_bit_rate(std::uint32_t bits_per_second) override { stream_.set_baud(bits_per_second); }

  Item item_;
  ObjectId laser_object_;
  std::string suffix_;
  stream::Stream stream_;
  Device device_;
  Laser laser_;
  std::unique_ptr<Readings> readings_;
  State* state_ = nullptr;
  std::uint32_t unanswered_ = 0;        ///< lines of the stream that need an answer
  bool has_acted_ = false;              ///< since the state was copied
  std::vector<std::uint32_t> leaving_;  ///< clients that send no more, but still wait for answers
  std::vector<char> kept_;
  std::int64_t kept_time_ = 0;
};

class Scip2 final : public Algorithm {
 public:
  void connect(Connector& c) override {
    if (c.items().empty())
      throw Error("it is a device on a robot; use it within one, `on` a laser, not under `algorithms`");
    model_ = read_model(c.parameters());
    check_rate(c.rate());
    keeps_session_ = c.parameters().text("session") == "keep";
    host_ = &c.host();
    for (std::uint32_t i = 0; i < c.items().size(); ++i) stations_.push_back(std::make_unique<Station>(c, i, model_));
  }

  void connect_by_name(Connector& c) override {
    for (const auto& s : stations_) s->bind(c);
  }

  void start() override {
    for (const auto& s : stations_) s->open();
    resumes_ = keeps_session_ && !stations_.empty() && stations_.front()->has_kept();
    if (resumes_)
      host_->log(LogLevel::info, "session: keep: devices go on as they were before the reset, which is no fresh start");
  }

  void restored() override {
    for (const auto& s : stations_) s->restored();
  }

  void finish() override {
    for (const auto& s : stations_) s->finish();
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase whole[] = {{Phase::IndexSpace::whole}};
    return whole;
  }

  void step(const Step& step, Range) override {
    for (const auto& s : stations_) {
      if (resumes_) s->resume(step.time);
      s->step(step.time);
      if (keeps_session_) s->keep(step.time);
    }
    resumes_ = false;
  }

 private:
  void check_rate(double rate) const {
    const double scans = 1e9 / double(model_.scan_period());
    if (rate == 0 || rate >= scans * (1 - 1e-6)) return;
    throw Error("its rate is " + std::to_string(std::lround(rate)) + " Hz, less than the " +
                std::to_string(std::lround(scans)) +
                " scans that the device takes in a second; 200 Hz answers within 5 ms");
  }

  Model model_;
  bool keeps_session_ = false, resumes_ = false;
  Host* host_ = nullptr;
  std::vector<std::unique_ptr<Station>> stations_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Scip2>(description)};

}  // namespace

MURO_PLUGIN(.name = "controller_scip2", .version = description.version, .licence = "MIT",
            .summary = "Hokuyo laser scanners for drivers: SCIP 2.0", .algorithms = algorithms)
