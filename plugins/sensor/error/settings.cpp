// SPDX-License-Identifier: MIT
#include "settings.hpp"

#include <initializer_list>

#include "muro/algorithm.hpp"
#include "muro/base/number_text.hpp"
#include "plugins/common/text/counted.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro {

namespace {

PerComponent per_component(const GivenErrors& given, std::string_view name, const ReadingShape& reading) {
  const std::span<const double> numbers = given.numbers(name);
  const bool is_array = reading.is_array();
  const bool one_each = !is_array && numbers.size() == reading.components;
  if (numbers.size() > 1 && !one_each)
    given.fail(name, std::string(name) + " has " + counted(numbers.size(), "number") + ", but " + quote(reading.name) +
                         (is_array ? " is an array, for whose elements there is one"
                                   : " has " + counted(reading.components, "component")) +
                         "; give one number" +
                         (is_array || reading.components == 1 ? "" : " or " + std::to_string(reading.components)));
  return PerComponent(numbers);
}

std::string form_of(const ReadingShape& reading) {
  switch (reading.form) {
    case ReadingForm::array:
      return "an array";
    case ReadingForm::image:
      return "an image";
    case ReadingForm::orientation:
      return "an orientation";
    case ReadingForm::pose:
      return "a pose";
    case ReadingForm::list:
      return "a list";
    default:
      return reading.components > 1 ? "a value of " + counted(reading.components, "component") : "a single number";
  }
}

void refuse(const GivenErrors& given, std::initializer_list<std::string_view> names, bool fits,
            const ReadingShape& reading, const std::string& of) {
  for (const std::string_view name : names)
    if (!fits && given.given(name))
      given.fail(name, std::string(name) + " is " + of + ", but " + quote(reading.name) + " is " + form_of(reading) +
                           "; remove it");
}

/// Throws muro::Error if a given error of the device does not fit readings of this form.
void check_form(const GivenErrors& given, const ReadingShape& reading) {
  const bool is_list = reading.form == ReadingForm::list, is_image = reading.form == ReadingForm::image;
  refuse(given, {"correlation"}, reading.is_array(), reading, "between neighbours in an array");
  refuse(given, {"pointing"}, reading.form == ReadingForm::array, reading, "of the rays of a laser");
  refuse(given, {"bandwidth"}, !is_image, reading, "of what is seen at every instant");
  refuse(given, {"misalignment", "cross_axis_tolerance", "g_sensitivity"}, reading.form == ReadingForm::vector, reading,
         "of a vector");
  refuse(given, {"scale", "scale_tolerance", "sigma_relative", "sigma_quadratic", "resolution"},
         !reading.has_orientation(), reading, "of numbers alone");
  refuse(given, {"bandwidth", "full_scale", "bits", "minimum", "maximum", "dropout_value"},
         !reading.has_orientation() && !is_list, reading, "of numbers alone");
  refuse(given, {"delay", "dropout_reads"}, !is_list, reading, "of a reading that is there at every instant");
}

std::array<double, 6> six(const GivenErrors& given, std::string_view name, bool one_for_all) {
  const std::span<const double> numbers = given.numbers(name);
  std::array<double, 6> result{};
  if (numbers.size() == 6)
    std::copy(numbers.begin(), numbers.end(), result.begin());
  else if (numbers.size() == 1 && one_for_all)
    result.fill(numbers[0]);
  else if (!numbers.empty())
    given.fail(name, std::string(name) + " has " + counted(numbers.size(), "number") + " but must have " +
                         (one_for_all ? "one or six" : "six") + ": xy, xz, yx, yz, zx, zy");
  return result;
}

Mat3 matrix(const GivenErrors& given, std::string_view name) {
  const std::span<const double> numbers = given.numbers(name);
  Mat3 m = Mat3::Zero();
  if (numbers.size() == 9)
    for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = numbers[std::size_t(i)];
  else if (numbers.size() == 1 || numbers.size() == 3)
    for (int i = 0; i < 3; ++i) m(i, i) = numbers[numbers.size() == 1 ? 0 : std::size_t(i)];
  else if (!numbers.empty())
    given.fail(name, std::string(name) + " has " + counted(numbers.size(), "number") + " but must have 1, 3 or 9");
  return m;
}

/// Returns which of two parameters with the same meaning counts: one that is given, or any if none is. The scenario has
/// priority over the part. Both in one place are a mistake.
std::string_view one_of(const GivenErrors& given, std::string_view a, std::string_view b) {
  if (given.in_scenario(a) != given.in_scenario(b)) return given.in_scenario(a) ? a : b;
  if (given.given(a) && given.given(b))
    given.fail(b, std::string(a) + " and " + std::string(b) + " say the same in two ways; remove one of them");
  return given.given(a) ? a : b;
}

BiasDrift::Settings drift_of(const GivenErrors& given, const ReadingShape& reading) {
  BiasDrift::Settings d{.random_walk = per_component(given, "random_walk", reading),
                        .gauss_markov_time = given.real("gauss_markov_time"),
                        .bias_instability = per_component(given, "bias_instability", reading),
                        .flicker_from = given.real("flicker_from"),
                        .flicker_to = given.real("flicker_to")};
  const std::string_view name = one_of(given, "gauss_markov_sigma", "gauss_markov_density");
  d.gauss_markov_sigma = per_component(given, name, reading);
  if (!d.gauss_markov_sigma.is_zero() && d.gauss_markov_time <= 0)
    given.fail(name, std::string(name) + " needs the correlation time: gauss_markov_time, above 0 s");
  if (name == "gauss_markov_density")
    d.gauss_markov_sigma = d.gauss_markov_sigma.map([&](double k) { return k * std::sqrt(d.gauss_markov_time / 2); });
  if (d.flicker_from > d.flicker_to)
    given.fail("flicker_from", "flicker_from (" + number_text(d.flicker_from) + " s) is greater than flicker_to (" +
                                   number_text(d.flicker_to) + " s)");
  return d;
}

Quantiser quantiser_of(const GivenErrors& given, const ReadingShape& reading) {
  Quantiser q;
  if (given.real("full_scale") > 0) q.full_scale = given.real("full_scale");
  if (one_of(given, "bits", "resolution") == "bits")
    q.bits = given.integer("bits");
  else
    q.resolution = per_component(given, "resolution", reading);
  if (q.bits > 0 && !std::isfinite(q.full_scale))
    given.fail("bits", "bits are those of a converter from -full_scale to full_scale; give full_scale too");
  return q;
}

}  // namespace

const PartValue* GivenErrors::in_part(std::string_view name) const {
  if (!section_) return nullptr;
  const auto found = section_->values.find(name);
  return found == section_->values.end() ? nullptr : &found->second;
}

double GivenErrors::real(std::string_view name) const {
  const PartValue* v = scenario_.given(name) ? nullptr : in_part(name);
  return v ? v->numbers.front() : scenario_.real(name);
}

std::string_view GivenErrors::text(std::string_view name) const {
  const PartValue* v = scenario_.given(name) ? nullptr : in_part(name);
  return v ? std::string_view(v->word) : scenario_.text(name);
}

std::span<const double> GivenErrors::numbers(std::string_view name) const {
  const PartValue* v = scenario_.given(name) ? nullptr : in_part(name);
  return v ? std::span<const double>(v->numbers) : scenario_.reals(name);
}

void GivenErrors::fail(std::string_view name, const std::string& what) const {
  const PartValue* v = scenario_.given(name) ? nullptr : in_part(name);
  throw Error(v ? v->place + what : what);
}

ErrorSettings settings_of(const GivenErrors& given, const ReadingShape& reading) {
  check_form(given, reading);
  const auto each = [&](std::string_view name) { return per_component(given, name, reading); };
  ErrorSettings s;
  s.bandwidth = each("bandwidth");
  s.bandwidth_order = given.integer("bandwidth_order");
  s.alignment = {.scale = each("scale"),
                 .scale_tolerance = each("scale_tolerance"),
                 .misalignment = six(given, "misalignment", false),
                 .cross_axis_tolerance = six(given, "cross_axis_tolerance", true),
                 .g_sensitivity = matrix(given, "g_sensitivity")};
  s.bias = each("bias");
  s.turn_on_bias_tolerance = each("turn_on_bias_tolerance");
  s.drift = drift_of(given, reading);
  s.noise = {.sigma = each("sigma"),
             .sigma_relative = each("sigma_relative"),
             .sigma_quadratic = given.real("sigma_quadratic"),
             .pointing = given.real("pointing"),
             .correlation = given.real("correlation"),
             .density = each("noise_density")};
  s.quantiser = quantiser_of(given, reading);
  s.delay = given.real("delay");
  s.dropouts = {.probability = given.real("dropout"),
                .value = given.real("dropout_value"),
                .hold = reading.has_orientation() || given.text("dropout_reads") == "hold",
                .together = !reading.is_array()};
  return s;
}

}  // namespace muro
