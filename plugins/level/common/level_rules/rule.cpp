// SPDX-License-Identifier: MIT
#include "rule.hpp"

#include <charconv>
#include <cmath>

#include "muro/algorithm.hpp"
#include "muro/base/did_you_mean.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::level {

namespace {

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find(' ', i), text.size());
    if (end > i) words.emplace_back(text.substr(i, end - i));
    i = end + 1;
  }
  return words;
}

[[noreturn]] void reject(std::string_view text, const std::string& why) {
  throw Error(
      "the rule " + quote(text) + " " + why +
      "; a rule is one of: `NAME at SECONDS`, `NAME when nearer than METRES to WHAT` (a robot, an object of the "
      "scenery, a place, or `any` robot), `NAME when farther than METRES from WHAT` (or from `all` robots), `NAME when "
      "inside PLACE`, `NAME when outside PLACE`, `NAME when in contact`, `NAME when out of contact for SECONDS`, "
      "`NAME when slower than FACTOR`, `NAME when faster than FACTOR` (the speed of the run in units of real time; "
      "level.budget only)");
}

double number_in(std::string_view text, const std::string& word) {
  double x = 0;
  const auto [used, code] = std::from_chars(word.data(), word.data() + word.size(), x);
  if (code != std::errc{} || used != word.data() + word.size() || !(x >= 0 && x <= 1e9))
    reject(text, "has " + quote(word) + " where a number from 0 to 1e9 belongs");
  return x;
}

/// Whether the words after the first match the pattern; `#` matches a number, `@` a name.
bool fits(const std::vector<std::string>& words, std::span<const std::string_view> pattern) {
  if (words.size() != pattern.size() + 1) return false;
  for (std::size_t i = 0; i < pattern.size(); ++i)
    if (pattern[i] != "#" && pattern[i] != "@" && words[i + 1] != pattern[i]) return false;
  return true;
}

}  // namespace

Rule parse_rule(std::string_view text, std::span<const std::string> names) {
  const std::vector<std::string> words = words_of(text);
  if (words.empty()) reject(text, "is empty");
  Rule rule;
  const auto name = std::find(names.begin(), names.end(), words[0]);
  if (name == names.end())
    throw Error("the rule " + quote(text) + " begins with " + quote(words[0]) +
                ", but the robot has no motion of this name" + did_you_mean(words[0], names) +
                "; it has: " + quoted_list(names));
  rule.level = std::uint32_t(name - names.begin());
  using Words = std::string_view[];
  constexpr Words at = {"at", "#"}, nearer = {"when", "nearer", "than", "#", "to", "@"},
                  farther = {"when", "farther", "than", "#", "from", "@"}, inside = {"when", "inside", "@"},
                  outside = {"when", "outside", "@"}, in_contact = {"when", "in", "contact"},
                  out_of_contact = {"when", "out", "of", "contact", "for", "#"},
                  slower = {"when", "slower", "than", "#"}, faster = {"when", "faster", "than", "#"};
  const struct {
    Rule::When when;
    std::span<const std::string_view> pattern;
    std::size_t number;  ///< index of the word with the number; 0: none
  } forms[] = {{Rule::When::at, at, 2},
               {Rule::When::nearer, nearer, 4},
               {Rule::When::farther, farther, 4},
               {Rule::When::inside, inside, 0},
               {Rule::When::outside, outside, 0},
               {Rule::When::in_contact, in_contact, 0},
               {Rule::When::out_of_contact, out_of_contact, 6},
               {Rule::When::slower, slower, 4},
               {Rule::When::faster, faster, 4}};
  for (const auto& form : forms) {
    if (!fits(words, form.pattern)) continue;
    rule.when = form.when;
    if (form.number > 0) rule.number = number_in(text, words[form.number]);
    if (rule.when == Rule::When::nearer && words.back() != "any") rule.what = words.back();
    if (rule.when == Rule::When::farther && words.back() != "all") rule.what = words.back();
    if (rule.by_place()) rule.what = words.back();
    return rule;
  }
  reject(text, "is not understood");
}

}  // namespace muro::level
