// SPDX-License-Identifier: MIT
// Reads <sensor> of links and joints and <plugin> of models and removes them before libsdformat reads the file.
#include "assembly.hpp"
#include "checks.hpp"
#include "plugins/reader/common/sdf_devices/plugin.hpp"
#include "plugins/reader/common/sdf_devices/sensor.hpp"

namespace muro::sdf {

namespace {

/// Returns the robot's name of a joint of a model; nothing if the joint does not move.
std::optional<std::string> moving_joint(Element& model, const std::string& name) {
  for (const Element* joint : model_file::children(model, "joint"))
    if (attribute(*joint, "name") == name && attribute(*joint, "type") != "fixed") return plain_name(name);
  return std::nullopt;
}

}  // namespace

void Check::take_device(Element& e) {
  Element& owner = *e.Parent()->ToElement();
  const std::string name = e.Name();
  sdf_devices::Messages messages{problems_, left_out_, source_.display_name};
  const auto keep = [&](const sdf_devices::Device& device) {
    if (!device.subsystems.empty()) sources_.devices[location_of(owner)].push_back(device);
  };
  if (name == "sensor") {
    if (e.Attribute("type", "contact") && !owner.FirstChildElement("collision"))
      left_out_.add(Severity::warning, "<sensor type=`contact`>", "its link has no shape that something could touch",
                    location_of(e));
    else
      keep(read_sensor(e, attribute(owner, "name"), messages));
  } else if (name == "plugin" && std::string_view(owner.Parent()->Value()) == "model") {
    left_out_.add(Severity::warning, "<plugin> of a model within a model", "only the outer model has a drive",
                  location_of(e));
  } else if (name == "plugin") {
    sdf_devices::PartNames names{.joint = [&](const std::string& joint) { return moving_joint(owner, joint); }};
    keep(read_plugin(e, names, messages));
  } else {
    sdf_devices::Fields fields(owner, concat("<", owner.Name(), "> ", quote(attribute(owner, "name"))), messages);
    const std::optional<bool> flag = fields.flag(name.c_str());
    if (flag && name == "gravity" && !*flag) sources_.weightless.insert(location_of(owner));
    if (flag && name == "self_collide" && *flag) sources_.self_colliding.insert(location_of(owner));
  }
  owner.DeleteChild(&e);
}

}  // namespace muro::sdf
