// SPDX-License-Identifier: MIT
#include "choice.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "muro/algorithm.hpp"
#include "plugins/laser/raycast/method.hpp"
#ifdef MURO_AUTO_ZBUFFER
#include "plugins/laser/zbuffer/method.hpp"
#endif
#ifdef MURO_AUTO_EMBREE
#include "plugins/laser/embree/method.hpp"
#endif

namespace muro::laser_auto {

namespace {

/// State: after a restore, the same method goes on.
constexpr Key<std::uint32_t> key_method{"laser.method", "1", "1: raycast, 2: zbuffer, 3: embree; 0: not chosen yet"};

constexpr std::string_view names[] = {"", "raycast", "zbuffer", "embree"};

std::uint32_t number_of(std::string_view name) {
  return std::uint32_t(std::find(std::begin(names), std::end(names), name) - std::begin(names));
}

std::string microseconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g us", 1e6 * seconds);
  return text;
}

}  // namespace

void Choice::connect(Connector& c) {
  host_ = &c.host();
  const std::string_view wanted = c.parameters().text("method");
  const auto add = [&](std::string_view name, std::unique_ptr<Method> method) {
    if (wanted == "auto" || wanted == name) candidates_.push_back({name, std::move(method), number_of(name), 0});
  };
  add("raycast", std::make_unique<raycast::Raycast>());
#ifdef MURO_AUTO_ZBUFFER
  add("zbuffer", std::make_unique<zbuffer::ZBuffer>());
#endif
#ifdef MURO_AUTO_EMBREE
  add("embree", std::make_unique<embree::Embree>());
#endif
  if (candidates_.empty())
    throw Error("method " + std::string(wanted) + " is not part of this muro; laser." + std::string(wanted) +
                " was left out when it was built: the summary of its configuration says what is missing");
  const raycast::Meshes meshes = raycast::meshes_of(c);
  if (meshes.count > 0) leave_out("raycast", "does not see the meshes of " + std::string(meshes.first));
  for (const Candidate& candidate : candidates_) candidate.method->connect(c);
  for (const Item& item : c.items()) number_.push_back(c.variable(item.object, key_method, 0U));
}

void Choice::leave_out(std::string_view name, const std::string& reason) {
  const auto found =
      std::find_if(candidates_.begin(), candidates_.end(), [&](const auto& c) { return c.name == name; });
  if (found == candidates_.end()) return;
  if (candidates_.size() == 1) {
    host_->log(LogLevel::warning, "laser.auto: " + std::string(name) + " " + reason);
    return;
  }
  host_->log(LogLevel::info, "laser.auto leaves " + std::string(name) + " out: it " + reason);
  candidates_.erase(found);
}

void Choice::prepare(std::span<const scanner::RaySet> sets) {
  if (sets.size() > 1) leave_out("zbuffer", "draws too much for scans that take their time ray by ray");
  rays_ = sets[0].size();
  try_all([&](Method& m) { m.prepare(sets); });
}

/// Leaves out what fails.
void Choice::try_all(const std::function<void(Method&)>& work) {
  for (std::size_t i = 0; i < candidates_.size();) {
    try {
      work(*candidates_[i].method);
      ++i;
    } catch (const Error& e) {
      if (candidates_.size() == 1) throw;
      leave_out(candidates_[i].name, std::string("cannot be used here: ") + e.what());
    }
  }
}

void Choice::start() {
  try_all([](Method& m) { m.start(); });
}

void Choice::restored() {
  const std::uint32_t number = *number_.front();
  const auto is_it = [&](const Candidate& c) { return c.number == number; };
  if (number != 0 && std::none_of(candidates_.begin(), candidates_.end(), is_it))
    throw Error("the snapshot was taken with the method " + std::string(names[std::min<std::size_t>(number, 3)]) +
                ", which is not available here");
  for (const Candidate& c : candidates_) c.method->restored();
}

double Choice::seconds_of(Method& method, const scanner::View& example, std::size_t scanners) const {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  std::vector<double> ranges(rays_);
  method.look();
  method.cast(0, example, ranges, {});  // warm
  double look = 1e9, cast = 1e9, sum = 0;
  for (int i = 0; i < 20 && (i < 3 || sum < 0.02); ++i) {
    const auto start = Clock::now();
    method.look();
    const auto middle = Clock::now();
    method.cast(0, example, ranges, {});
    const auto end = Clock::now();
    look = std::min(look, seconds(middle - start));
    cast = std::min(cast, seconds(end - middle));
    sum += seconds(end - start);
  }
  return look + double(scanners) * cast;
}

void Choice::begin(const scanner::View& example, std::size_t scanners) {
  if (*number_.front() != 0) return;
  if (measured_ == 0) {
    if (candidates_.size() > 1) try_all([&](Method& m) { find(m).seconds = seconds_of(m, example, scanners); });
    std::string figures;
    for (const Candidate& c : candidates_) {
      figures += (figures.empty() ? "" : ", ") + std::string(c.name) + " " + microseconds(c.seconds);
    }
    const auto faster = [](const Candidate& a, const Candidate& b) { return a.seconds < b.seconds; };
    const Candidate& best = *std::min_element(candidates_.begin(), candidates_.end(), faster);
    measured_ = best.number;
    if (candidates_.size() > 1)
      host_->log(LogLevel::info, "laser.auto: a scan by all " + std::to_string(scanners) + " scanners takes " +
                                     figures + "; takes " + std::string(best.name) + ", which `use: laser." +
                                     std::string(best.name) + "` would fix");
  }
  for (const Out<std::uint32_t>& number : number_) *number = measured_;
}

Choice::Candidate& Choice::find(const Method& method) {
  const auto is_it = [&](const Candidate& c) { return c.method.get() == &method; };
  return *std::find_if(candidates_.begin(), candidates_.end(), is_it);
}

scanner::Method& Choice::taken() const {
  const std::uint32_t number = *number_.front();
  for (const Candidate& c : candidates_)
    if (c.number == number) return *c.method;
  return *candidates_.front().method;
}

}  // namespace muro::laser_auto
