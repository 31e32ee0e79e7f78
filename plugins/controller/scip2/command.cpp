// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <algorithm>

namespace muro::scip2 {

namespace {

struct Form {
  std::string_view symbol;
  Command command;
  std::size_t digits;  ///< total digits of all parameters
};

constexpr Form forms[] = {
    {"VV", Command::VV, 0},  {"PP", Command::PP, 0},  {"II", Command::II, 0},  {"BM", Command::BM, 0},
    {"QT", Command::QT, 0},  {"RS", Command::RS, 0},  {"RT", Command::RT, 0},  {"RB", Command::RB, 0},
    {"TM", Command::TM, 1},  {"SS", Command::SS, 6},  {"CR", Command::CR, 2},  {"HS", Command::HS, 1},
    {"DB", Command::DB, 2},  {"GD", Command::GD, 10}, {"GS", Command::GS, 10}, {"GE", Command::GE, 10},
    {"HD", Command::HD, 10}, {"HE", Command::HE, 10}, {"MD", Command::MD, 13}, {"MS", Command::MS, 13},
    {"ME", Command::ME, 13}, {"ND", Command::ND, 13}, {"NE", Command::NE, 13}, {"%ST", Command::ST, 0},
    {"%SL", Command::SL, 0},
};

constexpr std::uint32_t bit_rates[] = {19200, 38400, 57600, 115200, 250000, 500000, 750000};

bool has(const Model& m, Command c) {
  switch (c) {
    case Command::HS:
      return m.has_high_sensitivity;
    case Command::DB:
      return m.has_malfunctions;
    case Command::GE:
    case Command::ME:
      return m.has_intensity;
    case Command::HD:
    case Command::ND:
      return m.has_multiecho;
    case Command::HE:
    case Command::NE:
      return m.has_multiecho && m.has_intensity;
    case Command::RT:
    case Command::RB:
      return m.has_restarts;
    case Command::ST:
    case Command::SL:
      return m.has_states;
    default:
      return true;
  }
}

bool is_permitted(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         std::string_view(" ._+@").find(c) != std::string_view::npos;
}

/// Returns false when there are other characters than digits.
bool read_number(std::string_view digits, std::uint32_t& number) {
  number = 0;
  for (const char c : digits) {
    if (c < '0' || c > '9') return false;
    number = number * 10 + std::uint32_t(c - '0');
  }
  return true;
}

std::string_view read_window(std::string_view digits, const Model& model, Request& r) {
  if (!read_number(digits.substr(0, 4), r.window.start)) return "01";
  if (!read_number(digits.substr(4, 4), r.window.end)) return "02";
  if (!read_number(digits.substr(8, 2), r.window.cluster)) return "03";
  if (is_scanning(r.command)) {
    if (!read_number(digits.substr(10, 1), r.interval)) return "06";
    if (!read_number(digits.substr(11, 2), r.count)) return "07";
  }
  if (r.window.end > std::uint32_t(model.last_measurement_point())) return "04";
  if (r.window.end < r.window.start) return "05";
  r.window.cluster = std::max(r.window.cluster, 1u);
  return "00";
}

std::string_view check_value(const Model& model, const Request& r) {
  switch (r.command) {
    case Command::TM:
      return r.value <= 2 ? "00" : "01";
    case Command::SS:
      if (!model.has_bit_rate) return "04";
      return std::find(std::begin(bit_rates), std::end(bit_rates), r.value) != std::end(bit_rates) ? "00" : "02";
    case Command::CR:
      if (!model.has_motor_speed) return "04";
      return r.value <= 10 || r.value == 99 ? "00" : "02";
    case Command::HS:
      return r.value <= 1 ? "00" : "01";
    case Command::DB:
      return (r.value >= 1 && r.value <= 5) || r.value == 10 ? "00" : "01";
    default:
      return "00";
  }
}

std::string_view read_parameters(std::string_view digits, const Model& model, Request& r) {
  if (is_single_scan(r.command) || is_scanning(r.command)) return read_window(digits, model, r);
  if (!read_number(digits, r.value)) return "01";
  return check_value(model, r);
}

}  // namespace

bool is_single_scan(Command c) { return c >= Command::GD && c <= Command::HE; }
bool is_scanning(Command c) { return c >= Command::MD && c <= Command::NE; }

Request parse(std::string_view line, const Model& model) {
  Request r;
  const auto refused = [&](std::string_view status) {
    r.status = status;
    return r;
  };
  if (line.size() < 2) return refused("0D");
  if (line == "SCIP2.0") {
    r.command = Command::scip2;
    return r;
  }
  const auto begins_line = [&](const Form& f) { return f.symbol == line.substr(0, f.symbol.size()); };
  const auto form = std::find_if(std::begin(forms), std::end(forms), begins_line);
  if (form == std::end(forms)) return refused("0E");
  if (!has(model, form->command)) return refused(form->command == Command::HS ? "0C" : "0E");
  r.command = form->command;
  const std::size_t semicolon = line.find(';');
  const std::string_view digits = line.substr(0, semicolon).substr(form->symbol.size());
  if (digits.size() < form->digits) return refused(digits.empty() ? "0C" : "0F");
  if (digits.size() > form->digits) return refused("0D");
  if (semicolon != line.npos) {
    const std::string_view string = line.substr(semicolon + 1);
    if (string.size() > longest_string) return refused("0G");
    if (!std::all_of(string.begin(), string.end(), is_permitted)) return refused("0H");
  }
  return refused(read_parameters(digits, model, r));
}

}  // namespace muro::scip2
