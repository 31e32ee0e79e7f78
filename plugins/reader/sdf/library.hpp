// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <mutex>
#include <sdf/Root.hh>

#include "source_file.hpp"

namespace muro::sdf {

/// libsdformat for as long as this lives: silent, and for this thread alone, as its console is one for the process.
class Library {
 public:
  Library();
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  /// What the library makes of the checked sources. What it finds wrong is reported; false after an error.
  bool load(const SourceFiles& sources, ::sdf::Root& root, Problems& problems);

 private:
  std::unique_lock<std::mutex> lock_;
  std::ostream* messages_;
};

/// Where an element is in its file.
FileLocation location_of(const SourceFiles& sources, ::sdf::ElementPtr element);

}  // namespace muro::sdf
