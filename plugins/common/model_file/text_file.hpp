// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "problems.hpp"

namespace muro::model_file {

/// Returns the bytes of a file of at most 64 MiB. Throws muro::Error if it cannot be read. `kind`: the kind of file
/// that it should be, for messages: ".urdf".
std::string load_file(const std::string& path, const std::string& kind);

/// A problem with the bytes of a file.
struct TextProblem {
  Location location;
  std::string text;  ///< empty when nothing is wrong
};
struct DecodingProblems {
  TextProblem error = {};    ///< there is no text
  TextProblem warning = {};  ///< there is a text, but maybe not the intended one
};

/// Converts `bytes` of an XML file to text in UTF-8. Messages call the file `kind`; it begins with <`root`>. A
/// byte-order mark is removed. Bytes that are not UTF-8 are read as ISO-8859-1, with a warning. UTF-16, binary, empty
/// and other files are errors.
DecodingProblems decode(std::string& bytes, const std::string& kind, const std::string& root);

}  // namespace muro::model_file
