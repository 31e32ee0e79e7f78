// SPDX-License-Identifier: MIT
#include "muro/base/whole_library.hpp"

#include <gtest/gtest.h>

#include "tests/support/files.hpp"

namespace muro {
namespace {

const std::string library = MURO_TEST_PLUGIN_DIR "/motion_point.so";

TEST(WholeLibrary, ALibraryIsWhole) {
  EXPECT_EQ(missing_part_of_library(library), "");
  EXPECT_EQ(missing_part_of_library("/proc/self/exe"), "");
}

TEST(WholeLibrary, EveryPartOfALibraryMissesSomething) {
  const test::ScratchFolder folder;
  const std::string bytes = test::text_of(library);
  ASSERT_GT(bytes.size(), 10000u);
  for (const std::size_t size : {sizeof(Elf64_Ehdr), std::size_t(4096), bytes.size() / 2, bytes.size() - 1}) {
    const std::string message = missing_part_of_library(folder.file("part.so", bytes.substr(0, size)));
    EXPECT_NE(message.find("the file has " + std::to_string(size) + " bytes and should have at least "),
              std::string::npos)
        << message;
  }
}

TEST(WholeLibrary, LeavesOtherFilesToTheLoader) {
  const test::ScratchFolder folder;
  EXPECT_EQ(missing_part_of_library(folder.path("none.so")), "");
  EXPECT_EQ(missing_part_of_library(folder.file("empty.so", "")), "");
  EXPECT_EQ(missing_part_of_library(folder.file("text.so", std::string(1000, 'x'))), "");
}

}  // namespace
}  // namespace muro
