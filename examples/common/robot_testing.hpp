// SPDX-License-Identifier: MIT
// Observations of robots from outside, for tests: values that control code writes, forces on links; and a hand that
// pushes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/simulation.hpp"
#include "muro/vocabulary.hpp"

namespace muro::example_test {

/// Returns values that control code writes.
inline std::vector<double> values_of(const World& world, ObjectId object, const std::string& name,
                                     const std::string& unit = "1") {
  const auto values = world.values(object, Key<double>{name, unit, ""});
  return {values.begin(), values.end()};
}

/// Wrench of the contacts of a link.
struct LinkContact {
  std::string link;
  const Wrench* wrench;

  bool is_foot() const { return link.find("foot") != link.npos; }
};

/// Returns the links of a robot that may touch something.
inline std::vector<LinkContact> contacts_of(const World& world, const RobotView& robot) {
  std::vector<LinkContact> all;
  for (const Link& link : robot.links)
    if (const Slot* const slot = world.store().find(link.object, keys::contact_wrench.name))
      all.push_back({std::string(world.object_name(link.object)), static_cast<const Wrench*>(slot->place)});
  return all;
}

/// Returns a wrench on the base of a robot that the test sets. To be called while the simulation is built.
inline Wrench* add_push(World& world, const RobotView& robot) {
  PropertyStore& store = world.store();
  return static_cast<Wrench*>(store.bind(store.add_accessor("the test"), robot.base(), keys::external_wrench,
                                         usage::accumulate, Multiplicity::single, 1, nullptr));
}

}  // namespace muro::example_test
