// SPDX-License-Identifier: MIT
#include "params.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "plugins/common/text/counted.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::jsonrpc {

namespace {

[[noreturn]] void refuse(const std::string& why, Reply data = {}) {
  throw RpcError{Code::invalid_params, why, std::move(data)};
}

std::string shown(double x) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.15g", x);
  return digits;
}

}  // namespace

double real_of(const Json& value, const std::string& what, double least, double most) {
  const double x = value.is_number() ? value.get<double>() : std::nan("");
  if (!(x >= least && x <= most)) refuse(what + " must be a number from " + shown(least) + " to " + shown(most));
  return x;
}

Params::Params(const Json& given, std::span<const std::string_view> names) {
  if (given.is_array()) {
    if (given.size() > names.size())
      refuse((given.size() == 1 ? "there is " : "there are ") + counted(given.size(), "parameter") +
             ", but the method has " + std::to_string(names.size()) + ": " + quoted_list(names));
    for (std::size_t i = 0; i < given.size(); ++i) values_[std::string(names[i])] = given[i];
  } else if (given.is_object()) {
    for (const auto& [name, value] : given.items())
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        const std::vector<std::string> known(names.begin(), names.end());
        refuse("there is no parameter " + quote(name) + "; the method has " + quoted_list(names),
               nearest_as_data(name, known));
      }
    values_ = given;
  }
}

bool Params::has(std::string_view name) const { return values_.contains(name); }

const Json& Params::at(std::string_view name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) refuse("the parameter " + quote(name) + " is missing");
  return *found;
}

std::string Params::text(std::string_view name) const {
  const Json& value = at(name);
  if (!value.is_string()) refuse(quote(name) + " must be a text");
  return value.get<std::string>();
}

std::string Params::text(std::string_view name, std::string_view otherwise) const {
  return has(name) ? text(name) : std::string(otherwise);
}

bool Params::flag(std::string_view name, bool otherwise) const {
  if (!has(name)) return otherwise;
  const Json& value = at(name);
  if (!value.is_boolean()) refuse(quote(name) + " must be true or false");
  return value.get<bool>();
}

double Params::real(std::string_view name, double least, double most) const {
  return real_of(at(name), quote(name), least, most);
}

std::int64_t Params::integer(std::string_view name, std::int64_t least, std::int64_t most) const {
  const Json& value = at(name);
  const bool is_too_large =
      value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t(std::max<std::int64_t>(most, 0));
  if (!value.is_number_integer() || is_too_large || value.get<std::int64_t>() < least ||
      value.get<std::int64_t>() > most)
    refuse(quote(name) + " must be a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return value.get<std::int64_t>();
}

std::vector<double> Params::reals(std::string_view name, std::size_t count) const {
  const Json& value = at(name);
  if (!value.is_array() || value.size() != count)
    refuse(quote(name) + " must be an array of " + std::to_string(count) + " numbers");
  std::vector<double> numbers;
  for (const Json& x : value) {
    if (!x.is_number() || !std::isfinite(x.get<double>()))
      refuse(quote(name) + " must be an array of " + std::to_string(count) + " numbers");
    numbers.push_back(x.get<double>());
  }
  return numbers;
}

std::vector<std::string> Params::texts(std::string_view name, std::size_t most) const {
  const Json& value = at(name);
  std::vector<std::string> found;
  if (value.is_string()) {
    found.push_back(value.get<std::string>());
  } else if (value.is_array() && !value.empty() && value.size() <= most) {
    for (const Json& x : value) {
      if (!x.is_string()) refuse(quote(name) + " must be a text or an array of texts");
      found.push_back(x.get<std::string>());
    }
  } else {
    refuse(quote(name) + " must be a text or an array of 1 to " + std::to_string(most) + " texts");
  }
  return found;
}

}  // namespace muro::jsonrpc
