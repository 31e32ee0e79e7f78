// SPDX-License-Identifier: MIT
// Readings for programs outside of the simulation; see README.md.
#include <memory>
#include <optional>

#include "muro/plugin.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/wire_protocol/group_text.hpp"
#include "plugins/controller/common/wire_protocol/wire_controller.hpp"
#include "reading_finder.hpp"
#include "reading_group.hpp"

namespace {

using namespace muro;
using namespace muro::sensors;

constexpr auto parameters = wire::wire_parameters(
    "\"scan=laser:ranges\", \"body=base_link:pose,base_link:twist\": what is read together; names with * and ?",
    "sensors");
constexpr PropertyUse reads[] = {{"*", "what `groups` names"}};
constexpr Description description{
    .id = "controller.sensors",
    .kind = Kind::controller,
    .version = "1.0.0",
    .summary = "Readings and any other numbers of the simulation for programs outside, by lines or frames of bytes",
    .parameters = parameters,
    .reads = reads,
    .capabilities = deterministic | batched | restorable | runs_alone,
};

class SensorsController final : public wire::WireController {
 public:
  SensorsController() : WireController("sensors 1") {}

  void connect(Connector& c) override {
    groups_ = wire::read_groups(c.parameters().texts("groups"));
    if (groups_.empty())
      throw Error("`groups` must say what clients read, such as [\"scan=laser:ranges\"]; `muro describe` lists all");
    WireController::connect(c);
  }

 private:
  std::vector<std::unique_ptr<wire::Group>> groups_of(Connector& c, std::uint32_t item) override {
    if (!objects_) objects_.emplace(c);
    const ReadingFinder finder(c, c.items()[item], *objects_);
    std::vector<std::unique_ptr<wire::Group>> groups;
    for (const wire::GroupText& text : groups_) {
      std::vector<Reading> readings;
      for (const std::string& member : text.members) {
        try {
          for (const auto& [name, property] : finder.find(member)) readings.emplace_back(c, property, name);
        } catch (const Error& e) {
          throw Error("`groups`: group " + quote(text.name) + ": " + e.what());
        }
      }
      groups.push_back(std::make_unique<ReadingGroup>(text.name, std::move(readings)));
    }
    return groups;
  }

  std::vector<wire::GroupText> groups_;
  std::optional<RobotObjects> objects_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<SensorsController>(description)};

}  // namespace

MURO_PLUGIN(.name = "controller_sensors", .version = description.version, .licence = "MIT",
            .summary = "Readings for programs outside", .algorithms = algorithms)
