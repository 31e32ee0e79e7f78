// SPDX-License-Identifier: MIT
#include "value_text.hpp"

#include <charconv>
#include <cmath>
#include <cstring>

#include "number.hpp"
#include "plugins/common/model_file/numbers.hpp"
#include "plugins/common/text/counted.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::fmu {

namespace {

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

/// Returns the number of a word that names a Boolean or an enumeration item; nothing for any other word.
std::optional<std::int64_t> number_of_name(const Variable& v, std::string_view word) {
  if (v.type == Type::boolean && (word == "true" || word == "false")) return word == "true" ? 1 : 0;
  if (!v.items) return std::nullopt;
  for (const auto& [name, value] : *v.items)
    if (name == word) return value;
  return std::nullopt;
}

/// Returns the words that a variable allows besides numbers, as the end of a sentence.
std::string names_for(const Variable& v) {
  if (v.type == Type::boolean) return ", or true or false";
  if (!v.items) return "";
  std::vector<std::string_view> names;
  for (const auto& [name, value] : *v.items) names.push_back(name);
  return "; items of its type are " + quoted_list(names);
}

/// Reads the number of a word; integers of 64 bits are exact. Returns "" or the problem with it.
template <class T>
std::string parse(const Variable& v, std::string_view word, int version, T& result) {
  const auto is_fine = [&] { return v.type != Type::boolean || result == T(0) || result == T(1); };
  if constexpr (std::is_integral_v<T>) {
    const char* const end = word.data() + word.size();
    if (const auto read = std::from_chars(word.data(), end, result);
        read.ec == std::errc() && read.ptr == end && is_fine())
      return "";
  }
  std::string problem;
  const auto number = model_file::parse_numbers(word, 1, problem);
  const bool is_legal = number && (!std::is_integral_v<T> || number->front() == std::nearbyint(number->front()));
  if (is_legal && convert(number->front(), result) && is_fine()) return "";
  const auto named = number_of_name(v, word);  // names of items may be digits: a valid number comes first
  if (named && convert(*named, result)) return "";
  if (!number && !named) return problem + names_for(v);
  return "does not fit into its type, " + std::string(name_of(v.type, version));
}

}  // namespace

std::string read_numbers(const Variable& v, std::string_view text, int version, std::vector<std::byte>& bytes) {
  const bool is_name = v.size == 1 && number_of_name(v, text);  // such a name may contain blanks
  const std::vector<std::string_view> words = is_name ? std::vector<std::string_view>{text} : split_words(text);
  return with_fmi_type(v.type, version, [&](auto zero) -> std::string {
    bytes.resize(words.size() * sizeof zero);
    for (std::size_t i = 0; i < words.size(); ++i) {
      auto number = zero;
      if (const std::string problem = parse(v, words[i], version, number); !problem.empty()) return problem;
      std::memcpy(bytes.data() + i * sizeof number, &number, sizeof number);
    }
    if (words.size() == v.size) return "";
    return "has " + counted(words.size(), "number") + ", and needs " + std::to_string(v.size) +
           (v.size > 1 ? " separated by blanks" : "");
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

}  // namespace muro::fmu
