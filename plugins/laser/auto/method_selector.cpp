// SPDX-License-Identifier: MIT
#include "method_selector.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "muro/algorithm.hpp"
#include "plugins/laser/common/raycast/raycast_method.hpp"
#ifdef MURO_AUTO_ZBUFFER
#include "plugins/laser/common/zbuffer/zbuffer_method.hpp"
#endif
#ifdef MURO_AUTO_EMBREE
#include "plugins/laser/common/embree/embree_method.hpp"
#endif

namespace muro::laser_auto {

namespace {

/// State of the selection: after a restore the same method is used.
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

void MethodSelector::connect(Connector& c) {
  host_ = &c.host();
  const std::string_view requested = c.parameters().text("method");
  const auto add = [&](std::string_view name, std::unique_ptr<Method> method) {
    if (requested == "auto" || requested == name) candidates_.push_back({name, std::move(method), number_of(name), 0});
  };
  add("raycast", std::make_unique<raycast::Raycast>());
#ifdef MURO_AUTO_ZBUFFER
  add("zbuffer", std::make_unique<zbuffer::ZBuffer>());
#endif
#ifdef MURO_AUTO_EMBREE
  add("embree", std::make_unique<embree::Embree>());
#endif
  if (candidates_.empty())
    throw Error("method " + std::string(requested) + " is not part of this muro; laser." + std::string(requested) +
                " was left out when it was built: the summary of its configuration says what is missing");
  const raycast::MeshCount meshes = raycast::count_meshes(c);
  if (meshes.count > 0) exclude("raycast", "does not see the meshes of " + std::string(meshes.first_object));
  for (const Candidate& candidate : candidates_) candidate.method->connect(c);
  for (const Item& item : c.items()) method_.push_back(c.variable(item.object, key_method, 0U));
}

void MethodSelector::exclude(std::string_view name, const std::string& reason) {
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

void MethodSelector::prepare(std::span<const scanner::RaySet> sets) {
  if (sets.size() > 1) exclude("zbuffer", "draws too much for sweeps, whose rays are taken one by one");
  rays_ = sets[0].size();
  exclude_failing([&](Method& m) { m.prepare(sets); });
}

/// Excludes the methods for which `work` throws; the last remaining method may throw.
void MethodSelector::exclude_failing(const std::function<void(Method&)>& work) {
  for (std::size_t i = 0; i < candidates_.size();) {
    try {
      work(*candidates_[i].method);
      ++i;
    } catch (const Error& e) {
      if (candidates_.size() == 1) throw;
      exclude(candidates_[i].name, std::string("cannot be used here: ") + e.what());
    }
  }
}

void MethodSelector::start() {
  exclude_failing([](Method& m) { m.start(); });
}

void MethodSelector::restored() {
  const std::uint32_t number = *method_.front();
  const auto matches = [&](const Candidate& c) { return c.number == number; };
  if (number != 0 && std::none_of(candidates_.begin(), candidates_.end(), matches))
    throw Error("the snapshot was taken with the method " + std::string(names[std::min<std::size_t>(number, 3)]) +
                ", which is not available here");
  for (const Candidate& c : candidates_) c.method->restored();
}

double MethodSelector::seconds_of(Method& method, const scanner::Viewpoint& example, std::size_t scanners) const {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  std::vector<double> ranges(rays_);
  method.update();
  method.cast(0, example, ranges, {});  // warm-up
  double update = 1e9, cast = 1e9, sum = 0;
  for (int i = 0; i < 20 && (i < 3 || sum < 0.02); ++i) {
    const auto start = Clock::now();
    method.update();
    const auto middle = Clock::now();
    method.cast(0, example, ranges, {});
    const auto end = Clock::now();
    update = std::min(update, seconds(middle - start));
    cast = std::min(cast, seconds(end - middle));
    sum += seconds(end - start);
  }
  return update + double(scanners) * cast;
}

void MethodSelector::begin_step(const scanner::Viewpoint& example, std::size_t scanners) {
  if (*method_.front() != 0) return;
  if (fastest_ == 0) {
    if (candidates_.size() > 1) exclude_failing([&](Method& m) { find(m).seconds = seconds_of(m, example, scanners); });
    std::string figures;
    for (const Candidate& c : candidates_) {
      figures += (figures.empty() ? "" : ", ") + std::string(c.name) + " " + microseconds(c.seconds);
    }
    const auto faster = [](const Candidate& a, const Candidate& b) { return a.seconds < b.seconds; };
    const Candidate& best = *std::min_element(candidates_.begin(), candidates_.end(), faster);
    fastest_ = best.number;
    if (candidates_.size() > 1)
      host_->log(LogLevel::info, "laser.auto: a scan by all " + std::to_string(scanners) + " scanners takes " +
                                     figures + "; takes " + std::string(best.name) + ", which `use: laser." +
                                     std::string(best.name) + "` would fix");
  }
  for (const Out<std::uint32_t>& number : method_) *number = fastest_;
}

MethodSelector::Candidate& MethodSelector::find(const Method& method) {
  const auto matches = [&](const Candidate& c) { return c.method.get() == &method; };
  return *std::find_if(candidates_.begin(), candidates_.end(), matches);
}

scanner::Method& MethodSelector::selected() const {
  const std::uint32_t number = *method_.front();
  for (const Candidate& c : candidates_)
    if (c.number == number) return *c.method;
  return *candidates_.front().method;
}

}  // namespace muro::laser_auto
