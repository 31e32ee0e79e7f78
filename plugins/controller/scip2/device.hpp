// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "encoding.hpp"
#include "model.hpp"
#include "scan_block.hpp"
#include "state.hpp"

namespace muro::scip2 {

/// The environment of a device.
class DeviceHost {
 public:
  /// Sends bytes to a client: one reply, or one scan.
  virtual void send(std::uint32_t client, std::string_view bytes) = 0;
  /// Fills in the present reading of each step from AMIN to AMAX: mm or an error code, and the intensity.
  virtual void read_scan(std::span<std::uint32_t> distances, std::span<std::uint32_t> intensities) = 0;
  /// Reports that a line from Device::receive was answered.
  virtual void answered() {}
  /// Sets the bit rate; 0: the rate at the start.
  virtual void set_bit_rate(std::uint32_t bits_per_second) { static_cast<void>(bits_per_second); }

 protected:
  ~DeviceHost() = default;
};

/// Initial bit rate, bit/s, of a line without transmission time.
inline constexpr std::uint32_t usual_bit_rate = 19200;

/// A scanner that speaks SCIP: turns lines, time and scans into replies. Its only memory is the state that it is given.
class Device {
 public:
  /// `is_swept`: read_scan returns readings taken during the last turn of the mirror; else at the instant of the call.
  /// `line_rate`: initial rate of a line with transmission time, bit/s; 0: bytes take no time.
  explicit Device(Model model, bool is_swept = false, std::uint32_t line_rate = 0);

  const Model& model() const { return model_; }
  std::uint32_t state_size() const;  ///< bytes

  /// Takes a line without its end. Ignores empty lines. `advance` answers the line. Only when sixteen others wait, it
  /// is refused at once (0B).
  void receive(State& s, std::uint32_t client, std::string_view line, DeviceHost& host);
  /// Does everything due up to `now`: turns of the mirror, scans, replies. Switches the device on if it is off.
  void advance(State& s, std::int64_t now, DeviceHost& host);
  /// Handles a client that sends no more: its scans by `M_` end. Its other lines are answered.
  void forget(State& s, std::uint32_t client, DeviceHost& host) const;
  /// Whether lines of the client wait for their answers.
  static bool owes(const State& s, std::uint32_t client);
  static bool sends_scans(const State& s) { return Command(s.measurement.command) != Command::none; }
  /// Moves all times of the state by `offset` ns.
  void shift(State& s, std::int64_t offset) const;

 private:
  /// A line and the data for its answer.
  struct Call {
    State& state;
    std::int64_t now;
    std::uint32_t client;
    std::string_view line;
    DeviceHost& host;
  };

  // device.cpp
  void switch_on(State& s, std::int64_t now) const;
  void pass_step_zero(State& s, DeviceHost& host);
  void store_scan(State& s, std::int64_t time, DeviceHost& host) const;
  void send_scan(State& s, DeviceHost& host);
  void send(State& s, std::int64_t now, std::uint32_t client, DeviceHost& host) const;
  void answer_pending(State& s, std::int64_t now, DeviceHost& host);
  void laser_on(State& s, std::int64_t now) const;
  void laser_off(State& s) const;
  ScanView scan_of(const State& s) const;
  static std::uint32_t timestamp(const State& s, std::int64_t time);  ///< ms
  static void write_timestamp(ReplyWriter& reply, const State& s, std::int64_t time);

  // answers.cpp; these return false when the answer must wait for a scan
  bool answer(const Call& call);
  bool answer_scip2(const Call& call, const Request& request);
  bool answer_scan(const Call& call, const Request& request);
  void start_scans(const Call& call, const Request& request);
  void reset(const Call& call, Command command);
  std::string_view change_setting(const Call& call, const Request& request);
  std::string_view adjust(const Call& call, std::uint32_t code);
  ReplyWriter begin_reply(const Call& call, std::string_view status);
  void reply(const Call& call, std::string_view status);
  void reply_state(const Call& call);
  void send(const Call& call) { send(call.state, call.now, call.client, call.host); }
  std::uint32_t first_bit_rate() const { return line_rate_ == 0 ? usual_bit_rate : line_rate_; }
  std::uint32_t bit_rate_of(const State& s) const { return s.bit_rate == 0 ? first_bit_rate() : s.bit_rate; }

  // scip1.cpp, for SCIP 1.1
  bool is_scip1(const State& s, std::string_view line) const;
  bool answer_scip1(const Call& call);
  void reply_scip1(const Call& call, char status);

  // texts.cpp
  void write_version(ReplyWriter& reply) const;
  void write_parameters(ReplyWriter& reply) const;
  void write_status(ReplyWriter& reply, const State& s, std::int64_t now) const;
  void write_version_of_scip1(ReplyWriter& reply) const;

  Model model_;
  bool is_swept_ = false;
  std::uint32_t line_rate_ = 0;
  std::string text_;  ///< the reply in progress; has room for the longest one
};

}  // namespace muro::scip2
