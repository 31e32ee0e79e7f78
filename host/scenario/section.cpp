// SPDX-License-Identifier: MIT
#include "host/scenario/section.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "muro/nearest.hpp"

namespace muro::host {

namespace {

std::string shown(const Node& n) {
  switch (n.kind) {
    case Node::Kind::null: return "nothing";
    case Node::Kind::scalar: return "`" + n.scalar + "`";
    case Node::Kind::list: return "a list of " + std::to_string(n.list.size());
    case Node::Kind::map: return "a map";
  }
  return "";
}

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

}  // namespace

void Problems::add(const std::string& line) {
  if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
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
  std::vector<double> values;
  bool fine = n->kind == Node::Kind::list && lengths.count(n->list.size()) > 0;
  for (const Node& e : n->list) {
    const auto x = as_number(e);
    fine = fine && x.has_value();
    values.push_back(x.value_or(0));
  }
  if (fine) return values;
  std::string allowed;
  for (const std::size_t l : lengths) allowed += (allowed.empty() ? "" : " or ") + std::to_string(l);
  problem(key, "is " + shown(*n) + " but must be a list of " + allowed + " numbers");
  return std::nullopt;
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
  std::string allowed;
  for (const std::string& k : known) allowed += (allowed.empty() ? "" : ", ") + k;
  for (const auto& [key, unused] : others())
    problems_.add(key_location(key), what_ + " has no key `" + key + "`" + did_you_mean(key, known) + "; allowed: " + allowed);
}

}  // namespace muro::host
