// SPDX-License-Identifier: MIT
#include "exchange.hpp"

#include <charconv>
#include <cmath>

#include "muro/algorithm.hpp"
#include "number.hpp"
#include "plugins/common/model_file/numbers.hpp"
#include "plugins/common/scalar/with_scalar.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::fmu {

namespace {

std::uint32_t scalar_in_element(const Run& run, std::uint64_t i) {
  return std::uint32_t((run.first + i) % run.type->scalars());
}

const Conversion* conversion_of(const Run& run, std::uint64_t i) {
  return run.conversions.empty() ? nullptr : &run.conversions[scalar_in_element(run, i)];
}

[[noreturn]] void fail(const Variable& variable, std::uint64_t element, const std::string& what) {
  throw Error("variable " + quote(variable.name) +
              (variable.size > 1 ? ", element " + std::to_string(element) + "," : "") + " " + what);
}

/// From the properties of `run` to numbers of type T.
template <class T>
void read_run(const Variable& variable, const Run& run, T* to, std::uint64_t begin) {
  with_scalar(run.type->scalar, [&](auto zero) {
    const auto* from = reinterpret_cast<const decltype(zero)*>(run.data);
    for (std::uint64_t i = 0; i < run.count; ++i) {
      const Conversion* const c = conversion_of(run, i);
      const bool fits = variable.type == Type::boolean ? convert(from[i] != 0 ? 1 : 0, to[i])
                        : c                            ? convert(c->to_fmu(double(from[i])), to[i])
                                                       : convert(from[i], to[i]);
      if (!fits)
        fail(variable, begin + i, "does not take " + text_of_number(from[i]) + ", which " + run.name + " is now");
    }
  });
}

/// From numbers of type T to the properties of `run`.
template <class T>
void write_run(const Variable& variable, const Run& run, const T* from, std::uint64_t begin) {
  with_scalar(run.type->scalar, [&](auto zero) {
    auto* to = reinterpret_cast<decltype(zero)*>(run.data);
    for (std::uint64_t i = 0; i < run.count; ++i) {
      if (!std::isfinite(double(from[i])))
        fail(variable, begin + i,
             "is " + (std::isnan(double(from[i])) ? "not a number" : text_of_number(from[i])) +
                 "; outputs must be finite numbers");
      const Conversion* const c = conversion_of(run, i);
      if (!(c ? convert(c->to_property(double(from[i])), to[i]) : convert(from[i], to[i])))
        fail(variable, begin + i, "is " + text_of_number(from[i]) + ", which does not fit into " + run.name);
    }
  });
}

std::optional<std::vector<std::uint8_t>> bytes_of_hexadecimal(std::string_view text) {
  std::vector<std::uint8_t> bytes(text.size() / 2);
  if (text.size() % 2 != 0) return std::nullopt;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char* const begin = text.data() + 2 * i;
    const auto [end, code] = std::from_chars(begin, begin + 2, bytes[i], 16);
    if (code != std::errc() || end != begin + 2) return std::nullopt;
  }
  return bytes;
}

std::vector<std::string_view> split_words(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  std::vector<std::string_view> words;
  for (std::size_t begin = 0; (begin = text.find_first_not_of(blanks, begin)) != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

/// The number of a word that a Boolean or an item of an enumeration is called by; nothing where it is no such word.
std::optional<std::int64_t> number_of_name(const Variable& v, std::string_view word) {
  if (v.type == Type::boolean && (word == "true" || word == "false")) return word == "true" ? 1 : 0;
  if (!v.items) return std::nullopt;
  for (const auto& [name, value] : *v.items)
    if (name == word) return value;
  return std::nullopt;
}

/// What a variable takes that is no plain number, as the end of a sentence.
std::string names_for(const Variable& v) {
  if (v.type == Type::boolean) return ", or true or false";
  if (!v.items) return "";
  std::vector<std::string_view> names;
  for (const auto& [name, value] : *v.items) names.push_back(name);
  return "; items of its type are " + quoted_list(names);
}

/// The number that a word says; integers of 64 bits are exact. Returns what is wrong with it, "" where nothing is.
template <class T>
std::string parse(const Variable& v, std::string_view word, int version, T& result) {
  if constexpr (std::is_integral_v<T>) {
    const char* const end = word.data() + word.size();
    if (const auto read = std::from_chars(word.data(), end, result); read.ec == std::errc() && read.ptr == end)
      return "";
  }
  std::string problem;
  const auto number = model_file::parse_numbers(word, 1, problem);
  const bool is_legal = number && (!std::is_integral_v<T> || number->front() == std::nearbyint(number->front()));
  if (is_legal && convert(number->front(), result)) return "";
  const auto named = number_of_name(v, word);  // items may be called by digits: what is a number stays one
  if (named && convert(*named, result)) return "";
  if (!number && !named) return problem + names_for(v);
  return "does not fit into its type, " + std::string(name_of(v.type, version));
}

std::uint64_t count_of(const std::vector<Run>& runs) {
  std::uint64_t count = 0;
  for (const Run& r : runs) count += r.count;
  return count;
}

}  // namespace

void Run::resolve() {
  std::uint64_t all = type->scalars();
  data = static_cast<std::byte*>(handle);
  if (multiplicity == Multiplicity::array) {
    const auto* array = static_cast<const ArrayHeader*>(handle);
    data = static_cast<std::byte*>(array->data);
    all *= array->size;
  }
  count = wanted ? *wanted : all - std::min(all, first);
  if (first + count > all)
    throw Error(name + " has " + std::to_string(all) + " scalars, [0] to [" + std::to_string(all - 1) + "]; number " +
                std::to_string(first + count - 1) + " is not among them");
  data += first * size_of(type->scalar);
}

void check_size(const Variable& v, std::uint64_t count, const std::string& name) {
  if (v.type == Type::binary || count == v.size) return;
  throw Error("variable " + quote(v.name) + " has " + std::to_string(v.size) + (v.size == 1 ? " number" : " numbers") +
              ", and what it is connected to has " + std::to_string(count) + ": " + name +
              "; choose some by [0], [vx] or [0..2] behind its name");
}

void Exchange::add(const Variable& variable, std::vector<Run> runs, int version) {
  version_ = version;
  if (variable.type == Type::binary) {
    binaries_.push_back({&variable, std::move(runs)});
    return;
  }
  Group& g = groups_[variable.type];
  g.references.push_back(variable.reference);
  g.entries.push_back({&variable, std::move(runs), g.count});
  g.count += variable.size;
  g.buffer.resize(g.count);
}

void Exchange::resolve() {
  const auto check = [](Entry& e) {
    for (Run& r : e.runs) r.resolve();
    check_size(*e.variable, count_of(e.runs), e.runs.front().name + (e.runs.size() > 1 ? " and others" : ""));
  };
  for (auto& [type, group] : groups_)
    for (Entry& e : group.entries) check(e);
  for (Entry& e : binaries_) check(e);
}

void Exchange::set(Component& component) {
  for (auto& [type, group] : groups_) {
    with_fmi_type(type, version_, [&, &g = group](auto zero) {
      auto* const numbers = reinterpret_cast<decltype(zero)*>(g.buffer.data());
      for (const Entry& e : g.entries) {
        std::uint64_t begin = 0;
        for (const Run& r : e.runs) {
          read_run(*e.variable, r, numbers + e.offset + begin, begin);
          begin += r.count;
        }
      }
    });
    component.set(type, group.references, group.buffer.data(), group.count);
  }
  for (const Entry& e : binaries_) {
    bytes_.clear();
    for (const Run& r : e.runs) {
      const auto* from = reinterpret_cast<const std::uint8_t*>(r.data);
      bytes_.insert(bytes_.end(), from, from + r.count);
    }
    component.set_bytes(e.variable->reference, bytes_);
  }
}

void Exchange::get(Component& component) {
  for (auto& [type, group] : groups_) {
    component.get(type, group.references, group.buffer.data(), group.count);
    with_fmi_type(type, version_, [&, &g = group](auto zero) {
      const auto* const numbers = reinterpret_cast<const decltype(zero)*>(g.buffer.data());
      for (const Entry& e : g.entries) {
        std::uint64_t begin = 0;
        for (const Run& r : e.runs) {
          write_run(*e.variable, r, numbers + e.offset + begin, begin);
          begin += r.count;
        }
      }
    });
  }
  for (const Entry& e : binaries_) {
    std::span<const std::uint8_t> bytes = component.get_bytes(e.variable->reference);
    if (bytes.size() != count_of(e.runs))
      throw Error("variable " + quote(e.variable->name) + " has " + std::to_string(bytes.size()) +
                  " bytes, and what it is connected to has " + std::to_string(count_of(e.runs)) + ": " +
                  e.runs.front().name);
    for (const Run& r : e.runs) {
      std::copy_n(bytes.data(), r.count, reinterpret_cast<std::uint8_t*>(r.data));
      bytes = bytes.subspan(r.count);
    }
  }
}

void set_start_value(Component& component, const Variable& v, const std::string& text, int version) {
  const std::string about = "`parameters`: value " + quote(text) + " of " + quote(v.name) + " ";
  if (v.type == Type::binary) {
    const auto bytes = bytes_of_hexadecimal(text);
    if (!bytes) throw Error(about + "is not made of two hexadecimal digits a byte, such as 00ff");
    return component.set_bytes(v.reference, *bytes);
  }
  if (v.type == Type::string && v.size == 1) return component.set_text(v.reference, text);
  if (v.type == Type::string) throw Error(about + "cannot be given: it is an array of texts");
  const bool is_name = v.size == 1 && number_of_name(v, text);  // which may hold blanks
  const std::vector<std::string_view> words = is_name ? std::vector<std::string_view>{text} : split_words(text);
  with_fmi_type(v.type, version, [&](auto zero) {
    std::vector<decltype(zero)> values(words.size());
    for (std::size_t i = 0; i < words.size(); ++i)
      if (const std::string problem = parse(v, words[i], version, values[i]); !problem.empty())
        throw Error(about + problem);
    if (words.size() != v.size)
      throw Error(about + "has " + std::to_string(words.size()) + (words.size() == 1 ? " number" : " numbers") +
                  ", and needs " + std::to_string(v.size) + (v.size > 1 ? " separated by blanks" : ""));
    component.set(v.type, std::span(&v.reference, 1), values.data(), values.size());
  });
}

}  // namespace muro::fmu
