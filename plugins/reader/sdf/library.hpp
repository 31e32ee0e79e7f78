// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <mutex>
#include <sdf/Root.hh>

#include "source_file.hpp"

namespace muro::sdf {

/// Exclusive access to libsdformat for one thread, with a silent console: the process has only one console.
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
  /// Loads the checked sources, with `text` as the text of the main source, into `root`. Returns the mistakes found.
  std::vector<Mistake> load(const SourceFiles& sources, const std::string& text, ::sdf::Root& root);

 private:
  std::unique_lock<std::mutex> lock_;
  std::ostream* messages_;
};

/// Returns the location of an element in its file.
FileLocation location_of(const SourceFiles& sources, ::sdf::ElementPtr element);

}  // namespace muro::sdf
