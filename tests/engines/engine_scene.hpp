// SPDX-License-Identifier: MIT
// Scenes of the motions by forces, each alone.
#pragma once

#include <gtest/gtest.h>

#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"

namespace muro::engines {

using Parameters = std::map<std::string, ParameterInput>;

/// Returns the motions of the build in which contacts push robots, by id.
inline std::vector<std::string> all_motions() {
  std::vector<std::string> ids;
  for (const CatalogEntry& o : test::plugins().catalog())
    if (o.kind == "motion" && o.features && (*o.features & feature_contact) != 0) ids.push_back(o.id);
  return ids;
}
/// Returns the same motions, but only those of physics engines.
inline std::vector<std::string> engine_motions() {
  std::vector<std::string> ids = all_motions();
  std::erase(ids, "motion.simplified");
  return ids;
}
inline std::string name_of(const ::testing::TestParamInfo<std::string>& info) {
  return info.param.substr(info.param.find('.') + 1);
}

struct World : test::Scene {
  std::string log;  ///< all messages

  World() {
    set_log([this](LogLevel, std::string_view text) { log += std::string(text) + "\n"; });
  }
  /// Moves all robots so far by `motion`. Leaves out parameters that the motion does not have. `of_contact`: parameters
  /// of contact.penalty.
  void start(const std::string& motion, Parameters parameters = {}, double rate = 1000, Parameters of_contact = {}) {
    const Description& d = *test::plugins().algorithm(motion).description;
    std::erase_if(parameters, [&](const auto& p) {
      return std::none_of(d.parameters.begin(), d.parameters.end(), [&](auto& k) { return k.name == p.first; });
    });
    use(motion, rate, all_robots(), std::move(parameters));
    use_contacts(std::move(of_contact));
    build();
  }
  void add_box(const char* name, const Vec3& centre, const Vec3& size, double friction = 0) {
    const Shape box = test::with(Shape::box(size), friction);
    world().add_scenery(name, {centre, Quat::Identity()}, std::span<const Shape>(&box, 1));
  }
  /// Runs for `seconds` and returns the error that ends the run.
  std::string failure_in(double seconds) {
    return test::complaint_of<StepError>([&] { run_for(seconds); });
  }
};

}  // namespace muro::engines
