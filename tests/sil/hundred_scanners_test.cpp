// SPDX-License-Identifier: MIT
// 100 scanners at 10 Hz over TCP at once, in real time, for a client that has a socket for each.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "tests/support/files.hpp"
#include "tests/support/peer.hpp"

namespace muro {
namespace {

constexpr int scanners = 100, first_port = 21300;

/// Data from one scanner.
struct Stream {
  int socket = -1;
  std::string last;  ///< beginning of a line
  int scans = 0;     ///< number of scans that have begun: lines "99b", the status of a scan
  std::size_t bytes = 0;
};

void take(Stream& s) {
  char buffer[65536];
  const ssize_t n = recv(s.socket, buffer, sizeof buffer, MSG_DONTWAIT);
  if (n <= 0) return;
  s.bytes += std::size_t(n);
  for (ssize_t i = 0; i < n; ++i) {
    if (buffer[i] != '\n') {
      if (s.last.size() < 8) s.last += buffer[i];
      continue;
    }
    if (s.last == "99b") ++s.scans;
    s.last.clear();
  }
}

TEST(SlowHundredScanners, AreServedAt10HzInRealTime) {
  const test::ScratchFolder scratch;
  const std::string report = scratch.path("report.json");
  const std::string scenario = scratch.file(
      "hundred.yaml",
      "name: hundred\nduration: 9\nworld: {include: " MURO_TEST_SOURCE_DIR
      "/examples/urban/city.yaml}\nrobots:\n  rovers:\n    model: " MURO_TEST_SOURCE_DIR
      "/examples/models/rover.urdf\n    count: 100\n    place: {random: streets, seed: 1}\n    motion: {use: "
      "motion.differential_drive, rate: 100}\n    drive: {use: drive.skid_steer}\n    laser: {use: laser.raycast, on: "
      "laser_link, rate: 10, min_angle: -2.0862, max_angle: 2.0924, rays: 682, max_range: 5.6}\n    scanner: {use: "
      "controller.scip2, on: laser, rate: 100, stream: {tcp: \"" +
          std::to_string(first_port) + "+{index}\"}}\n");
  test::CommandResult run;
  std::thread simulator([&] {
    run = test::run_command("MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " " MURO_PROGRAM " run " + scenario +
                            " --speed real --report " + report);
  });
  std::vector<test::Peer> clients;
  for (int i = 0; i < scanners; ++i) clients.push_back(test::Peer::tcp_once_served(std::uint16_t(first_port + i)));
  std::vector<Stream> streams;
  for (const test::Peer& client : clients) {
    EXPECT_TRUE(client.say("MD0044072501000\n"));
    streams.push_back({.socket = client.fd, .last = {}});
  }
  std::vector<pollfd> files;
  for (const Stream& s : streams) files.push_back({s.socket, POLLIN, 0});
  const auto receive_for = [&](double seconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < end) {
      poll(files.data(), files.size(), 20);
      for (std::size_t i = 0; i < files.size(); ++i)
        if (files[i].revents != 0) take(streams[i]);
    }
  };
  receive_for(2);
  std::vector<Stream> before = streams;
  receive_for(4);
  for (int i = 0; i < scanners; ++i) {
    const Stream &a = before[std::size_t(i)], &b = streams[std::size_t(i)];
    EXPECT_NEAR(b.scans - a.scans, 40, 2) << "scanner " << i;
    EXPECT_GT(b.bytes - a.bytes, std::size_t(38 * 2000)) << "scanner " << i;
  }
  clients.clear();
  simulator.join();
  EXPECT_EQ(run.exit_code, 0) << run.output;
  const auto about = nlohmann::json::parse(test::text_of(report), nullptr, false);
  EXPECT_NEAR(about.value("real_time_factor", 0.0), 1, 0.05) << run.output;
}

}  // namespace
}  // namespace muro
