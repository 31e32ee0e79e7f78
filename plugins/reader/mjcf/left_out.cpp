// SPDX-License-Identifier: MIT
#include "left_out.hpp"

#include <algorithm>
#include <map>

#include "plugins/common/text/quote.hpp"

namespace muro::mjcf {

namespace {

constexpr const char* in_model_mode = "; motion.mujoco has them with `settings: model`";

class Report {
 public:
  Report(const mjModel& m, const Source& source, Problems& problems) : m_(m), source_(source), problems_(problems) {}

  /// Reports the objects of one kind. `what`: "tendons"; `tags`: elements that may define such an object; `addresses`:
  /// of the names of the objects.
  void list(Severity severity, const char* what, int count, const int* addresses,
            std::initializer_list<const char*> tags, const std::string& end) {
    if (count == 0) return;
    std::vector<std::string> names;
    for (int i = 0; i < count; ++i) names.push_back(named(addresses, i));
    Location at;
    for (const char* tag : tags)
      if (at.line == 0) at = source_.location_of(tag, name_of(m_, addresses, 0));
    problems_.report(severity, at, concat(what, " ", quoted_list(names), end));
  }

  void actuators(const Drives& drives) {
    std::map<std::string, std::vector<std::string>> by_reason;
    for (const auto& [actuator, why] : drives.left_out) by_reason[why].push_back(named(m_.name_actuatoradr, actuator));
    for (const auto& [why, names] : by_reason)
      problems_.warning({}, concat(names.size() == 1 ? "actuator " : "actuators ", quoted_list(names),
                                   names.size() == 1 ? " is left out: it " : " are left out: each ", why));
    const bool servo = std::any_of(drives.of_joint.begin(), drives.of_joint.end(),
                                   [](const Drive& d) { return d.mode == DriveMode::velocity; });
    if (servo)
      problems_.note({},
                     "gains of velocity servos are those of the motion; motion.mujoco has the file's "
                     "with `settings: model`");
  }

  void sensors() {
    std::vector<std::string> names;
    for (int s = 0; s < m_.nsensor; ++s) names.push_back(named(m_.name_sensoradr, s));
    if (names.empty()) return;
    problems_.note({}, concat("sensors ", quoted_list(names),
                              " are left out; their sites are links of the robot, where a scenario may have sensors"));
  }

  void options() {
    const mjOption& o = m_.opt;
    if (o.density != 0 || o.viscosity != 0 || vector_of(o.wind) != Vec3::Zero())
      problems_.warning({}, "density, viscosity and wind of <option> are left out: there is no drag");
    if ((o.disableflags & (mjDSBL_CONTACT | mjDSBL_CONSTRAINT)) != 0)
      problems_.warning({}, "the <flag> of <option> that disables contacts or constraints is left out");
    if ((o.enableflags & mjENBL_OVERRIDE) != 0)
      problems_.warning({}, "the <flag> of <option> that overrides contact parameters is left out");
  }

 private:
  std::string named(const int* addresses, int i) const {
    const std::string name = name_of(m_, addresses, i);
    return name.empty() ? concat("number ", i + 1) : name;
  }

  const mjModel& m_;
  const Source& source_;
  Problems& problems_;
};

}  // namespace

void report_left_out(const mjModel& m, const Source& source, const Drives& drives, Problems& problems) {
  Report report(m, source, problems);
  report.list(Severity::warning, "equality constraints", m.neq, m.name_eqadr, {"connect", "weld", "joint", "tendon"},
              concat(" are left out", in_model_mode));
  report.list(Severity::warning, "tendons", m.ntendon, m.name_tendonadr, {"fixed", "spatial"},
              concat(" are left out", in_model_mode));
  report.list(Severity::warning, "contact pairs", m.npair, m.name_pairadr, {"pair"},
              concat(" are left out: what touches follows from contype and conaffinity", in_model_mode));
  report.list(Severity::warning, "skins", m.nskin, m.name_skinadr, {"skin"}, " are left out");
  report.list(Severity::note, "exclusions of contact", m.nexclude, m.name_excludeadr, {"exclude"},
              " count with `settings: model` of motion.mujoco alone; links of one robot touch with `self_collision`");
  report.list(Severity::note, "keyframes", m.nkey, m.name_keyadr, {"key"},
              " are left out: the scenario says where joints start (`joints:`)");
  report.actuators(drives);
  report.sensors();
  report.options();
}

}  // namespace muro::mjcf
