// SPDX-License-Identifier: MIT
// Bytes that a Hokuyo scanner has sent: replies to GD, GS, GE, MD, MS and ME and, if they were requested, to PP and VV.
// Hokuyo, Communication Protocol Specification for SCIP2.0, C-42-03320B.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <string_view>

#include "host/tools/compare/scan_text.hpp"

namespace muro::host {

namespace {

/// Returns the sum character that follows `content` in a line.
char sum_of(std::string_view content) {
  unsigned sum = 0;
  for (const char c : content) sum += static_cast<unsigned char>(c);
  return char((sum & 0x3f) + 0x30);
}

std::optional<std::int64_t> digits_in(std::string_view text) {
  std::int64_t value = 0;
  if (text.empty() || text.size() > 9) return std::nullopt;
  for (const char c : text) {
    if (c < '0' || c > '9') return std::nullopt;
    value = 10 * value + (c - '0');
  }
  return value;
}

constexpr double mm_per_m = 1000;

/// The steps that a measuring command requests.
struct Window {
  std::int64_t start = 0, end = 0, cluster = 1;
  std::size_t characters = 3;    ///< of a value
  bool has_intensities = false;  ///< ME and GE: an intensity of as many characters follows each value
  bool is_repeated = false;      ///< MD, MS or ME: the echo also has an interval and a count

  std::size_t values() const { return std::size_t((end - start) / cluster + 1); }
  std::size_t stride() const { return has_intensities ? 2 * characters : characters; }
  bool operator==(const Window& o) const { return start == o.start && end == o.end && cluster == o.cluster; }
};

/// Returns the window of a measuring command; nothing when `line` is none.
std::optional<Window> window_in(std::string_view line) {
  line = line.substr(0, line.find(';'));
  if (line.size() < 2 || (line[0] != 'G' && line[0] != 'M') || std::string_view("DSE").find(line[1]) > 2)
    return std::nullopt;
  Window w;
  w.is_repeated = line[0] == 'M';
  w.characters = line[1] == 'S' ? 2 : 3;
  w.has_intensities = line[1] == 'E';
  if (line.size() != (w.is_repeated ? 15u : 12u) || !digits_in(line.substr(2, 9))) return std::nullopt;
  const auto start = digits_in(line.substr(2, 4)), end = digits_in(line.substr(6, 4)),
             cluster = digits_in(line.substr(10, 2));
  if (!start || !end || !cluster || *end < *start) return std::nullopt;
  w.start = *start, w.end = *end, w.cluster = std::max<std::int64_t>(*cluster, 1);
  return w;
}

class ScipReader {
 public:
  ScipReader(const std::string& text, const std::string& name) : rest_(text) { record_.name = name; }

  ScanRecord read() {
    while (next_line()) {
      if (line_.empty()) continue;
      if (const std::optional<Window> w = window_in(line_))
        is_at_command_ = true, read_reply(*w);
      else if (line_.find(':') == 4)
        is_at_command_ = true, read_entry();
      else if (is_other_line())
        is_at_command_ = is_at_command_ || line_.size() > 3;
      else if (!is_at_command_)
        ++skipped_;  // line of a reply that had begun before
      else
        throw error(0, "this is no line of SCIP 2.0; a record is what the scanner has sent, byte by byte");
    }
    finish();
    return std::move(record_);
  }

 private:
  SetupError error(std::size_t column, const std::string& what) const {
    return record_error(record_.name, {number_, column + 1}, what);
  }

  bool next_line() {
    if (rest_.empty()) return false;
    ++number_;
    const std::size_t end = rest_.find('\n');
    is_whole_ = end != std::string_view::npos;
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(is_whole_ ? end + 1 : rest_.size());
    while (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
    return true;
  }

  /// Returns the line without its sum.
  std::string_view checked() const {
    const std::string_view content = line_.substr(0, line_.size() - 1);
    if (line_.size() >= 2 && line_.back() == sum_of(content)) return content;
    throw error(line_.empty() ? 0 : line_.size() - 1,
                "the sum of this line does not fit what stands before it; a byte was changed or lost");
  }

  /// Whether the line is a command, its state, or a line of SCIP 1.1.
  bool is_other_line() const {
    if (line_.size() <= 3) return true;
    for (const std::string_view command :
         {"SCIP2.0", "VV", "PP", "II", "BM", "QT", "RS", "RT", "RB", "TM", "SS", "CR", "HS", "DB", "%ST", "%SL"})
      if (line_.starts_with(command)) return true;
    return false;
  }

  /// Reads `KEY:value;S`; without a sum in SCIP 1.1.
  void read_entry() {
    const std::size_t end = line_.rfind(';');
    if (end == std::string_view::npos) return;
    if (line_.size() != end + 2 || line_.back() != sum_of(line_.substr(0, end)))
      throw error(end, "the sum of this line does not fit what stands before it; a byte was changed or lost");
    const std::string_view key = line_.substr(0, 4), value = line_.substr(5, end - 5);
    if (key == "MODL" || (key == "PROD" && record_.scanner.empty())) record_.scanner = value;
    const std::pair<std::string_view, std::int64_t*> known[] = {
        {"DMIN", &least_}, {"DMAX", &most_}, {"ARES", &steps_per_turn_}, {"AFRT", &front_}};
    for (const auto& [name, to] : known) {
      if (key != name) continue;
      const std::optional<std::int64_t> number = digits_in(value);
      if (!number || (*number == 0 && to != &front_))
        throw error(5, fmt::format("`{}` is `{}`, which is no number that it can be", key, value.substr(0, 20)));
      *to = *number;
      has_parameters_ = true;
    }
  }

  /// Reads the reply after the echo of a measuring command; `line_` is the echo.
  void read_reply(Window window) {
    std::size_t echo_line = number_;
    if (!next_line()) return cut_off();
    while (const std::optional<Window> again = window_in(line_)) {  // the request comes before its echo
      window = *again, echo_line = number_;
      if (!next_line()) return cut_off();
    }
    if (line_.size() != 3) throw error(0, "the state of the reply is expected here: two characters and their sum");
    const std::string_view state = checked();
    const bool has_data = state == (window.is_repeated ? "99" : "00");
    if (!has_data) {
      if (state != "00") ++refused_;
      return;
    }
    if (!record_.ranges.empty() && !(window == window_))
      throw record_error(
          record_.name, {echo_line, 1},
          fmt::format("this scan has the steps {} to {} by {}, and those before have {} to {} by {}; "
                      "all of a record are of the same",
                      window.start, window.end, window.cluster, window_.start, window_.end, window_.cluster));
    window_ = window;
    if (!next_line()) return cut_off();
    if (!is_whole_) return cut_off();
    checked();  // the time stamp is not used: the order identifies the scans
    std::string data;
    for (;;) {
      if (!next_line()) return cut_off();
      if (line_.empty()) break;
      if (!is_whole_) return cut_off();
      const std::string_view block = checked();
      for (std::size_t i = 0; i < block.size(); ++i)
        if (block[i] < '0' || block[i] > 'o')
          throw error(i, "a character of data is between `0` and `o` (SCIP 2.0: a value is its codes less 0x30)");
      data += block;
    }
    if (data.size() != window.values() * window.stride())
      throw record_error(record_.name, {echo_line, 1},
                         fmt::format("this scan has {} characters of data; its steps need {}", data.size(),
                                     window.values() * window.stride()));
    add_scan(data, window);
  }

  void cut_off() { is_cut_off_ = true; }

  void add_scan(const std::string& data, const Window& window) {
    std::vector<double> ranges;
    for (std::size_t at = 0; at < data.size(); at += window.stride()) {
      std::int64_t value = 0;
      for (std::size_t k = 0; k < window.characters; ++k) value = value * 64 + (data[at + k] - 0x30);
      values_.push_back(value);
      ranges.push_back(double(value) / mm_per_m);
    }
    record_.ranges.push_back(std::move(ranges));
  }

  /// Completes the record when everything has been read: values below DMIN and above DMAX are codes.
  void finish() {
    if (record_.ranges.empty())
      throw SetupError(record_.name + ": there is no whole scan in it; a record has the replies to MD, MS, GD or GS");
    constexpr std::int64_t last_step_of_urg = 768;
    if (!has_parameters_ && window_.end > last_step_of_urg)
      throw SetupError(
          fmt::format("{}: steps up to {} are none of a URG-04LX; record the reply to PP, too, which says "
                      "what the scanner is",
                      record_.name, window_.end));
    if (!has_parameters_)
      record_.notes.push_back(record_.name + ": it has no reply to PP, so the steps are taken for those of a URG-04LX");
    if (least_ >= most_)
      throw SetupError(
          fmt::format("{}: by its reply to PP the scanner measures from {} mm to {} mm (DMIN, DMAX); the "
                      "first is to be less",
                      record_.name, least_, most_));
    if (skipped_ > 0)
      record_.notes.push_back(
          fmt::format("{}: it begins in the middle of a reply; {} lines are left out", record_.name, skipped_));
    if (is_cut_off_) record_.notes.push_back(record_.name + ": its last scan is cut off, and left out");
    if (refused_ > 0)
      record_.notes.push_back(fmt::format("{}: the scanner has refused {} commands", record_.name, refused_));
    for (const std::int64_t v : values_)
      if (v < least_ || v > most_) ++record_.codes[std::uint32_t(v)];
    record_.range_min = double(least_) / mm_per_m, record_.range_max = double(most_) / mm_per_m;
    const double step = 2 * std::numbers::pi / double(steps_per_turn_);
    for (std::size_t i = 0; i < window_.values(); ++i) {
      const auto first = double(window_.start + std::int64_t(i) * window_.cluster);
      record_.angles.push_back((first + 0.5 * double(window_.cluster - 1) - double(front_)) * step);
    }
    record_.limit(record_.range_min - 1e-9, record_.range_max + 1e-9);
  }

  std::string_view rest_, line_;
  bool is_whole_ = true;  ///< the line has its line end
  std::size_t number_ = 0;
  ScanRecord record_;
  Window window_;
  std::vector<std::int64_t> values_;
  std::int64_t least_ = 20, most_ = 5600, steps_per_turn_ = 1024, front_ = 384;
  bool has_parameters_ = false, is_cut_off_ = false;
  bool is_at_command_ = false;  ///< a command or its echo has been read
  std::size_t refused_ = 0, skipped_ = 0;
};

}  // namespace

ScanRecord parse_scip_record(const std::string& text, const std::string& name) { return ScipReader(text, name).read(); }

}  // namespace muro::host
