// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <type_traits>

#include "muro/robot_builder.hpp"

namespace muro::urdf {

/// Where in the file something stands; lines and columns count from 1, 0 when unknown.
struct Place {
  int line = 0;
  int column = 0;
};

/// The shortest text that reads back as `number`, with a decimal point in every locale.
inline std::string shortest(double number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

/// A name or value from the file as it may stand in a message: in backquotes, of bounded length, printable.
inline std::string cited(std::string_view text) {
  constexpr std::size_t most = 60;
  std::string shown(text.substr(0, most));
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) c = '?';
  // a UTF-8 sequence is not cut in the middle
  if (text.size() > most) {
    while (!shown.empty() && (static_cast<unsigned char>(text[shown.size()]) & 0xc0) == 0x80) shown.pop_back();
    shown += "...";
  }
  return "`" + shown + "`";
}

/// Texts and numbers put together.
template <class... Parts>
std::string say(const Parts&... parts) {
  std::string whole;
  const auto add = [&whole](const auto& part) {
    using T = std::decay_t<decltype(part)>;
    if constexpr (std::is_floating_point_v<T>)
      whole += shortest(part);
    else if constexpr (std::is_integral_v<T>)
      whole += std::to_string(part);
    else
      whole += part;
  };
  (add(parts), ...);
  return whole;
}

/// What is wrong with a model, on its way to the host, and whether the model is still of use.
class Problems {
 public:
  explicit Problems(RobotBuilder& builder) : builder_(builder) {}

  /// Nothing is lost, but the user may want to know.
  void note(Place at, std::string_view text) { builder_.report(Severity::note, text, at.line, at.column); }
  /// Something was left out or replaced; the text says by what.
  void warning(Place at, std::string_view text) { builder_.report(Severity::warning, text, at.line, at.column); }
  /// No robot can be made of the file; the text says what is allowed.
  void error(Place at, std::string_view text) {
    found_error_ = true;
    builder_.report(Severity::error, text, at.line, at.column);
  }
  bool found_error() const { return found_error_; }

 private:
  RobotBuilder& builder_;
  bool found_error_ = false;
};

}  // namespace muro::urdf
