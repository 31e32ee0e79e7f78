// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/instance.hpp"
#include "muro/base/did_you_mean.hpp"

namespace muro {

namespace {

/// Limit for parameters without a range of their own: a greater number is a mistake, and no index is made of it.
constexpr double largest_number = 1e15;

std::string shown(double x) { return fmt::format("{:g}", x); }

std::string shown(const ParameterInput& input) {
  struct Visitor {
    std::string operator()(bool b) const { return b ? "true" : "false"; }
    std::string operator()(std::int64_t i) const { return std::to_string(i); }
    std::string operator()(double d) const { return shown(d); }
    std::string operator()(const std::string& s) const { return "\"" + s + "\""; }
    std::string operator()(const std::vector<double>& v) const {
      std::string all = "[";
      for (const double d : v) all += (all.size() > 1 ? ", " : "") + shown(d);
      return all + "]";
    }
    std::string operator()(const std::vector<std::string>& v) const { return fmt::format("[{}]", fmt::join(v, ", ")); }
  };
  return std::visit(Visitor{}, input);
}

double least(const Parameter& p) { return std::max(p.min, -largest_number); }
double most(const Parameter& p) { return std::min(p.max, largest_number); }

std::string range_of(const Parameter& p) {
  const std::string unit = p.unit == "1" ? "" : fmt::format(" {}", p.unit);
  return fmt::format(" from {} to {}{}", shown(least(p)), shown(most(p)), unit);
}

std::string allowed_values(const Parameter& p) {
  switch (p.type) {
    case ParameterType::real:
      return "a number" + range_of(p);
    case ParameterType::integer:
      return "a whole number" + range_of(p);
    case ParameterType::boolean:
      return "true or false";
    case ParameterType::reals:
      return (p.length > 0 ? fmt::format("a list of {} numbers", p.length) : "a list of numbers") + range_of(p);
    case ParameterType::texts:
      return "a list of texts or a map of single values";
    case ParameterType::text:
      break;
  }
  if (p.choices.empty()) return p.is_required ? "a text that is not empty" : "a text";
  return fmt::format("one of {}", fmt::join(p.choices, ", "));
}

const double* number_in(const ParameterInput& input, double& storage) {
  if (const auto* d = std::get_if<double>(&input)) return d;
  if (const auto* i = std::get_if<std::int64_t>(&input)) {
    storage = double(*i);
    return &storage;
  }
  return nullptr;
}

/// Returns the choice that a file means by a word which YAML reads as true or false: `off` among `on` and `off`.
const std::string_view* choice_of(const Parameter& p, bool given) {
  constexpr std::string_view words[2][3] = {{"off", "no", "false"}, {"on", "yes", "true"}};
  for (const std::string_view& choice : p.choices)
    if (std::find(std::begin(words[given]), std::end(words[given]), choice) != std::end(words[given])) return &choice;
  return nullptr;
}

bool inside(const Parameter& p, double x) { return x >= least(p) && x <= most(p); }

}  // namespace

ParameterSet::ParameterSet(const Description& description, const AlgorithmSetup& setup) {
  std::vector<std::string> problems, names;
  /// Puts the place of the parameter before the problems from `first` on.
  const auto place = [&](std::size_t first, const std::string& parameter) {
    const auto elsewhere = setup.parameter_places.find(parameter);
    const std::string& at = elsewhere == setup.parameter_places.end() ? setup.place : elsewhere->second;
    for (std::size_t i = first; i < problems.size(); ++i)
      problems[i] = fmt::format("{}{}: {}", prefix_of(at), setup.name, problems[i]);
  };
  for (const Parameter& p : description.parameters) {
    names.emplace_back(p.name);
    const auto given = setup.parameters.find(names.back());
    const std::size_t before = problems.size();
    values_.push_back(value_of(p, given == setup.parameters.end() ? nullptr : &given->second, problems));
    place(before, names.back());
  }
  for (const auto& [name, unused] : setup.parameters) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    problems.push_back(fmt::format("`{}` has no parameter `{}`{}; it has{}", description.id, name,
                                   did_you_mean(name, names),
                                   names.empty() ? " none" : fmt::format(": {}", fmt::join(names, ", "))));
    place(problems.size() - 1, name);
  }
  if (!problems.empty()) throw SetupError(problems);
  view_ = Parameters(values_);
}

ParameterValue ParameterSet::value_of(const Parameter& p, const ParameterInput* given,
                                      std::vector<std::string>& problems) {
  ParameterValue v{
      .name = p.name, .number = p.default_number, .text = p.default_text, .reals = p.default_reals, .texts = {}};
  if (!given) {
    if (p.is_required)
      problems.push_back(fmt::format("parameter `{}` is missing: {} ({})", p.name, allowed_values(p), p.doc));
    return v;
  }
  v.given = true;
  double storage = 0;
  bool fine = false;
  switch (p.type) {
    case ParameterType::real:
    case ParameterType::integer:
      if (const double* x = number_in(*given, storage)) {
        fine = inside(p, *x) && (p.type == ParameterType::real || *x == std::floor(*x));
        v.number = *x;
      }
      break;
    case ParameterType::boolean:
      if (const bool* b = std::get_if<bool>(given)) {
        fine = true;
        v.number = *b ? 1 : 0;
      }
      break;
    case ParameterType::text:
      if (const auto* s = std::get_if<std::string>(given)) {
        v.text = texts_.emplace_back(*s);
        fine = p.choices.empty() ? !p.is_required || !v.text.empty()
                                 : std::find(p.choices.begin(), p.choices.end(), v.text) != p.choices.end();
      } else if (const bool* b = std::get_if<bool>(given)) {
        const std::string_view* const choice = choice_of(p, *b);
        fine = choice != nullptr;
        if (choice) v.text = *choice;
      }
      break;
    case ParameterType::reals:
      if (const auto* list = std::get_if<std::vector<double>>(given)) {
        v.reals = reals_.emplace_back(*list);
        fine = (p.length == 0 || v.reals.size() == p.length) &&
               std::all_of(v.reals.begin(), v.reals.end(), [&](double x) { return inside(p, x); });
      } else if (const double* x = number_in(*given, storage)) {
        v.reals = reals_.emplace_back(1, *x);
        fine = p.length <= 1 && inside(p, *x);
      } else if (const auto* none = std::get_if<std::vector<std::string>>(given)) {
        fine = none->empty() && p.length == 0;
      }
      break;
    case ParameterType::texts: {
      auto& list = text_lists_.emplace_back();
      if (const auto* many = std::get_if<std::vector<std::string>>(given)) {
        fine = true;
        for (const std::string& s : *many) list.push_back(texts_.emplace_back(s));
      } else if (const auto* one = std::get_if<std::string>(given)) {
        fine = true;
        list.push_back(texts_.emplace_back(*one));
      } else if (const double* number = number_in(*given, storage)) {
        fine = true;
        list.push_back(texts_.emplace_back(fmt::format("{}", *number)));
      }
      v.texts = list;
      break;
    }
  }
  if (!fine)
    problems.push_back(fmt::format("parameter `{}` is {} but must be {}", p.name, shown(*given), allowed_values(p)));
  return v;
}

}  // namespace muro
