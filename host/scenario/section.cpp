// SPDX-License-Identifier: MIT
#include "host/scenario/section.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "muro/toolkit/did_you_mean.hpp"

namespace muro::host {

namespace {

std::string plain(double x) {
  std::ostringstream out;
  out << x;
  return out.str();
}

std::string bounds(double least, double most) {
  const bool low = least > -1e299, high = most < 1e299;
  if (low && high) return " from " + plain(least) + " to " + plain(most);
  if (low) return " of at least " + plain(least);
  if (high) return " of at most " + plain(most);
  return "";
}

std::string ordinal(std::size_t n) {
  const bool teen = n / 10 % 10 == 1;
  const char* ending = teen || n % 10 > 3 || n % 10 == 0 ? "th" : (n % 10 == 1 ? "st" : (n % 10 == 2 ? "nd" : "rd"));
  return std::to_string(n) + ending;
}

const Node nothing;

}  // namespace

std::string shown(const Node& n) {
  switch (n.kind) {
    case Node::Kind::null:
      return "nothing";
    case Node::Kind::list:
      return "a list of " + std::to_string(n.list.size());
    case Node::Kind::map:
      return "a map";
    case Node::Kind::scalar:
      break;
  }
  Node plain = n;
  plain.quoted = false;
  return "`" + n.scalar + "`" + (n.quoted && as_number(plain) ? " in quotes, which makes it a text," : "");
}

std::string listed(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& n : names) all += (all.empty() ? "" : ", ") + n;
  return all;
}

bool check_name(const std::string& name, const Location& at, const std::string& what, Problems& problems) {
  const bool fine = !name.empty() && std::none_of(name.begin(), name.end(), [](unsigned char c) {
    return c == '/' || c == ':' || std::isspace(c) || std::iscntrl(c);
  });
  if (!fine)
    problems.add(at, "`" + name + "` cannot be the name of " + what +
                         ": a name is not empty and has no `/`, `:` or white space");
  return fine;
}

void Problems::add(const std::string& line) {
  if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
}

bool Problems::collect(const std::string& prefix, const std::function<void()>& work) {
  try {
    work();
    return true;
  } catch (const SetupError& e) {
    std::istringstream lines(e.what());
    for (std::string line; std::getline(lines, line);) add(prefix + line);
    return false;
  }
}

void Problems::check() const {
  if (!lines_.empty()) throw SetupError(lines_);
}

std::optional<double> as_number(const Node& n) {
  if (n.kind != Node::Kind::scalar || n.quoted || n.scalar.empty()) return std::nullopt;
  const char* first = n.scalar.data() + (n.scalar.front() == '+' ? 1 : 0);
  const char* last = n.scalar.data() + n.scalar.size();
  double x = 0;
  const auto [end, code] = std::from_chars(first, last, x);
  if (code != std::errc{} || end != last || !std::isfinite(x)) return std::nullopt;
  return x;
}

std::optional<ParameterInput> as_parameter(const Node& n) {
  if (n.kind == Node::Kind::list) {
    std::vector<double> numbers;
    std::vector<std::string> texts;
    for (const Node& e : n.list) {
      if (e.kind != Node::Kind::scalar) return std::nullopt;
      if (const auto x = as_number(e)) numbers.push_back(*x);
      texts.push_back(e.scalar);
    }
    if (!numbers.empty() && numbers.size() == texts.size()) return numbers;
    return texts;
  }
  if (n.kind != Node::Kind::scalar) return std::nullopt;
  if (const auto x = as_number(n)) {
    if (*x == std::floor(*x) && std::abs(*x) < 1e15 && n.scalar.find_first_of(".eE") == std::string::npos)
      return static_cast<std::int64_t>(*x);
    return *x;
  }
  if (!n.quoted && (n.scalar == "true" || n.scalar == "on" || n.scalar == "yes")) return true;
  if (!n.quoted && (n.scalar == "false" || n.scalar == "off" || n.scalar == "no")) return false;
  return n.scalar;
}

Section::Section(const Node& node, std::string what, Problems& problems)
    : node_(node), what_(std::move(what)), problems_(problems) {
  if (node.kind != Node::Kind::map && node.kind != Node::Kind::null)
    problems.add(node.location, what_ + " must be a map of `key: value` pairs, not " + shown(node));
}

const Node* Section::find(const std::string& key) {
  asked_.push_back(key);
  return node_.find(key);
}

Location Section::key_location(const std::string& key) const {
  for (std::size_t i = 0; i < node_.map.size(); ++i)
    if (node_.map[i].first == key) return node_.key_locations[i];
  return node_.location;
}

void Section::problem(const std::string& key, const std::string& text) {
  const Node* n = node_.find(key);
  problems_.add(n ? n->location : node_.location, "`" + key + "` of " + what_ + " " + text);
}

std::string Section::text(const std::string& key, const std::string& otherwise) {
  const Node* n = find(key);
  if (!n) return otherwise;
  if (n->kind == Node::Kind::scalar) return n->scalar;
  problem(key, "must be a text, not " + shown(*n));
  return otherwise;
}

const Node& Section::part(const std::string& key, Node::Kind kind, const char* wanted) {
  const Node* n = find(key);
  if (!n || n->kind == Node::Kind::null) return nothing;
  if (n->kind == kind) return *n;
  problem(key, "is " + shown(*n) + " but must be " + wanted);
  return nothing;
}

const Node& Section::map(const std::string& key) { return part(key, Node::Kind::map, "a map of `key: value` pairs"); }
const Node& Section::list(const std::string& key) { return part(key, Node::Kind::list, "a list"); }

std::optional<std::string> Section::one_of(const std::vector<std::string>& keys) {
  std::vector<std::string> there;
  for (const std::string& k : keys)
    if (has(k)) there.push_back(k);
  if (there.size() == 1 || node_.kind != Node::Kind::map)
    return there.empty() ? std::nullopt : std::optional(there.front());
  if (there.empty() && others().empty())
    problems_.add(node_.location, what_ + " needs one of: " + listed(keys));
  else if (there.empty())
    close();
  else
    problems_.add(key_location(there[1]), what_ + " has " + listed(there) + "; only one of them is allowed");
  return std::nullopt;
}

double Section::number(const std::string& key, double otherwise, double least, double most) {
  const Node* n = find(key);
  if (!n) return otherwise;
  const auto x = as_number(*n);
  if (x && *x >= least && *x <= most) return *x;
  problem(key, "is " + shown(*n) + " but must be a number" + bounds(least, most));
  return otherwise;
}

std::int64_t Section::integer(const std::string& key, std::int64_t otherwise, std::int64_t least, std::int64_t most) {
  const Node* n = find(key);
  if (!n) return otherwise;
  const auto x = as_number(*n);
  if (x && *x == std::floor(*x) && *x >= double(least) && *x <= double(most)) return std::int64_t(*x);
  problem(key, "is " + shown(*n) + " but must be a whole number" + bounds(double(least), double(most)));
  return otherwise;
}

std::optional<std::vector<double>> Section::numbers(const std::string& key, const std::set<std::size_t>& lengths) {
  const Node* n = find(key);
  if (!n) return std::nullopt;
  std::string allowed;
  for (const std::size_t l : lengths) allowed += (allowed.empty() ? " of " : " or ") + std::to_string(l);
  allowed = "a list" + allowed + " numbers";
  if (lengths.empty()) allowed = "a list of numbers";
  if (n->kind != Node::Kind::list || (!lengths.empty() && lengths.count(n->list.size()) == 0)) {
    problem(key, "is " + shown(*n) + " but must be " + allowed);
    return std::nullopt;
  }
  std::vector<double> values;
  for (const Node& e : n->list) {
    if (const auto x = as_number(e))
      values.push_back(*x);
    else
      problems_.add(e.location, "`" + key + "` of " + what_ + " must be " + allowed + ", but its " +
                                    ordinal(std::size_t(&e - n->list.data()) + 1) + " is " + shown(e));
  }
  if (values.size() != n->list.size()) return std::nullopt;
  return values;
}

Vec3 Section::vector(const std::string& key, const Vec3& otherwise) {
  const auto v = numbers(key, {3});
  return v ? Vec3((*v)[0], (*v)[1], (*v)[2]) : otherwise;
}

std::vector<std::pair<std::string, const Node*>> Section::others() const {
  std::vector<std::pair<std::string, const Node*>> all;
  for (const auto& [key, value] : node_.map)
    if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) all.emplace_back(key, &value);
  return all;
}

void Section::close() {
  std::vector<std::string> known = asked_;
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  for (const auto& [key, unused] : others())
    problems_.add(key_location(key),
                  what_ + " has no key `" + key + "`" + did_you_mean(key, known) + "; allowed: " + listed(known));
}

}  // namespace muro::host
