// SPDX-License-Identifier: MIT
// One radio, and the channel that all radios of one world share.
#pragma once

#include <cstring>
#include <optional>
#include <vector>

#include "channel.hpp"
#include "frame.hpp"
#include "muro/base/random.hpp"
#include "muro/handles.hpp"
#include "muro/step.hpp"
#include "plugins/common/line_of_sight/line_of_sight.hpp"

namespace muro::log_distance {

/// dB below the noise: weaker transmissions do not disturb others.
inline constexpr double below_noise = 3;

/// Parameters of one radio.
struct RadioParameters {
  double tx_power = 0;       ///< dBm
  double sensitivity = 0;    ///< dBm: weaker signals are not received
  double noise_floor = 0;    ///< dBm
  double bit_rate = 0;       ///< bit/s
  double overhead = 0;       ///< bytes of a frame beside the message
  std::size_t queue = 0;     ///< frames that may wait
  double keep = 0;           ///< s: how long a message stays in the list of received messages
  double carrier_sense = 0;  ///< dBm: from this power on the medium is busy
  double turnaround = 0;     ///< s: from listening to sending
  double backoff_slot = 0;   ///< s
  std::uint32_t min_exponent = 0, max_exponent = 0, max_backoffs = 0;

  double airtime(std::uint32_t size) const { return bits(size) / bit_rate; }
  double bits(std::uint32_t size) const { return 8 * (size + overhead); }
};

struct Radio {
  In<Pose> pose;
  In<Payload> send_bytes;
  In<std::uint32_t> send_size;
  In<std::int64_t> send_receiver, send_number;
  ListOut<Frame> frames;
  ListOut<Arrival> arriving;
  Out<Access> access;
  ListOut<radio::Header> received;
  ListOut<std::uint8_t> received_bytes;
  Out<radio::Header> last;
  Out<Payload> last_bytes;
  Out<radio::Counters> counters;
  RadioParameters parameters;
  Pose mounting;
  RobotId robot = no_robot;
  std::uint64_t key = 0;  ///< of the name of the robot
};

enum class Shadowing : std::uint8_t { message, link };
enum class Obstacles : std::uint8_t { ignore, block, loss };

/// Parameters that all radios of a world share.
struct Channel {
  PathLoss path_loss;
  double shadowing_sigma = 0;  ///< dB
  Shadowing shadowing = Shadowing::message;
  Obstacles obstacles = Obstacles::ignore;
  double obstacle_loss = 0;    ///< dB, each
  double max_range = 0;        ///< m
  double speed = 0;            ///< m/s, propagation speed of the signal
  double noise_bandwidth = 0;  ///< Hz; 0: the bit rate
  Modulation modulation = Modulation::none;
  double capture = 0;  ///< dB: without a modulation, least ratio of a signal to noise and overlapping signals
  bool is_shared = false;
  std::uint64_t key = 0;  ///< hash of the name of the world
  const line_of_sight::LineOfSight* sight = nullptr;

  /// Returns the random numbers of one message from `a` to `b`. Number -1: of the link, equal in both directions.
  Random random(std::uint64_t seed, const Radio& a, const Radio& b, std::int64_t number) const {
    const bool swapped = number < 0 && a.key > b.key;
    const std::uint64_t keys[] = {key, swapped ? b.key : a.key, swapped ? a.key : b.key};
    return {seed, fnv1a({reinterpret_cast<const char*>(keys), sizeof keys}), std::uint64_t(number)};
  }
  /// Returns the power in dBm that `b` at `to` (m, world) receives of frame `number` of `a` at `from`; nothing below
  /// `least` or out of range. obstacles_between(most) counts obstacles on the line, up to `most`.
  template <class CountObstacles>
  std::optional<double> received_power(std::uint64_t seed, const Radio& a, const Vec3& from, const Radio& b,
                                       const Vec3& to, std::int64_t number, double least,
                                       CountObstacles obstacles_between) const {
    const std::optional<double> power = unobstructed_power(seed, a, from, b, to, number);
    if (!power || *power < least) return std::nullopt;
    const std::uint32_t most = deciding_obstacles(*power - least);
    return most == 0 ? power : behind(obstacles_between(most), *power, least);
  }

 private:
  std::optional<double> unobstructed_power(std::uint64_t seed, const Radio& a, const Vec3& from, const Radio& b,
                                           const Vec3& to, std::int64_t number) const;
  /// Returns the number of obstacles that cut a link with this margin (dB); 0: obstacles do not matter.
  std::uint32_t deciding_obstacles(double margin) const;
  std::optional<double> behind(std::uint32_t count, double power, double least) const;
};

}  // namespace muro::log_distance
