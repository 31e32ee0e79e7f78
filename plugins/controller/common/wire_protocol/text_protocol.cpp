// SPDX-License-Identifier: MIT
// A line for each request and each reply, with fields between blanks; see plugins/controller/joints/README.md.
#include <algorithm>
#include <cmath>

#include "muro/base/did_you_mean.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/wire_protocol/number_text.hpp"
#include "plugins/controller/common/wire_protocol/protocol.hpp"

namespace muro::wire {

namespace {

struct Word {
  std::string_view word;
  Verb verb;
  Quantity quantity = Quantity::standard;
};
constexpr Word words[] = {{"info", Verb::info},
                          {"get", Verb::get},
                          {"set", Verb::set},
                          {"position", Verb::set, Quantity::position},
                          {"velocity", Verb::set, Quantity::velocity},
                          {"acceleration", Verb::set, Quantity::acceleration},
                          {"effort", Verb::set, Quantity::effort},
                          {"stop", Verb::stop},
                          {"wait", Verb::wait},
                          {"report", Verb::report},
                          {"time", Verb::time}};

/// The fields of a request, one after the other.
class Fields {
 public:
  explicit Fields(std::string_view line) { split_fields(line, all_); }
  bool empty() const { return next_ == all_.size(); }
  std::string_view take() { return all_[next_++]; }
  /// `usage`: syntax of the request.
  std::string_view require(const char* usage) {
    if (empty()) throw Fault{FaultCode::wrong_fields, std::string("a field is missing: ").append(usage)};
    return take();
  }
  void require_end(const char* usage) {
    if (!empty())
      throw Fault{FaultCode::wrong_fields, quote(all_[next_]).append(" is a field too many: ").append(usage)};
  }

 private:
  std::vector<std::string_view> all_;
  std::size_t next_ = 0;
};

const Word& find_word(std::string_view text) {
  for (const Word& w : words)
    if (w.word == text) return w;
  std::vector<std::string> known;
  for (const Word& w : words) known.emplace_back(w.word);
  std::string all;
  for (const std::string& k : known) all.append(all.empty() ? "" : " ").append(k);
  throw Fault{FaultCode::unknown_request,
              "no request " + quote(text) + did_you_mean(text, known) + "; there are: " + all};
}

std::uint32_t find_group(std::string_view text, std::span<const std::string> groups) {
  const auto found = std::find(groups.begin(), groups.end(), text);
  if (found == groups.end())
    throw Fault{FaultCode::unknown_group,
                "no group " + quote(text) + did_you_mean(text, groups) + "; there are: " + quoted_list(groups)};
  return std::uint32_t(found - groups.begin());
}

Quantity find_quantity(std::string_view text) {
  const auto* const found = std::find(std::begin(quantity_names), std::end(quantity_names), text);
  if (found == std::end(quantity_names))
    throw Fault{FaultCode::unknown_quantity, quote(text) + " is none of " + quoted_list(quantity_names)};
  return Quantity(found - std::begin(quantity_names));
}

/// Reads "[GROUP [QUANTITY]]" up to the end of the line.
void read_place(Fields& fields, std::span<const std::string> groups, const char* usage, Request& out) {
  if ((out.names_group = !fields.empty())) out.group = find_group(fields.take(), groups);
  if (!fields.empty()) out.quantity = find_quantity(fields.take());
  fields.require_end(usage);
}

std::int64_t read_duration(std::string_view text) {
  const double nanoseconds = std::round(1e9 * read_number(text));
  if (!(nanoseconds >= 0 && nanoseconds <= double(longest_duration)))
    throw Fault{FaultCode::out_of_range, quote(text) + " is no time to wait; allowed is 0 to 1e9 s"};
  return std::int64_t(nanoseconds);
}

double read_period(std::string_view text) {
  const double rate = read_number(text);
  if (rate == 0) return 0;
  if (!(rate >= 1e-9 && rate <= 1e9))
    throw Fault{FaultCode::out_of_range, quote(text) + " is no rate; allowed is 0 (no reports) or 1e-9 to 1e9 Hz"};
  return 1e9 / rate;
}

class TextProtocol final : public Protocol {
 public:
  stream::Framing framing() const override { return {.size_of_first = stream::line_size, .longest = 65536}; }
  std::size_t most_values() const override { return 1 << 20; }

  bool read(std::string_view line, std::span<const std::string> groups, Request& r) const override {
    while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.remove_suffix(1);
    Fields fields(line);
    if (fields.empty()) return false;
    const Word& word = find_word(fields.take());
    r.verb = word.verb;
    r.quantity = word.quantity;
    switch (r.verb) {
      case Verb::info:
        read_place(fields, groups, "info [GROUP [QUANTITY]]", r);
        break;
      case Verb::get:
        read_place(fields, groups, "get [GROUP [QUANTITY]]", r);
        break;
      case Verb::set:
        r.group = find_group(fields.require("set GROUP NUMBER..."), groups);
        while (!fields.empty()) r.values.push_back(read_number(fields.take()));
        break;
      case Verb::stop:
        if ((r.names_group = !fields.empty())) r.group = find_group(fields.take(), groups);
        fields.require_end("stop [GROUP]");
        break;
      case Verb::wait:
        if (!fields.empty()) r.duration = read_duration(fields.take());
        read_place(fields, groups, "wait [SECONDS [GROUP [QUANTITY]]]", r);
        break;
      case Verb::report:
        r.period = read_period(fields.require("report RATE [GROUP [QUANTITY]]"));
        read_place(fields, groups, "report RATE [GROUP [QUANTITY]]", r);
        break;
      case Verb::time:
        fields.require_end("time");
        break;
    }
    return true;
  }

  void add_ok(std::string& out, Tag, std::int64_t time) const override { add_timed(out, "ok ", time); }
  void add_time(std::string& out, Tag, std::int64_t time) const override { add_timed(out, "time ", time); }
  void add_info(std::string& out, Tag, std::string_view text) const override {
    out.append("info ").append(text).append(1, '\n');
  }
  void add_state(std::string& out, Tag, const State& s) const override {
    out += "state ";
    add_seconds(out, s.time);
    add_values(out, s);
  }
  void add_report(std::string& out, Tag, const State& s, std::string_view group) const override {
    out += "report ";
    add_seconds(out, s.time);
    out.append(1, ' ').append(group);
    add_values(out, s);
  }
  void add_fault(std::string& out, Tag, std::int64_t, const Fault& f) const override {
    out.append("error ").append(std::to_string(int(f.code))).append(1, ' ').append(f.text).append(1, '\n');
  }

 private:
  static void add_timed(std::string& out, const char* word, std::int64_t time) {
    out += word;
    add_seconds(out, time);
    out += '\n';
  }
  static void add_values(std::string& out, const State& s) {
    for (const double v : s.values) {
      out += ' ';
      add_number(out, v);
    }
    out += '\n';
  }
};

}  // namespace

const Protocol& text_protocol() {
  static const TextProtocol protocol;
  return protocol;
}

}  // namespace muro::wire
