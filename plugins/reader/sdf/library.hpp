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

  struct Mistake {
    FileLocation location;
    std::string text;
  };
  /// What the library makes of the checked sources, when `text` is that of the main one. Returns what it finds wrong.
  std::vector<Mistake> load(const SourceFiles& sources, const std::string& text, ::sdf::Root& root);

 private:
  std::unique_lock<std::mutex> lock_;
  std::ostream* messages_;
};

/// Where an element is in its file.
FileLocation location_of(const SourceFiles& sources, ::sdf::ElementPtr element);

}  // namespace muro::sdf
