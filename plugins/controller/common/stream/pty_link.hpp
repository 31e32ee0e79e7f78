// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace muro::stream {

/// A link with a name that stays, to a pseudo-terminal, whose own name the system chooses.
class PtyLink {
 public:
  explicit PtyLink(std::string path) : path_(std::move(path)) {}

  /// Why there cannot be a link of this name; empty: there can. It replaces nothing but links to terminals that are
  /// gone, and those that a run has left behind. Once this path is claimed.
  std::string obstacle() const;
  /// Makes it a link to this terminal, in place of what it was. 0, or an error number.
  int point_to(const std::string& terminal);
  /// Unless it has become another's.
  void remove() const;

 private:
  const std::string path_;
  std::string target_;
};

}  // namespace muro::stream
