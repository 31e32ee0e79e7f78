// SPDX-License-Identifier: MIT
#include "muro/toolkit/whole_file.hpp"

#include <gtest/gtest.h>

#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

using test::complaint_of;
using test::ScratchFolder;
using test::text_of;

TEST(WholeFile, AppearsUnderItsNameWhenItIsPublished) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.txt", "old");
  WholeFile file(path);
  file.stream() << "new";
  file.stream().flush();
  EXPECT_EQ(file.location(), path + ".part");
  EXPECT_EQ(text_of(path), "old");
  file.publish();
  EXPECT_EQ(file.location(), path);
  EXPECT_EQ(text_of(path), "new");
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

TEST(WholeFile, LeavesWhatWasThereWhenItIsNotPublished) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.txt", "old");
  WholeFile(path).stream() << "removed";
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  WholeFile(path, {.keep_unpublished = true}).stream() << "kept";
  EXPECT_EQ(text_of(path + ".part"), "kept");
  EXPECT_EQ(text_of(path), "old");
}

TEST(WholeFile, TakesWhatAnotherWriterHasWritten) {
  const ScratchFolder folder;
  WholeFile film(folder.path("film.mp4"), {.keep_extension = true});
  EXPECT_EQ(film.location(), folder.path("film.part.mp4"));
  EXPECT_EQ(complaint_of<Error>([&] { film.publish(); }),
            "file " + film.path() + " cannot be written: No such file or directory");
  std::ofstream(film.location()) << "frames";
  film.publish();
  EXPECT_EQ(text_of(folder.path("film.mp4")), "frames");
}

TEST(WholeFile, WritesADeviceInPlace) {
  WholeFile file("/dev/null");
  file.stream() << "gone";
  file.publish();
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(WholeFile, SaysWhyItCannotBeWritten) {
  EXPECT_EQ(complaint_of<Error>([] { WholeFile("/nowhere/a.txt").stream(); }),
            "file /nowhere/a.txt cannot be written: No such file or directory");
  const ScratchFolder folder;
  EXPECT_EQ(complaint_of<Error>([&] { WholeFile(folder.path("")).stream(); }),
            "file " + folder.path("") + " cannot be written: Is a directory");
  const auto fill = [](int bytes) {
    WholeFile full("/dev/full");
    full.stream() << std::string(std::size_t(bytes), 'x');
    full.publish();
  };
  EXPECT_EQ(complaint_of<Error>([&] { fill(10); }), "file /dev/full cannot be written: No space left on device");
  EXPECT_EQ(complaint_of<Error>([&] { fill(1 << 20); }),
            "file /dev/full cannot be written; is there room on the disk?");
}

}  // namespace
}  // namespace muro
