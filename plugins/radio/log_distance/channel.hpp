// SPDX-License-Identifier: MIT
// Loss of a signal on its way, and errors in the bits of a message.
#pragma once

#include <cstdint>
#include <string_view>

namespace muro::log_distance {

inline constexpr double speed_of_light = 299792458;  // m/s

/// Converts dBm to mW, or a level in dB to a factor.
double from_decibels(double level);
double to_decibels(double factor);

/// Returns the loss in dB between isotropic antennas in free space: 20 log10(4 pi d f / c) (Friis: A note on a simple
/// transmission formula, 1946). `distance`: m, `frequency`: Hz, `speed`: m/s, all > 0.
double free_space_loss(double distance, double frequency, double speed = speed_of_light);

/// Mean loss over a distance: L0 + 10 n log10(d / d0) (Rappaport: Wireless Communications, section 4.9).
struct PathLoss {
  double reference_loss = 40;     ///< dB, L0
  double reference_distance = 1;  ///< m, d0
  double exponent = 2;            ///< n

  /// Returns the loss in dB at `distance` (m). Distances below d0 have the loss of d0.
  double at(double distance) const;
  /// Returns the distance in m at which the loss is `loss` (dB).
  double distance_of(double loss) const;
};

enum class Modulation : std::uint8_t {
  none,   ///< no bit is wrong
  psk,    ///< coherent BPSK or QPSK
  oqpsk,  ///< modulation of IEEE 802.15.4 at 2.4 GHz: 16-ary orthogonal chips
};

/// Returns the probability that a bit is wrong. `snr`: signal-to-noise ratio in the bandwidth of the noise, a factor;
/// `bandwidth_per_bit`: this bandwidth divided by the bit rate, so that Eb/N0 = snr bandwidth_per_bit. psk: 0.5
/// erfc(sqrt(Eb/N0)) (Proakis: Digital Communications, section 5.2). oqpsk: IEEE 802.15.4-2006, annex E.4.1.8: 8/15
/// 1/16 sum for k = 2 .. 16 of (-1)^k binomial(16, k) exp(20 snr (1/k - 1)).
double bit_error(Modulation modulation, double snr, double bandwidth_per_bit);

/// Returns the probability that all `bits` bits are right: (1 - bit_error)^bits.
double all_right(double bit_error, double bits);

}  // namespace muro::log_distance
