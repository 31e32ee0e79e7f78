// SPDX-License-Identifier: MIT
// What happens to a signal on its way, and to the bits of a message.
#pragma once

#include <cstdint>
#include <string_view>

namespace muro::log_distance {

inline constexpr double speed_of_light = 299792458;  // m/s

/// mW of dBm, and the factor of a level in dB.
double from_decibels(double level);
double to_decibels(double factor);

/// dB, between isotropic antennas in free space: 20 log10(4 pi d f / c) (Friis: A note on a simple transmission
/// formula, 1946). `distance`: m, `frequency`: Hz, `speed`: m/s, all > 0.
double free_space_loss(double distance, double frequency, double speed = speed_of_light);

/// The mean loss over a distance: L0 + 10 n log10(d / d0) (Rappaport: Wireless Communications, section 4.9).
struct PathLoss {
  double reference_loss = 40;     ///< dB, L0
  double reference_distance = 1;  ///< m, d0
  double exponent = 2;            ///< n

  /// dB; that of d0 for what is nearer than d0.
  double at(double distance) const;
  /// m: where the loss is so many dB.
  double distance_of(double loss) const;
};

enum class Modulation : std::uint8_t {
  none,   ///< no bit is wrong
  psk,    ///< coherent BPSK or QPSK
  oqpsk,  ///< of IEEE 802.15.4 at 2.4 GHz: 16-ary orthogonal chips
};

/// Probability that a bit is wrong. `snr`: signal to noise, in the bandwidth of the noise, a factor;
/// `bandwidth_per_bit`: that bandwidth in units of the bit rate, so that Eb/N0 = snr bandwidth_per_bit. psk: 0.5
/// erfc(sqrt(Eb/N0)) (Proakis: Digital Communications, section 5.2). oqpsk: IEEE 802.15.4-2006, annex E.4.1.8: 8/15
/// 1/16 sum for k = 2 .. 16 of (-1)^k binomial(16, k) exp(20 snr (1/k - 1)).
double bit_error(Modulation modulation, double snr, double bandwidth_per_bit);

/// Probability that all of so many bits are right: (1 - bit_error)^bits.
double all_right(double bit_error, double bits);

}  // namespace muro::log_distance
