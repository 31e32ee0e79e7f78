// SPDX-License-Identifier: MIT
#include "tests/conformance/known_answers/answer.hpp"

namespace muro::known_answers {

std::vector<Answer> all_answers() {
  std::vector<Answer> all;
  for (const auto& some : {noise_answers(), servo_answers(), radio_answers()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

std::vector<PeerBug> peer_bugs() {
  return {
      {"Gazebo (gz-sensors 7)", "no scale factor, saturation, bandwidth and delay of a reading",
       "readings saturate exactly at full scale"},
      {"Gazebo (gz-sensors 415)", "no bias that is drawn at turn-on",
       "turn-on biases are normal numbers, of kurtosis 3"},
      {"Gazebo (gz-sensors 360, 616)", "whether the dynamic bias is given by its deviation or by what drives it",
       "a Gauss-Markov bias by its driving density K deviates by K sqrt(T/2)"},
      {"hector_gazebo", "the drift of a GPS depends on the rate: deviation by sqrt(dt)",
       "a Gauss-Markov bias has the correlation exp(-lag/T) at 10 Hz"},
      {"PX4 (SITL for Gazebo)", "the drift of a GPS decays by 1/60 at each reading, whatever the rate",
       "a Gauss-Markov bias has the correlation exp(-lag/T) at 1 Hz"},
      {"Pegasus (PR 148)", "biases from uniform numbers", "turn-on biases are normal numbers, of kurtosis 3"},
      {"Pegasus (PR 148)", "the bias of the accelerometer is never added", "a bias is added to the reading"},
      {"Gazebo (sdformat 130)", "a force-torque sensor reads at the joint, wherever it is mounted",
       "a shifted and turned device reads r x F more, in its axes"},
      {"Gazebo (gazebo-yarp-plugins 73)", "the frame of a force-torque sensor cannot be chosen",
       "a shifted and turned device reads r x F more, in its axes"},
      {"Gazebo (gazebo-yarp-plugins 480)", "a force-torque sensor on a fixed joint vanishes with the joint",
       "a foot on a fixed joint carries what stands on it"},
      {"Isaac Sim (735)", "no acceleration to the side while turning and driving",
       "driving forward while turning left it is pushed to the left"},
      {"Isaac Lab (7163)", "acceleration is too large by the rate of the motion by that of the sensor",
       "a sensor four times slower than the motion feels the same"},
      {"Isaac Lab (4305)", "the first sample after a reset is wrong",
       "after a reset all readings are those of the first run"},
      {"Webots (manual), ARGoS (32)", "messages pass walls", "a wall stops messages, the own body does not"},
      {"Gazebo classic (2842)", "a link is lost at 10 m, and nothing says why", "wifi with n 3 reaches 221.19 m"},
      {"gz-sim (RFComms)", "packet errors without the 0.5 of the formula, and by bytes in place of bits",
       "QPSK at 6, 8 and 10 dB loses 0.852, 0.1416 and 0.0031 of 100 bytes"},
  };
}

}  // namespace muro::known_answers
