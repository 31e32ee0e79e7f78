// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <mutex>
#include <sdf/Root.hh>

#include "source.hpp"

namespace muro::sdf {

/// libsdformat for as long as this lives: silent, and for this thread alone, as its console is one for the process.
class Library {
 public:
  Library();
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  /// What the library makes of the checked sources. What it finds wrong is reported; false after an error.
  bool load(const Sources& sources, ::sdf::Root& root, Problems& problems);

 private:
  std::unique_lock<std::mutex> lock_;
  std::ostream* messages_;
};

/// Where an element stands in its file.
At at(const Sources& sources, ::sdf::ElementPtr element);

}  // namespace muro::sdf
