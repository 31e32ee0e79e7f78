// SPDX-License-Identifier: MIT
#pragma once

#include "muro/algorithm.hpp"
#include "muro/toolkit/mounting.hpp"
#include "radio.hpp"

namespace muro::log_distance {

inline constexpr std::string_view shadowings[] = {"message", "link"};
inline constexpr std::string_view obstacle_rules[] = {"ignore", "block", "loss"};
inline constexpr std::string_view modulations[] = {"none", "bpsk", "qpsk", "802.15.4"};
inline constexpr std::string_view media[] = {"separate", "shared"};

inline constexpr Parameter parameters[] = {
    text("world", "", "name of the channel: radios of one name hear each other, whatever robots they are on"),
    real("tx_power", "dBm", 0, "transmitted power, antennas included").between(-200, 200),
    real("sensitivity", "dBm", -85, "weaker signals are not received").between(-300, 200),
    real("noise_floor", "dBm", -100, "power of the noise at the receiver").between(-300, 200),
    real("bit_rate", "bit/s", 250e3, "bits on the air").between(1e-3, 1e15),
    real("overhead", "1", 6, "bytes of a frame beside those of the message").between(0, 65535),
    real("frequency", "Hz", 2.44e9, "of the carrier: gives the loss at the reference distance, as in free space")
        .between(1, 1e15),
    real("reference_loss", "dB", 0, "loss at the reference distance; not given: that of free space").between(-100, 400),
    real("reference_distance", "m", 1, "where the loss is the reference loss; it is not less where it is nearer")
        .between(1e-6, 1e6),
    real("exponent", "1", 3, "path loss exponent: 2 in free space").between(0.1, 20),
    real("shadowing_sigma", "dB", 0, "standard deviation of the normal shadowing").between(0, 100),
    text("shadowing", "message", "drawn for each message and receiver, or once for each link").one_of(shadowings),
    text("obstacles", "loss", "what scenery and other robots on the line of sight do: nothing, all, or a loss each")
        .one_of(obstacle_rules),
    real("obstacle_loss", "dB", 6.9, "of each obstacle on the line of sight, with `obstacles: loss`").between(0, 1000),
    real("max_range", "m", 1e6, "nothing is received from farther away").between(1e-6, 1e12),
    real("propagation_speed", "m/s", speed_of_light, "of the signal").between(1e-3, 1e10),
    text("modulation", "none", "which bit errors noise causes").one_of(modulations),
    real("noise_bandwidth", "Hz", 0, "of noise_floor, for Eb/N0 with bpsk and qpsk; 0: as the bit rate")
        .between(0, 1e15),
    text("medium", "separate", "each sender has a medium of its own, or all share one (CSMA-CA)").one_of(media),
    real("capture", "dB", 10, "shared, modulation none: what a signal must be above noise and those it overlaps with")
        .between(-100, 100),
    real("carrier_sense", "dBm", -85, "shared: from this power on the medium is busy").between(-300, 200),
    real("turnaround", "s", 192e-6, "shared: between listening and sending").between(0, 1e3),
    real("backoff_slot", "s", 320e-6, "shared: unit of the random back-off").between(0, 1e3),
    integer("min_exponent", 3, "shared: BE of the first back-off, 0 to 2^BE - 1 slots").between(0, 20),
    integer("max_exponent", 5, "shared: BE at most").between(0, 20),
    integer("max_backoffs", 4, "shared: back-offs after which a message is lost").between(0, 1e6),
    integer("queue", 16, "messages that may wait for their transmission; more are lost").between(1, 1e6),
    real("keep", "s", 0, "how long received messages are listed; 0: until the next step of the radio").between(0, 1e6),
    mounting_offset,
    mounting_rpy,
};

/// Throws muro::Error when parameters contradict each other. [setup]
RadioParameters radio_parameters(const Parameters& p);
Channel channel_parameters(const Parameters& p);

/// Throws muro::Error when a parameter of the channel differs from that of robot `first`: all robots of a world share
/// the channel. [setup]
void check_same_channel(const Parameters& p, const Parameters& of_the_first, std::string_view first);

/// Returns a text for each given parameter that has no effect, with the reason. [setup]
std::vector<std::string> without_effect(const Parameters& p);

}  // namespace muro::log_distance
