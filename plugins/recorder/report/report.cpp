// SPDX-License-Identifier: MIT
// Writes the values of properties at the end of a run to its report; see README.md.
#include "muro/ext/report_numbers.hpp"
#include "muro/plugin.hpp"
#include "plugins/common/text/with_scalar.hpp"
#include "plugins/recorder/common/recorded_property/recorded_property.hpp"

namespace {

using namespace muro;

constexpr Parameter parameters[] = {
    texts("properties", "\"object:property\", with * and ?").required(),
};
constexpr PropertyUse reads[] = {{"*", "what `properties` names"}};
constexpr Description description{
    .id = "recorder.report",
    .kind = Kind::recorder,
    .version = "1.0.0",
    .summary = "Puts what properties are at the end of a run into its report",
    .parameters = parameters,
    .reads = reads,
    .capabilities = deterministic | allocation_free | restorable,
};

class ReportRecorder final : public Algorithm {
 public:
  void connect(Connector& c) override { report_ = ReportNumbers::of(c.host()); }
  void connect_by_name(Connector& c) override { properties_ = select(c, c.parameters().texts("properties")); }
  void step(const Step&, Range) override {}

  void finish() override {
    if (!report_) return;
    for (const RecordedProperty& p : properties_) {
      const std::vector<std::string> elements = p.elements();
      std::size_t i = 0;
      with_scalar(p.scalar(), [&]<class T>(T) {
        p.each([&](const void* number) {
          const std::string& element = elements[i++];
          report_->set_number(
              {"properties", p.name(), element.empty() ? "value" : element, double(*static_cast<const T*>(number))});
        });
      });
    }
  }

 private:
  ReportNumbers* report_ = nullptr;
  std::vector<RecordedProperty> properties_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<ReportRecorder>(description)};

}  // namespace

MURO_PLUGIN(.name = "recorder_report", .version = description.version, .licence = "MIT",
            .summary = "Properties to the report of a run", .algorithms = algorithms)
