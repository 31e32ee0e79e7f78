// SPDX-License-Identifier: MIT
// Writes properties to a CSV file while the simulation runs; see README.md.
#include <filesystem>
#include <optional>

#include "means.hpp"
#include "muro/ext/outputs.hpp"
#include "muro/plugin.hpp"
#include "plugins/recorder/common/csv_file/csv_file.hpp"
#include "plugins/recorder/common/recorded_property/recorded_property.hpp"

namespace {

using namespace muro;

constexpr Parameter parameters[] = {
    text("file", "", "where to write; a relative path starts in the working directory").required(),
    texts("properties", "\"object:property\", with * and ?; default: the pose of every robot's base"),
    texts("mean", "likewise: columns with the means over the runs since the last row"),
    integer("every", 1, "runs for each row").between(1, 1000000000),
};
constexpr PropertyUse reads[] = {{"*", "what `properties` and `mean` name"}};
constexpr Description description{
    .id = "recorder.csv",
    .kind = Kind::recorder,
    .version = "1.1.0",
    .summary = "Writes any properties at any rate to a CSV file, a row for each run",
    .parameters = parameters,
    .reads = reads,
    .capabilities = deterministic | allocation_free | restorable,
};

class CsvRecorder final : public Algorithm {
 public:
  ~CsvRecorder() override {
    if (file_ && last_time_ < 0) file_->discard();  // the run has not begun: there is nothing but titles
  }

  void connect(Connector& c) override {
    std::error_code code;
    const std::string file(c.parameters().text("file"));
    path_ = std::filesystem::absolute(file, code).string();
    if (code) throw Error("file " + file + " cannot be written: the working directory is not there any more");
    if (Outputs* outputs = Outputs::of(c.host())) outputs->file(path_);
  }
  void connect_by_name(Connector& c) override {
    every_ = std::uint64_t(c.parameters().integer("every"));
    properties_ = select(c, c.parameters().texts("properties"));
    if (const auto means = c.parameters().texts("mean"); !means.empty()) means_ = Means(select(c, means));
  }

  void start() override {
    if (file_ && !file_->is_published())
      file_->begin_anew();
    else
      file_.emplace(path_);
    last_time_ = -1;
    file_->text("time");
    for (const RecordedProperty& p : properties_)
      for (const std::string& title : p.titles()) file_->text(title);
    for (const std::string& title : means_.titles()) file_->text(title);
    file_->end_row();
    means_.begin();
  }

  void restored() override { means_.begin(); }

  void step(const Step& step, Range) override {
    means_.add();
    if (std::uint64_t(step.index) % every_ != 0) return;
    if (step.time <= last_time_) file_->cut_back(step.time);  // after a restored snapshot
    last_time_ = step.time;
    file_->time(step.time);
    for (const RecordedProperty& p : properties_)
      p.each([&](const void* scalar) { file_->number(p.scalar(), scalar); });
    means_.each([&](double mean) { file_->number(Scalar::f64, &mean); });
    means_.begin();
    file_->end_row();
  }

  void finish() override { file_->publish(); }

 private:
  std::string path_;
  std::vector<RecordedProperty> properties_;
  Means means_;
  std::uint64_t every_ = 1;  ///< runs for each row
  std::optional<CsvFile> file_;
  std::int64_t last_time_ = -1;  ///< ns, of the last row in the file
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<CsvRecorder>(description)};

}  // namespace

MURO_PLUGIN(.name = "recorder_csv", .version = description.version, .licence = "MIT",
            .summary = "Properties to CSV files", .algorithms = algorithms)
