// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace muro::render {

/// A program of a vertex and a fragment shader. Must be made and used while its context is current.
class Program {
 public:
  /// Throws muro::Error with the compiler's log.
  Program(const std::string& vertex, const std::string& fragment);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const;

 private:
  std::uint32_t id_ = 0;
};

}  // namespace muro::render
