// SPDX-License-Identifier: MIT
// Part files: read as a file of any plugin, and as a device of sensor.error, which then gives readings.
#include <cmath>

#include "muro/algorithm.hpp"
#include "plugins/common/part_file/part_file.hpp"
#include "plugins/sensor/error/error_chain.hpp"
#include "plugins/sensor/error/parameters.hpp"
#include "plugins/sensor/error/part.hpp"
#include "plugins/sensor/error/settings.hpp"
#include "tests/fuzz/target.hpp"

namespace muro::fuzz {

namespace {

/// Returns the values of a scenario that gives nothing but the part.
std::vector<ParameterValue> defaults() {
  std::vector<ParameterValue> values;
  for (const Parameter& p : error_parameters)
    values.push_back({p.name, p.default_number, p.default_text, p.default_reals, {}, false});
  return values;
}

/// Checks some readings of a device with the errors of a section: finite numbers, within its limits.
void read_with(const PartSection& section, ReadingForm form, std::size_t components) {
  static const std::vector<ParameterValue> values = defaults();
  const Parameters none(values);
  const ErrorSettings settings = settings_of(GivenErrors(none, &section), {section.reading, components, form});
  if (settings.delay > 1) return;  // a long delay line takes long
  const bool has_orientation = form == ReadingForm::orientation;
  const ErrorChain chain(settings, components, 0.01, 1,
                         has_orientation ? ErrorChain::Form::with_orientation : ErrorChain::Form::numbers);
  std::vector<double> state(chain.state_size()), truth(components + (has_orientation ? 1 : 0), 0.0), read(truth.size());
  truth.back() = 1;
  const Vec3 force(0, 0, 9.81);
  for (std::uint64_t k = 0; k < 5; ++k) {
    chain.apply(truth, read, state, {.seed = 1, .index = k, .specific_force = &force});
    for (const double x : read) {
      require(std::isfinite(x), "a reading is no number");
      require(std::abs(x) <= settings.quantiser.full_scale || settings.dropouts.probability > 0,
              "a reading is beyond full scale");
    }
  }
}

void refused_or(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& e) {
    outcome(e.what());
  }
}

}  // namespace

void read_as_part(Bytes bytes) {
  refused_or([&] {
    const PartFile file = PartFile::parse(text_of(bytes), "part.yaml");
    for (const PartFile::Entry& entry : file.entries()) {
      require(file.find(entry.section, entry.name) == &entry, "an entry is not found");
      refused_or([&] {
        for (const double x : file.numbers(entry)) require(std::isfinite(x), "a number is none");
      });
    }
    const Part part = make_part(file, error_parameters);
    for (const PartSection& section : part.sections) {
      refused_or([&] { read_with(section, ReadingForm::value, 1); });
      refused_or([&] { read_with(section, ReadingForm::vector, 3); });
      refused_or([&] { read_with(section, ReadingForm::orientation, 3); });
    }
  });
}

}  // namespace muro::fuzz
