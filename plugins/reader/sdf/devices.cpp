// SPDX-License-Identifier: MIT
#include "devices.hpp"

#include <utility>

namespace muro::sdf {

namespace {

class Devices {
 public:
  Devices(const Assembly& assembly, const SourceFiles& sources, Problems& problems)
      : assembly_(assembly), sources_(sources), problems_(problems) {
    names_.used.insert(assembly.names.begin(), assembly.names.end());
  }

  void run(const ::sdf::Model& model) {
    for (const Body& body : assembly_.bodies)
      if (body.link) place(body.location, prefix_of(body.name, body.link->Name()), body.name);
    for (const Joint& joint : assembly_.joints)
      if (!joint.left_out)
        place(joint.location, plain_name(joint.scope), assembly_.bodies[std::size_t(joint.child)].name);
    add_drives(location_of(sources_, model.Element()));
    add_gravity_compensation();
    add_self_collision(location_of(sources_, model.Element()));
  }

  const std::vector<sdf_devices::Subsystem>& subsystems() const { return subsystems_; }

 private:
  /// Returns "arm." for arm.hand.
  static std::string prefix_of(const std::string& body, const std::string& link) {
    const std::size_t own = plain_name(link).size();
    const std::size_t dot = body.size() > own ? body.rfind('.', body.size() - own) : body.npos;
    return dot == body.npos ? std::string() : body.substr(0, dot + 1);
  }

  void place(const FileLocation& at, const std::string& prefix, const std::string& part) {
    const auto found = sources_.devices.find(at);
    if (found == sources_.devices.end()) return;
    for (sdf_devices::Device device : found->second) {
      device.place(prefix, part, names_);
      add(device);
    }
  }

  void add(const sdf_devices::Device& device) {
    device.tell(problems_);
    subsystems_.insert(subsystems_.end(), device.subsystems.begin(), device.subsystems.end());
  }

  void add_drives(const FileLocation& model) {
    const auto found = sources_.devices.find(model);
    if (found == sources_.devices.end()) return;
    bool has_drive = false;
    for (const sdf_devices::Device& device : found->second)
      if (std::exchange(has_drive, true))
        problems_.warning(device.location, device.owner + " is left out: the robot has a drive already");
      else
        add(device);
  }

  void add_gravity_compensation() {
    std::vector<std::string> links;
    FileLocation at;
    for (const Body& body : assembly_.bodies)
      if (sources_.weightless.count(body.location) > 0) {
        if (links.empty()) at = body.location;
        links.push_back(body.name);
      }
    if (links.empty()) return;
    sdf_devices::Subsystem lift(names_.unique("gravity_compensation"), "drive.gravity_compensation", at);
    if (links.size() < assembly_.bodies.size()) lift.add("links", links);
    add({concat("<gravity> of ", links.size() == 1 ? "link " : "links ", quoted_list(links)), at, {lift}});
  }

  void add_self_collision(const FileLocation& model) {
    bool found = sources_.self_colliding.count(model) > 0;
    for (const Body& body : assembly_.bodies) found = found || sources_.self_colliding.count(body.location) > 0;
    if (!found) return;
    sdf_devices::Subsystem motion("motion", "", model);
    motion.add_flag("self_collision", true);
    subsystems_.push_back(motion);
    problems_.note(model,
                   "<self_collide> is `self_collision` of motions that have it: all links of the robot touch "
                   "each other, but neighbours");
  }

  const Assembly& assembly_;
  const SourceFiles& sources_;
  Problems& problems_;
  sdf_devices::PartNames names_;
  std::vector<sdf_devices::Subsystem> subsystems_;
};

}  // namespace

void add_devices(const Assembly& assembly, const ::sdf::Model& model, const SourceFiles& sources, RobotBuilder& builder,
                 Problems& problems) {
  Devices devices(assembly, sources, problems);
  devices.run(model);
  sdf_devices::give(devices.subsystems(), builder);
}

}  // namespace muro::sdf
