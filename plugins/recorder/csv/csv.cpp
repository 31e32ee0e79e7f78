// SPDX-License-Identifier: MIT
// Writes properties to a CSV file while the simulation runs.
#include <filesystem>
#include <optional>
#include <vector>

#include "csv_file.hpp"
#include "glob.hpp"
#include "muro/nearest.hpp"
#include "muro/plugin.hpp"

namespace {

using namespace muro;

constexpr Parameter parameters[] = {
    text("file", "", "where to write; a relative path starts in the working directory").must_be_given(),
    texts("properties", "\"object:property\", with * and ?; default: the pose of every robot's base"),
};
constexpr Description description{
    .id = "recorder.csv",
    .kind = Kind::recorder,
    .version = "1.0.0",
    .summary = "Writes any properties at any rate to a CSV file, a row for each run",
    .parameters = parameters,
    .promises = deterministic | allocation_free | restorable,
};

class Csv final : public Algorithm {
 public:
  void connect(Connector& c) override {
    path_ = std::filesystem::absolute(std::string(c.parameters().text("file"))).string();
    const auto wanted = c.parameters().texts("properties");
    if (wanted.empty())
      for (const RobotView* robot : c.robots()) record(c, std::string(c.object_name(robot->base())) + ":pose");
    for (const std::string_view pattern : wanted) record(c, pattern);
  }

  void start() override {
    file_.emplace(path_);
    file_->text("time");
    for (const Source& s : sources_) write_header(s);
    file_->end_row();
    file_->flush();
  }

  void step(const Step& step, Range) override {
    file_->number(step.seconds());
    for (const Source& s : sources_) {
      const auto* scalar = static_cast<const std::byte*>(elements(s).data);
      const std::size_t n = elements(s).size * s.type->scalars(), size = size_of(s.type->scalar);
      for (std::size_t i = 0; i < n; ++i) file_->number(s.type->scalar, scalar + i * size);
    }
    file_->end_row();
  }

  void finish() override { file_->flush(); }

 private:
  struct Source {
    std::string name;
    const ValueType* type;
    Form form;
    const void* place;  ///< the value, or an ArrayHeader
  };

  static ArrayHeader elements(const Source& s) {
    return s.form == Form::array ? *static_cast<const ArrayHeader*>(s.place) : ArrayHeader{const_cast<void*>(s.place), 1};
  }

  /// Binds every property that fits.
  void record(Connector& c, std::string_view pattern) {
    const std::size_t before = sources_.size();
    std::vector<std::string> names;
    for (std::uint32_t o = 0; o < c.object_count(); ++o) {
      const auto found = c.properties(ObjectId{o});
      const std::vector<FoundProperty> properties(found.begin(), found.end());
      for (const FoundProperty& p : properties) {
        const std::string name = std::string(c.object_name(p.object)) + ":" + std::string(p.key->name);
        names.push_back(name);
        if (!fits(pattern, name)) continue;
        const bool plain = size_of(p.key->type->scalar) > 0 && p.form != Form::list;
        const bool exact = pattern == name;
        if (!plain && exact) throw Error("`" + name + "` has no fixed columns (type " + std::string(p.key->type->name) + "), so it cannot be recorded");
        if (plain) sources_.push_back({name, p.key->type, p.form, c.read_any(p)});
      }
    }
    if (sources_.size() == before)
      throw Error("no property fits `" + std::string(pattern) + "`" + did_you_mean(pattern, names) +
                  "; write \"object:property\", such as \"rover_0/base_link:pose\"; `muro describe` lists all");
  }

  void write_header(const Source& s) {
    const std::uint64_t n = elements(s).size;
    for (std::uint64_t i = 0; i < n; ++i) {
      const std::string element = s.form == Form::array ? s.name + "[" + std::to_string(i) + "]" : s.name;
      if (s.type->labels.empty()) file_->text(element);
      for (const std::string_view label : s.type->labels) file_->text(element + "." + std::string(label));
    }
  }

  std::string path_;
  std::vector<Source> sources_;
  std::optional<CsvFile> file_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Csv>(description)};

}  // namespace

MURO_PLUGIN(.name = "recorder_csv", .version = "1.0.0", .licence = "MIT", .summary = "Properties to CSV files",
            .algorithms = algorithms)
