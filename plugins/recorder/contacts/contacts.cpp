// SPDX-License-Identifier: MIT
// Writes contacts and their wrenches to a CSV file while the simulation runs; see README.md.
#include <algorithm>
#include <filesystem>
#include <optional>

#include "muro/base/did_you_mean.hpp"
#include "muro/ext/outputs.hpp"
#include "muro/plugin.hpp"
#include "plugins/common/contact_geometry/contact_responsibility.hpp"
#include "plugins/common/text/glob.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/recorder/common/csv_file/csv_file.hpp"

namespace {

using namespace muro;

constexpr Parameter parameters[] = {
    text("file", "", "where to write; a relative path starts in the working directory").required(),
    texts("bodies", "names with * and ?: only contacts of these; default: of all"),
};
constexpr PropertyUse reads[] = {
    {keys::contact_wrenches_of_motion.name, "of every robot that an engine moves"},
    {keys::contact_wrenches_of_law.name, "of every robot that the contact algorithm pushes"},
    {keys::contact_world.name, "of the same robots: whether forces move them at present"}};
constexpr Description description{
    .id = "recorder.contacts",
    .kind = Kind::recorder,
    .version = "1.0.0",
    .summary = "Writes what contacts do to a CSV file, a row for each contact of each run",
    .parameters = parameters,
    .reads = reads,
    .capabilities = deterministic | allocation_free | restorable,
};

constexpr std::string_view titles[] = {"time",      "body",      "other",     "point.x",  "point.y",   "point.z",
                                       "normal.x",  "normal.y",  "normal.z",  "depth",    "wrench.fx", "wrench.fy",
                                       "wrench.fz", "wrench.tx", "wrench.ty", "wrench.tz"};

class ContactRecorder final : public Algorithm {
 public:
  ~ContactRecorder() override {
    if (file_ && last_time_ < 0) file_->discard();  // the run has not begun: there is nothing but titles
  }

  void connect(Connector& c) override {
    std::error_code code;
    const std::string file(c.parameters().text("file"));
    path_ = std::filesystem::absolute(file, code).string();
    if (code) throw Error("file " + file + " cannot be written: the working directory is not there any more");
    if (Outputs* outputs = Outputs::of(c.host())) outputs->file(path_);
    choose_bodies(c);
    const auto has = [&](const RobotView* robot, const Key<ContactWrench>& key) {
      const auto properties = c.properties(robot->base());
      return std::any_of(properties.begin(), properties.end(),
                         [&](const FoundProperty& p) { return p.key->name == key.name; });
    };
    for (const RobotView* robot : c.robots()) {
      if (!has(robot, keys::contact_wrenches_of_motion) &&
          !c.is_used(robot->base(), keys::external_wrench, usage::read_sum))
        continue;  // no force moves it: its contacts are in the lists of the robots that it pushes
      for (const Key<ContactWrench>* key : {&keys::contact_wrenches_of_motion, &keys::contact_wrenches_of_law})
        if (has(robot, *key))
          lists_.push_back({c.read_list(robot->base(), *key), c.read(robot->base(), keys::contact_world), robot->id});
    }
    if (lists_.empty())
      throw Error(
          "there are no contacts to record: no robot is moved by forces; choose motion.simplified or a motion by an "
          "engine");
  }

  void start() override {
    if (file_ && !file_->is_published())
      file_->begin_anew();
    else
      file_.emplace(path_);
    last_time_ = -1;
    for (const std::string_view title : titles) file_->text(title);
    file_->end_row();
  }

  void step(const Step& step, Range) override {
    if (step.time <= last_time_) file_->cut_back(step.time);  // after a restored snapshot
    last_time_ = step.time;
    for (const RobotList& list : lists_) {
      if (!is_moved_by_forces(*list.world)) continue;  // the list of the robot that is pushed holds these contacts, too
      for (const ContactWrench& contact : *list.contacts)
        if ((is_wanted(contact.body) || is_wanted(contact.other)) && !stands_before(list, contact))
          write(step.time, contact);
    }
  }

  void finish() override { file_->publish(); }

 private:
  /// Contacts of a robot, as an engine or the contact algorithm reports them.
  struct RobotList {
    ListIn<ContactWrench> contacts;
    In<std::uint64_t> world;  ///< see keys::contact_world
    RobotId robot = no_robot;
  };

  void choose_bodies(const Connector& c) {
    for (std::uint32_t i = 0; i < c.object_count(); ++i) {
      names_.emplace_back(c.object_name(ObjectId{i}));
      robot_of_.push_back(c.robot_of(ObjectId{i}));
    }
    const auto patterns = c.parameters().texts("bodies");
    wanted_.assign(names_.size(), patterns.empty());
    for (const std::string_view pattern : patterns) {
      bool matched = false;
      for (std::size_t i = 0; i < names_.size(); ++i) {
        if (!matches(pattern, names_[i])) continue;
        matched = true;
        wanted_[i] = true;
      }
      if (!matched)
        throw Error("no body matches " + quote(pattern) + did_you_mean(pattern, names_) +
                    "; write \"robot/body\" or the name of an object, such as \"rover_*/left_wheel\" or \"ground\"");
    }
  }

  /// Returns whether the list of an earlier robot already holds this contact, as the other body feels it.
  bool stands_before(const RobotList& own, const ContactWrench& contact) const {
    const RobotId other = contact.other == no_object ? no_robot : robot_of_[index_of(contact.other)];
    if (other >= own.robot) return false;  // no_robot is the last
    const auto is_same = [&](const ContactWrench& c) {
      return c.body == contact.other && c.other == contact.body && c.point == contact.point;
    };
    const auto precedes = [](const RobotList& list, RobotId robot) { return list.robot < robot; };
    for (auto at = std::lower_bound(lists_.begin(), lists_.end(), other, precedes);
         at != lists_.end() && at->robot == other; ++at)
      if (is_moved_by_forces(*at->world) && std::any_of((*at->contacts).begin(), (*at->contacts).end(), is_same))
        return true;
    return false;
  }

  bool is_wanted(ObjectId body) const { return body != no_object && wanted_[index_of(body)]; }
  std::string_view name_of(ObjectId body) const {
    return body == no_object ? std::string_view() : std::string_view(names_[index_of(body)]);
  }

  void write(std::int64_t time, const ContactWrench& c) {
    file_->time(time);
    file_->text(name_of(c.body));
    file_->text(name_of(c.other));
    for (const Vec3* v : {&c.point, &c.normal})
      for (int k = 0; k < 3; ++k) file_->number(Scalar::f64, &(*v)[k]);
    file_->number(Scalar::f64, &c.depth);
    for (const Vec3* v : {&c.wrench.force, &c.wrench.torque})
      for (int k = 0; k < 3; ++k) file_->number(Scalar::f64, &(*v)[k]);
    file_->end_row();
  }

  std::string path_;
  std::vector<std::string> names_;  ///< of all objects
  std::vector<bool> wanted_;        ///< by object
  std::vector<RobotId> robot_of_;   ///< by object
  std::vector<RobotList> lists_;    ///< in the order of robots
  std::optional<CsvFile> file_;
  std::int64_t last_time_ = -1;  ///< ns, of the last run
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<ContactRecorder>(description)};

}  // namespace

MURO_PLUGIN(.name = "recorder_contacts", .version = description.version, .licence = "MIT",
            .summary = "Contacts to CSV files", .algorithms = algorithms)
