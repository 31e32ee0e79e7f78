// SPDX-License-Identifier: MIT
#include "values.hpp"

#include <algorithm>
#include <bit>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "plugins/common/text/quote.hpp"
#include "plugins/common/text/with_scalar.hpp"

namespace muro::jsonrpc {

namespace {

[[noreturn]] void misfit(const std::string& what) { throw RpcError{Code::invalid_params, what}; }

Reply scalar_at(const ValueType& type, const std::byte* at, const Inspection& inspection) {
  return with_scalar(type.scalar, [&]<class T>(T zero) -> Reply {
    T x = zero;
    std::memcpy(&x, at, sizeof x);
    if constexpr (std::is_same_v<T, std::uint32_t>) {
      if (type.name == "muro.ObjectId")
        return ObjectId{x} == no_object ? Reply() : Reply(std::string(inspection.object_name(ObjectId{x})));
      if (type.name == "muro.TextId") return std::string(inspection.text(TextId{x}));
    }
    if constexpr (std::is_floating_point_v<T>) return number(double(x));
    return x;
  });
}

/// Returns `value` as T. Throws when T cannot hold it.
template <class T>
T number_as(const Json& value, const std::string& name) {
  if constexpr (std::is_floating_point_v<T>) {
    const double x = value.is_number() ? value.get<double>() : std::nan("");
    if (!std::isfinite(T(x))) misfit("a value for " + name + " must be a finite number");
    return T(x);
  } else {
    const auto least = std::to_string(std::numeric_limits<T>::min()),
               most = std::to_string(std::numeric_limits<T>::max());
    const auto fits = [](auto x) { return std::in_range<T>(x); };
    const bool is_fine = value.is_number_unsigned()  ? fits(value.get<std::uint64_t>())
                         : value.is_number_integer() ? fits(value.get<std::int64_t>())
                                                     : false;
    if (!is_fine) misfit("a value for " + name + " must be a whole number from " + least + " to " + most);
    return value.get<T>();
  }
}

void put(const ValueType& type, std::uint32_t column, const Json& value, const std::string& name, std::string& bytes) {
  with_scalar(type.scalar, [&]<class T>(T) {
    const T x = number_as<T>(value, name);
    std::memcpy(bytes.data() + column * sizeof x, &x, sizeof x);
  });
}

bool is_told_in_base64(const LiveProperty& p, Encoding encoding) {
  const ValueType& type = *p.key->type;
  return encoding == Encoding::base64 && p.multiplicity != Multiplicity::single && has_values(p) &&
         type.name != "muro.ObjectId" && type.name != "muro.TextId";
}

/// Encodes as in RFC 4648, section 4.
std::string base64_of(std::string bytes) {
  namespace iterators = boost::archive::iterators;
  using Digits = iterators::base64_from_binary<iterators::transform_width<const char*, 6, 8>>;
  const std::size_t padding = (3 - bytes.size() % 3) % 3;
  bytes.append(padding, '\0');
  std::string text(Digits(bytes.data()), Digits(bytes.data() + bytes.size()));
  return text.replace(text.size() - padding, padding, padding, '=');
}

Reply bytes_of(const LiveProperty& p) {
  static_assert(std::endian::native == std::endian::little);
  const ValueType& type = *p.key->type;
  const std::string name = with_scalar(type.scalar, []<class T>(T) {
    return (std::is_floating_point_v<T> ? "float"
            : std::is_signed_v<T>       ? "int"
                                        : "uint") +
           std::to_string(8 * sizeof(T));
  });
  std::string bytes(static_cast<const char*>(p.data), std::size_t(p.count) * type.size);
  return {{"type", name}, {"shape", {p.count, type.scalars()}}, {"base64", base64_of(std::move(bytes))}};
}

std::string columns_of(const ValueType& type) {
  std::string all;
  for (const std::string_view label : type.labels) all += (all.empty() ? "" : ", ") + std::string(label);
  return all;
}

}  // namespace

bool has_values(const LiveProperty& p) { return size_of(p.key->type->scalar) != 0; }

std::size_t numbers_in(const LiveProperty& p) {
  return has_values(p) ? std::size_t(p.count) * p.key->type->scalars() : 0;
}

Reply value_of_element(const LiveProperty& p, std::uint32_t element, const Inspection& inspection) {
  const ValueType& type = *p.key->type;
  const auto* first = static_cast<const std::byte*>(p.data) + std::size_t(element) * type.size;
  if (type.labels.empty()) return scalar_at(type, first, inspection);
  Reply columns = Reply::array();
  for (std::uint32_t i = 0; i < type.scalars(); ++i)
    columns.push_back(scalar_at(type, first + i * size_of(type.scalar), inspection));
  return columns;
}

std::size_t cost_of(const LiveProperty& p, Encoding encoding) {
  if (!is_told_in_base64(p, encoding)) return numbers_in(p);
  return (std::size_t(p.count) * p.key->type->size + 7) / 8;
}

Reply value_of(const LiveProperty& p, const Inspection& inspection, Encoding encoding) {
  if (is_told_in_base64(p, encoding)) return bytes_of(p);
  if (p.multiplicity == Multiplicity::single) return value_of_element(p, 0, inspection);
  Reply elements = Reply::array();
  for (std::uint32_t i = 0; i < p.count; ++i) elements.push_back(value_of_element(p, i, inspection));
  return elements;
}

std::string bytes_of_element(const LiveProperty& p, std::uint32_t element, const Json& value, const std::string& name) {
  const ValueType& type = *p.key->type;
  std::string bytes(static_cast<const char*>(p.data) + std::size_t(element) * type.size, type.size);
  if (type.labels.empty()) {
    put(type, 0, value, name, bytes);
  } else if (value.is_object()) {
    for (const auto& [column, number_in_it] : value.items()) {
      const auto place = std::find(type.labels.begin(), type.labels.end(), column);
      if (place == type.labels.end()) misfit(name + " has no column " + quote(column) + "; it has " + columns_of(type));
      put(type, std::uint32_t(place - type.labels.begin()), number_in_it, name, bytes);
    }
  } else if (value.is_array() && value.size() == type.scalars()) {
    for (std::uint32_t i = 0; i < type.scalars(); ++i) put(type, i, value[i], name, bytes);
  } else {
    misfit("a value for " + name + " must be an array of " + std::to_string(type.scalars()) + " numbers (" +
           columns_of(type) + "), or an object with some of them");
  }
  return bytes;
}

}  // namespace muro::jsonrpc
