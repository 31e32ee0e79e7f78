// SPDX-License-Identifier: MIT
// Reads the corpora, which have all that fuzzing has found so far, in the program as it is built.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/fuzz/target.hpp"

namespace muro::fuzz {
namespace {

namespace fs = std::filesystem;

class Corpus : public ::testing::TestWithParam<Target> {};

std::vector<std::uint8_t> bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Reads each file whole, and cut at some places.
TEST_P(Corpus, IsReadOrRefused) {
  int files = 0;
  for (const auto& file : fs::directory_iterator(std::string(CORPUS "/") + GetParam().name)) {
    SCOPED_TRACE(file.path());
    const std::vector<std::uint8_t> bytes = bytes_of(file.path());
    for (const std::size_t part : {8, 7, 5, 2}) GetParam().run(Bytes(bytes).first(bytes.size() * part / 8));
    ++files;
  }
  EXPECT_GE(files, 3);
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Corpus, ::testing::ValuesIn(targets()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace muro::fuzz
