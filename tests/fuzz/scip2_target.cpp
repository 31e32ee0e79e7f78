// SPDX-License-Identifier: MIT
// Bytes of clients of controller.scip2.
#include <algorithm>
#include <string>
#include <vector>

#include "plugins/controller/scip2/device.hpp"
#include "tests/fuzz/target.hpp"

namespace muro::fuzz {

namespace {

using namespace scip2;

/// A device whose client writes line by line while time passes.
class Scanner final : public DeviceHost {
 public:
  explicit Scanner(const Model& model) : device_(model), memory_(device_.state_size() / 8 + 1) { advance(0); }

  void write(std::string_view line) {
    device_.receive(state(), 1, line, *this);
    ++lines_;
    advance(line.size() % 16);
  }
  void end() {
    for (int i = 0; i < 20; ++i) advance(30);
    require(answers_ == lines_, "a line has no answer, or two");
  }

  void send(std::uint32_t, std::string_view bytes) override {
    const auto ends = [&](std::string_view end) {
      return bytes.size() >= end.size() && bytes.substr(bytes.size() - end.size()) == end;
    };
    require(ends("\n\n"), "a reply does not end with an empty line");
    std::size_t lines = 0;
    for (std::size_t begin = 0; begin < bytes.size(); ++lines) {
      const std::size_t end = bytes.find('\n', begin);
      require(end - begin <= 66, "a line is too long");
      begin = end + 1;
    }
    require(lines >= 3, "a reply lacks echo or status");
    // the command and its status, with letters instead of digits, because outcomes ignore digits
    std::string said(bytes.substr(0, 2));
    for (const char c : bytes.substr(bytes.find('\n') + 1, 2)) said += c >= '0' && c <= '9' ? char(c - '0' + 'a') : c;
    outcome(said);
  }
  void read_scan(std::span<std::uint32_t> distances, std::span<std::uint32_t> intensities) override {
    for (std::size_t i = 0; i < distances.size(); ++i) distances[i] = std::uint32_t(i * 7919 % 70000);
    std::fill(intensities.begin(), intensities.end(), 300000u);
  }
  void answered() override { ++answers_; }

 private:
  State& state() { return *reinterpret_cast<State*>(memory_.data()); }
  void advance(std::int64_t milliseconds) {
    time_ += milliseconds * 1'000'000;
    device_.advance(state(), time_, *this);
  }

  Device device_;
  std::vector<std::uint64_t> memory_;
  std::int64_t time_ = 0;
  std::size_t lines_ = 0, answers_ = 0;
};

void converse(const Model& model, std::string_view text) {
  Scanner scanner(model);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    scanner.write(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  scanner.end();
}

}  // namespace

void read_as_scip2(Bytes bytes) {
  Model urg = urg_04lx();
  urg.firmware = "3.3.00(01/Jan./2008)";
  apply_firmware(urg);
  Model utm = utm_30lx();
  utm.has_multiecho = utm.has_states = true;
  converse(urg, text_of(bytes));
  converse(utm, text_of(bytes));
}

}  // namespace muro::fuzz
