// SPDX-License-Identifier: MIT
#include "channel.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace muro::log_distance {
namespace {

TEST(RadioChannel, LosesInFreeSpaceWhatFriisSays) {
  EXPECT_NEAR(free_space_loss(1, 2.4e9), 40.05, 0.005);
  EXPECT_NEAR(free_space_loss(1, 5.15e9), 46.68, 0.005);
  EXPECT_NEAR(free_space_loss(10, 2.4e9) - free_space_loss(1, 2.4e9), 20, 1e-12);
}

TEST(RadioChannel, ReachesAsFarAsOtherSimulatorsAndDataSheetsSay) {
  const PathLoss wifi{46.6777, 1, 3};  // ns-3: 16.0206 dBm, sensitivity -101 dBm
  EXPECT_NEAR(wifi.distance_of(16.0206 + 101), 221.19, 0.01);
  const PathLoss gazebo{40, 1, 2.5};  // gz-sim: 27 dBm, noise -90 dBm
  EXPECT_NEAR(27 - gazebo.at(50), -55.5, 0.03);
  EXPECT_NEAR(gazebo.distance_of(27 + 90), 1202, 1);
  const PathLoss zigbee{free_space_loss(1, 2.44e9), 1, 3};  // 0 dBm, sensitivity -85 dBm
  EXPECT_NEAR(zigbee.distance_of(85), 31.2, 0.05);
  EXPECT_NEAR(zigbee.at(zigbee.distance_of(85)), 85, 1e-9);
  EXPECT_EQ(zigbee.at(0.01), zigbee.at(1)) << "no less than at the reference distance";
}

TEST(RadioChannel, LosesPacketsByPhaseShiftKeyingAsInTextbooks) {
  const auto lost = [](double decibels) {
    return 1 - all_right(bit_error(Modulation::psk, from_decibels(decibels), 1), 800);
  };
  EXPECT_NEAR(lost(6), 0.852, 0.0005);
  EXPECT_NEAR(lost(8), 0.1416, 0.00005);
  EXPECT_NEAR(lost(10), 0.0031, 0.00005);
  EXPECT_NEAR(bit_error(Modulation::psk, 0.5, 8), 0.5 * std::erfc(2), 1e-15) << "Eb/N0 = 4";
}

TEST(RadioChannel, LosesBitsOfOffsetKeyingAsItsStandardSays) {
  EXPECT_NEAR(bit_error(Modulation::oqpsk, 0, 1), 0.5, 1e-12) << "nothing but noise";
  for (const double snr : {0.2, 0.5, 1.0, 2.0}) {
    double sum = 0;
    for (int k = 2; k <= 16; ++k)
      sum += std::pow(-1, k) * std::round(std::tgamma(17) / std::tgamma(k + 1) / std::tgamma(17 - k)) *
             std::exp(20 * snr * (1.0 / k - 1));
    EXPECT_NEAR(bit_error(Modulation::oqpsk, snr, 1), sum / 30, 1e-9 * sum) << snr;
  }
  EXPECT_LT(bit_error(Modulation::oqpsk, 2, 1), 1e-7);
}

TEST(RadioChannel, TurnsDecibelsIntoFactorsAndBack) {
  EXPECT_NEAR(from_decibels(3), 1.9953, 1e-4);
  EXPECT_NEAR(to_decibels(from_decibels(-87.5)), -87.5, 1e-12);
}

}  // namespace
}  // namespace muro::log_distance
