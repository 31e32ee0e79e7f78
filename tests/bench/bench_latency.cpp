// SPDX-License-Identifier: MIT
// Time that a value takes from a property to software outside and a command back: over TCP, a Unix socket and shared
// memory. Each is compared with two threads that pass on a byte, or a turn, in the same way without a simulator.
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>

#include "plugins/controller/common/shared_call/turn.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/peer.hpp"

namespace {

using namespace muro;
using namespace muro::bench;
using Clock = std::chrono::steady_clock;

constexpr int turns = 5000, warm_up = 500;

double us_since(Clock::time_point start) {
  return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

double quantile(std::vector<double> values, double fraction) {
  std::sort(values.begin(), values.end());
  return values[std::size_t(fraction * double(values.size() - 1))];
}

void send_at_once(int family, int s) {
  const int one = 1;
  if (family == AF_INET) setsockopt(s, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
}

/// Returns a connected socket of the given family; `port` for TCP, `path` for Unix.
int connected(int family, std::uint16_t port, const std::string& path) {
  const int s = family == AF_INET ? test::connected_to_tcp(port) : test::connected_to_unix(path);
  if (s < 0) throw SetupError("no connection to the benchmark's own server");
  send_at_once(family, s);
  return s;
}

/// Sends a line and reads the answer, `turns` times. Returns the time of each, us.
std::vector<double> round_trips(int s, const std::string& line) {
  std::vector<double> all;
  std::array<char, 4096> buffer{};
  for (int i = 0; i < warm_up + turns; ++i) {
    const auto start = Clock::now();
    if (write(s, line.data(), line.size()) < 0) break;
    char last = 0;
    while (last != '\n') {
      const ssize_t n = read(s, buffer.data(), buffer.size());
      if (n <= 0) return all;
      last = buffer[std::size_t(n - 1)];
    }
    if (i >= warm_up) all.push_back(us_since(start));
  }
  return all;
}

/// A ball that motion.point moves at 1000 Hz.
struct Ball : test::Scene {
  const RobotView& robot =
      add("ball", test::single_body(Shape::sphere(0.1), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}));
  Ball() { use("motion.point", 1000, all_robots()); }
};

/// Runs in lockstep: the client asks for the state and gives a velocity in turn; half of the turns are a step of 1 ms.
std::vector<double> through_simulation(int family) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("muro-latency-" + std::to_string(getpid()))).string();
  Ball s;
  std::uint16_t port = 0;
  s.set_log([&](LogLevel, std::string_view text) {
    if (const std::uint16_t told = test::tcp_port_in(text); told != 0) port = told;
  });
  s.use("controller.joints", 1000, s.all_robots(),
        {{"stream", std::vector<std::string>{family == AF_INET ? "tcp=0" : "unix=" + path, "lockstep=bench"}}});
  s.build();
  std::vector<double> all;
  std::atomic<bool> is_over = false;
  std::thread client([&] {
    const int c = connected(family, port, path);
    all = round_trips(c, "get\n");
    is_over = true;
    close(c);
  });
  while (!is_over) s.run_until(s.now() + 1'000'000, [&] { return is_over.load(); });
  client.join();
  return all;
}

/// Measures a thread that sends back what it gets.
std::vector<double> between_threads(int family) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("muro-latency-" + std::to_string(getpid()))).string();
  const int server = family == AF_INET ? test::bound_to_tcp() : test::bound_to_unix(path);
  if (server < 0 || listen(server, 1) != 0) throw SetupError("no socket for the baseline");
  std::thread echo([&] {
    const int c = accept(server, nullptr, nullptr);
    send_at_once(family, c);
    std::array<char, 4096> buffer{};
    for (ssize_t n = 1; n > 0;)
      if (n = read(c, buffer.data(), buffer.size()); n > 0) n = write(c, buffer.data(), std::size_t(n));
    close(c);
  });
  const int c = connected(family, test::port_of(server), path);
  std::vector<double> all = round_trips(c, "get\n");
  close(c);
  echo.join();
  close(server);
  unlink(path.c_str());
  return all;
}

/// Measures two threads that pass on a turn in memory, and poll for it before they sleep.
std::vector<double> turns_between_threads() {
  Turn turn;
  std::atomic<bool> is_over = false;
  constexpr std::chrono::microseconds spin(50);
  std::thread other([&] {
    Patience patience(spin);
    while (!is_over) {
      while (!turn.wait_for(Turn::Side::callee, patience, std::chrono::milliseconds(100)))
        if (is_over) return;
      turn.pass_to(Turn::Side::caller);
    }
  });
  Patience patience(spin);
  std::vector<double> all;
  for (int i = 0; i < warm_up + turns; ++i) {
    const auto start = Clock::now();
    turn.pass_to(Turn::Side::callee);
    while (!turn.wait_for(Turn::Side::caller, patience, std::chrono::seconds(1))) continue;
    if (i >= warm_up) all.push_back(us_since(start));
  }
  is_over = true;
  other.join();
  return all;
}

/// Measures instants of 1 ms in which control code reads a pose and writes a velocity, in its own process or in this.
std::vector<double> library_calls(const std::string& isolate) {
  Ball s;
  s.set_log([](LogLevel, std::string_view) {});
  s.use("controller.library", 1000, s.all_robots(),
        {{"library", std::string(MURO_BENCH_CONTROLLER)}, {"isolate", isolate}});
  s.build();
  std::vector<double> all;
  for (int i = 0; i < warm_up + turns; ++i) {
    const auto start = Clock::now();
    s.run_until(s.now() + 1'000'000);
    if (i >= warm_up) all.push_back(us_since(start));
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  Report report("latency", "From a property to software outside and back", argc, argv);
  report.table("Round trips, us",
               {"means", "median", "99th percentile", "two threads: median", "two threads: 99th percentile"});
  const auto compare = [&](const char* means, const std::vector<double>& with, const std::vector<double>& without) {
    report.row({means, fixed(quantile(with, 0.5), 1), fixed(quantile(with, 0.99), 1), fixed(quantile(without, 0.5), 1),
                fixed(quantile(without, 0.99), 1)});
    return std::pair(quantile(with, 0.5), quantile(without, 0.5));
  };
  const auto tcp = compare("TCP, controller.joints", through_simulation(AF_INET), between_threads(AF_INET));
  const auto unix_socket =
      compare("Unix socket, controller.joints", through_simulation(AF_UNIX), between_threads(AF_UNIX));
  const std::vector<double> apart = library_calls("process"), here = library_calls("none");
  const auto shared = compare("shared memory, controller.library", apart, turns_between_threads());
  report.row({"the same in one process", fixed(quantile(here, 0.5), 1), fixed(quantile(here, 0.99), 1), "", ""});
  report.ratio("TCP, to two threads with a socket", tcp.first / tcp.second);
  report.ratio("Unix socket, to two threads with one", unix_socket.first / unix_socket.second);
  report.ratio("shared memory, median of a call in us", shared.first - quantile(here, 0.5), "at most 20");
  report.note(
      "A round trip over a socket is a line that asks for the state and its answer, in lockstep; one in shared "
      "memory is a call of control code, less what the same instant costs within one process.");
  report.finish();
  return 0;
}
