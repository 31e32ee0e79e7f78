// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "problems.hpp"

namespace muro::model_file {

/// The bytes of a file of at most 64 MiB. Throws muro::Error when it cannot be read; `kind` says in messages what
/// kind of file it should be: ".urdf".
std::string load_file(const std::string& path, const std::string& kind);

/// What is wrong with the bytes of a file.
struct TextProblem {
  Location location;
  std::string text;  ///< empty when nothing is wrong
};
struct DecodingProblems {
  TextProblem error = {};    ///< there is no text
  TextProblem warning = {};  ///< there is, but maybe not as it was meant
};

/// `bytes` of an XML file, which in messages is called `kind` and begins with <`root`>, become text in UTF-8: a
/// byte-order mark goes, and bytes that are not UTF-8 are read as ISO-8859-1, with a warning. UTF-16, binary, empty
/// and other files are errors.
DecodingProblems decode(std::string& bytes, const std::string& kind, const std::string& root);

}  // namespace muro::model_file
