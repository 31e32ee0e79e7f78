// SPDX-License-Identifier: MIT
#include "recording.hpp"

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <tuple>

#include "muro/algorithm.hpp"
#include "muro/base/input_file.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::inputs {

namespace {

constexpr std::string_view title = "muro external inputs";
constexpr std::string_view version = "1";
constexpr std::string_view columns = "epoch,time,channel,kind,source,bytes";

/// Returns whether a byte is written unchanged: printable ASCII without the characters that the format uses.
bool is_plain(unsigned char c) { return c >= 0x20 && c < 0x7f && c != '%' && c != ','; }

void add_escaped(std::string& out, std::string_view bytes) {
  constexpr char digits[] = "0123456789ABCDEF";
  for (const char byte : bytes) {
    const auto c = static_cast<unsigned char>(byte);
    if (is_plain(c))
      out += byte;
    else
      out += {'%', digits[c >> 4], digits[c & 15]};
  }
}

std::string hexadecimal(std::uint64_t x) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(x));
  return text;
}

/// Splits a line into fields, from left to right.
class Line {
 public:
  Line(const std::string& path, std::size_t number, std::string_view text)
      : path_(path), number_(number), rest_(text), size_(text.size()) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(path_ + ":" + std::to_string(number_) + ":" + std::to_string(size_ - rest_.size() + 1) + ": " + what);
  }
  /// Returns the text up to the next comma, without the comma, or up to the end.
  std::string_view field() {
    const std::size_t comma = rest_.find(',');
    const std::string_view found = rest_.substr(0, comma);
    rest_.remove_prefix(comma == rest_.npos ? rest_.size() : comma + 1);
    return found;
  }
  template <class T>
  T number(const char* name, int base = 10) {
    const Line before = *this;
    const std::string_view text = field();
    T x{};
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), x, base);
    if (code != std::errc{} || end != text.data() + text.size() || text.empty())
      before.fail(std::string(name) + " is " + quote(text) + " but must be a whole number" +
                  (base == 16 ? " in hexadecimal digits" : "") + (std::is_signed_v<T> ? " from 0 on" : ""));
    if constexpr (std::is_signed_v<T>)
      if (x < 0) before.fail(std::string(name) + " is " + quote(text) + " but must be 0 or more");
    return x;
  }
  std::string bytes() {
    const Line before = *this;
    const std::string_view text = field();
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] != '%') {
        out += text[i];
        continue;
      }
      unsigned value = 0;
      const char* digits = text.data() + i + 1;
      if (i + 2 >= text.size() || std::from_chars(digits, digits + 2, value, 16).ptr != digits + 2)
        before.fail("after % there must be two hexadecimal digits");
      out += char(value);
      i += 2;
    }
    return out;
  }
  void end() const {
    if (!rest_.empty()) fail("there is more than the columns " + std::string(columns));
  }

 private:
  const std::string& path_;
  std::size_t number_;
  std::string_view rest_;
  std::size_t size_;
};

void read_header(Line line, Recording& out) {
  if (line.field() != title)
    line.fail("this is no recording of recorder.inputs: it does not begin with `muro external inputs`");
  if (const std::string_view found = line.field(); found != version)
    line.fail("the recording has version " + quote(found) + ", and this muro reads version 1");
  out.initial_hash = line.number<std::uint64_t>("the hash of the state at the start", 16);
  line.end();
}

RunEnd read_end(Line& line) {
  RunEnd end;
  end.epoch = line.number<std::uint64_t>("epoch");
  end.time = line.number<std::int64_t>("time");
  end.robots_hash = line.number<std::uint64_t>("the hash of the state", 16);
  line.end();
  return end;
}

}  // namespace

std::string header_line(std::uint64_t initial_hash) {
  std::string line(title);
  line.append(",").append(version).append(",").append(hexadecimal(initial_hash)).append("\n");
  return line.append(columns).append("\n");
}

void add_line(std::string& out, const RecordedInput& input) {
  out += std::to_string(input.epoch);
  out += ',';
  out += std::to_string(input.time);
  out += ',';
  add_escaped(out, input.channel);
  out += ',';
  out += std::to_string(input.input.kind);
  out += ',';
  out += std::to_string(input.input.source);
  out += ',';
  add_escaped(out, input.input.bytes);
  out += '\n';
}

std::string end_line(const RunEnd& end) {
  std::string line("end,");
  line.append(std::to_string(end.epoch)).append(",").append(std::to_string(end.time)).append(",");
  return line.append(hexadecimal(end.robots_hash)).append("\n");
}

Recording read_recording(const std::string& path) {
  constexpr std::size_t longest_line = 64 << 20;
  InputFile file(path);
  Recording out;
  std::map<std::string, std::string_view> channels;
  std::tuple<std::uint64_t, std::int64_t> last{0, 0};
  std::string text;
  std::size_t number = 0;
  while (file.line(text, longest_line)) {
    Line line(path, ++number, text);
    if (number == 1) {
      read_header(line, out);
      continue;
    }
    if (out.end) line.fail("nothing may follow the line `end`");
    if (text.starts_with("end,")) {
      line.field();
      out.end = read_end(line);
      continue;
    }
    if (number == 2) {
      if (text != columns) line.fail("this line must be `" + std::string(columns) + "`");
      continue;
    }
    if (file.is_cut()) line.fail("the last line is cut short; remove it to replay what is before it");
    RecordedInput input;
    input.epoch = line.number<std::uint64_t>("epoch");
    input.time = line.number<std::int64_t>("time");
    const std::tuple now{input.epoch, input.time};
    if (now < last) line.fail("epoch and time are smaller than those of the line before");
    last = now;
    const std::string channel = line.bytes();
    auto known = channels.find(channel);
    if (known == channels.end()) known = channels.emplace(channel, out.texts.emplace_back(channel)).first;
    input.channel = known->second;
    input.input.kind = line.number<std::uint32_t>("kind");
    input.input.source = line.number<std::uint32_t>("source");
    input.input.bytes = out.texts.emplace_back(line.bytes());
    line.end();
    out.inputs.push_back(input);
  }
  if (number < 2) Line(path, number + 1, "").fail("this is no recording of recorder.inputs: it has no header");
  return out;
}

}  // namespace muro::inputs
