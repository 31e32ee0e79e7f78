// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace muro::stream {

/// A link with a fixed name to a pseudo-terminal. The system chooses the name of the terminal itself.
class PtyLink {
 public:
  explicit PtyLink(std::string path) : path_(std::move(path)) {}

  /// Returns why there cannot be a link of this name; empty when there can. Only links to terminals that are gone, and
  /// links of earlier runs, are replaced. Called after the path has been claimed.
  std::string obstacle() const;
  /// Makes the path a link to this terminal, and replaces the old link. Returns 0, or an error number.
  int point_to(const std::string& terminal);
  /// Removes the link, unless it now belongs to another process.
  void remove() const;

 private:
  const std::string path_;
  std::string target_;
};

}  // namespace muro::stream
