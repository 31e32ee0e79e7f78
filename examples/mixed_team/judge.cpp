// SPDX-License-Identifier: MIT
// The referee, the only one that knows true poses. It compares the reports at the base station with the true places of
// targets and robots. The team reads nothing of what it writes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "../common/place.hpp"
#include "muro_controller.hpp"

namespace {

using namespace muro::controller;
using examples::Point;

enum Input { targets, robots, told };
enum Output { found, confirmed, wrong, error, time_found, time_confirmed };
enum Tunable { near_by, reach };
constexpr std::size_t most = 64;  // targets

class Judge {
 public:
  static constexpr const char* name = "judge";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Compares what a team tells of targets with where they are";
  static constexpr muro_port inputs[] = {
      {"target.poses", "m", 0, 0}, {"robot.poses", "m", 0, 0}, {"mission.targets", "m, m, 1, 1", 0, 0}};
  static constexpr muro_port outputs[] = {
      {"score.found", "1", 1, MURO_PORT_OWN},      {"score.confirmed", "1", 1, MURO_PORT_OWN},
      {"score.wrong", "1", 1, MURO_PORT_OWN},      {"score.error", "m", 2, MURO_PORT_OWN},
      {"score.time_found", "s", 1, MURO_PORT_OWN}, {"score.time_confirmed", "s", 1, MURO_PORT_OWN}};
  static constexpr muro_tunable tunables[] = {
      {"near_by", "m", 0.4, 0.01, 100, "a target is found that is told so near to where it is"},
      {"reach", "m", 0.9, 0.01, 100, "it is confirmed if a robot has really been so near to it"}};

  explicit Judge(const Setup& setup) {
    if (setup.input_size(targets) == 0 || setup.input_size(targets) % 7 != 0 || setup.input_size(robots) % 7 != 0)
      throw std::invalid_argument("target.poses and robot.poses are to be poses");
    if (setup.input_size(targets) > 7 * most) throw std::invalid_argument("there are more targets than 64");
  }

  void step(const Step& now) {
    const Tally tally = count(now);
    const std::size_t number = now.input(targets).size() / 7;
    const auto all = double(number);
    if (tally.found == all && memory_.all_found == 0) memory_.all_found = now.time();
    if (tally.confirmed == all && memory_.all_confirmed == 0) {
      memory_.all_confirmed = now.time();
      now.log().info("all targets are confirmed");
    }
    now.output(found)[0] = tally.found, now.output(confirmed)[0] = tally.confirmed, now.output(wrong)[0] = tally.wrong;
    now.output(error)[0] = tally.found > 0 ? tally.sum / tally.found : 0, now.output(error)[1] = tally.worst;
    now.output(time_found)[0] = memory_.all_found, now.output(time_confirmed)[0] = memory_.all_confirmed;
  }

 private:
  struct Tally {
    double found = 0, confirmed = 0, wrong = 0;
    double sum = 0, worst = 0;  // m: errors of the reported places
  };
  /// Report of the base station on the target nearest to a point.
  struct Claim {
    double off = 1e9;  // m
    bool is_confirmed = false;
  };

  Tally count(const Step& now) {
    const auto poses = now.input(targets), rows = now.input(told);
    Tally tally;
    for (std::size_t i = 0; i < poses.size() / 7; ++i) {
      const std::span<const double> at = poses.subspan(7 * i, 3);
      if (nearest_robot(now, at) < now.tunable(reach)) memory_.visited[i] = 1;
      const Claim claim = nearest_claim(rows, {at[0], at[1]});
      if (claim.off > now.tunable(near_by)) continue;
      ++tally.found, tally.sum += claim.off, tally.worst = std::max(tally.worst, claim.off);
      if (claim.is_confirmed && memory_.visited[i] != 0) ++tally.confirmed;
    }
    for (std::size_t k = 0; k + 4 <= rows.size(); k += 4)
      if (rows[k + 2] != 0 && nearest(poses, {rows[k], rows[k + 1]}) > now.tunable(near_by)) ++tally.wrong;
    return tally;
  }
  static Claim nearest_claim(std::span<const double> rows, const Point& p) {
    Claim best;
    for (std::size_t k = 0; k + 4 <= rows.size(); k += 4)
      if (const double off = distance(p, Point{rows[k], rows[k + 1]}); rows[k + 2] != 0 && off < best.off)
        best = {off, rows[k + 3] != 0};
    return best;
  }
  /// Returns the distance (m) in space: a robot that flies over a target has not been there.
  static double nearest_robot(const Step& now, std::span<const double> p) {
    const auto poses = now.input(robots);
    double least = 1e9;
    for (std::size_t i = 0; i + 7 <= poses.size(); i += 7)
      least =
          std::min(least, muro_hypot(distance(Point{p[0], p[1]}, Point{poses[i], poses[i + 1]}), p[2] - poses[i + 2]));
    return least;
  }
  static double nearest(std::span<const double> poses, const Point& p) {
    double least = 1e9;
    for (std::size_t i = 0; i + 7 <= poses.size(); i += 7)
      least = std::min(least, distance(p, Point{poses[i], poses[i + 1]}));
    return least;
  }

  struct Memory {
    std::array<std::int64_t, most> visited{};  // 1: a robot has been there
    double all_found = 0, all_confirmed = 0;   // s: when; 0: not yet
  };

 public:
  static constexpr std::size_t save_size = sizeof(Memory);
  void save(Saver& to) const { to.put(memory_); }
  void load(Loader& from) { memory_ = from.get<Memory>(); }

 private:
  Memory memory_;
};

}  // namespace

MURO_CONTROLLER(Judge)
