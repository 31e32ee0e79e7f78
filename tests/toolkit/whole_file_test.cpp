// SPDX-License-Identifier: MIT
#include "muro/base/whole_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

using test::complaint_of;
using test::ScratchFolder;
using test::text_of;

std::string read_back(const std::string& path) { return test::run_command("cat " + path).output; }

TEST(WholeFile, AppearsUnderItsNameWhenItIsPublished) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.txt", "old");
  WholeFile file(path);
  file.write("new");
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
  WholeFile(path).write("removed");
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  WholeFile(path, {.keep_unpublished = true}).write("kept");
  EXPECT_EQ(text_of(path + ".part"), "kept");
  EXPECT_EQ(text_of(path), "old");
}

TEST(WholeFile, LeavesFilesOfOthersAlone) {
  const ScratchFolder folder;
  const std::string path = folder.path("a.txt"), mine = folder.file("a.txt.part", "mine");
  folder.file("a.txt.part2", "mine too");
  WholeFile file(path);
  file.write("new");
  EXPECT_EQ(file.location(), path + ".part3");
  file.publish();
  EXPECT_EQ(text_of(path), "new");
  EXPECT_EQ(text_of(mine), "mine");
  EXPECT_EQ(text_of(mine + "2"), "mine too");
}

TEST(WholeFile, IsWrittenByOneAtATime) {
  const ScratchFolder folder;
  const std::string path = folder.path("a.txt");
  WholeFile first(path);
  first.write("first");
  EXPECT_EQ(complaint_of<Error>([&] { WholeFile(path).write("second"); }),
            "file " + path + " is being written by another recorder or run; give each a file of its own");
  first.publish();
  EXPECT_EQ(text_of(path), "first");
}

TEST(WholeFile, TakesWhatAnotherWriterHasWritten) {
  const ScratchFolder folder;
  WholeFile film(folder.path("film.mp4"), {.keep_extension = true});
  EXPECT_EQ(film.location(), folder.path("film.part.mp4"));
  std::ofstream(film.location()) << "frames";
  film.publish();
  EXPECT_EQ(text_of(folder.path("film.mp4")), "frames");
}

TEST(WholeFile, WritesADeviceInPlace) {
  WholeFile file("/dev/null");
  file.write("gone");
  file.publish();
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(WholeFile, FollowsLinksAndLeavesThem) {
  const ScratchFolder folder;
  const std::string target = folder.file("kept/target.txt", "old"), link = folder.path("link"),
                    dangling = folder.path("dangling"), loop = folder.path("loop");
  std::filesystem::create_symlink("kept/target.txt", link);
  std::filesystem::create_symlink(folder.path("kept/new.txt"), dangling);
  std::filesystem::create_symlink(loop, loop);
  for (const std::string& name : {link, dangling}) {
    WholeFile file(name);
    file.write("new");
    file.publish();
    EXPECT_TRUE(std::filesystem::is_symlink(name)) << name;
  }
  EXPECT_EQ(text_of(target), "new");
  EXPECT_EQ(text_of(folder.path("kept/new.txt")), "new");
  EXPECT_EQ(complaint_of<Error>([&] { WholeFile(loop).write("x"); }),
            "file " + loop + " cannot be written: Too many levels of symbolic links");
}

TEST(WholeFile, ContinuesWhatIsOpenAlready) {
  const ScratchFolder folder;
  const std::string path = folder.path("out");
  const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_EQ(write(descriptor, "before ", 7), 7);
  WholeFile file("/dev/fd/" + std::to_string(descriptor));
  file.write("here ");
  file.publish();
  ASSERT_EQ(write(descriptor, "behind", 6), 6);
  close(descriptor);
  EXPECT_EQ(text_of(path), "before here behind");
}

TEST(WholeFile, WritesAPipeToItsReader) {
  const ScratchFolder folder;
  const std::string path = folder.path("pipe");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  std::string seen;
  std::thread reader([&] { seen = read_back(path); });
  {
    WholeFile file(path);
    file.write("through");
    file.publish();
  }
  reader.join();
  EXPECT_EQ(seen, "through");
  EXPECT_TRUE(std::filesystem::is_fifo(path));
}

TEST(WholeFile, KeepsThePermissionsOfWhatItReplaces) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.txt", "old");
  std::filesystem::permissions(path, std::filesystem::perms(0640));
  WholeFile file(path);
  file.write("new");
  file.publish();
  EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms(0640));
}

TEST(WholeFile, MayHaveTheLongestName) {
  const ScratchFolder folder;
  const std::string path = folder.path(std::string(251, 'n') + ".txt");
  WholeFile file(path);
  file.write("new");
  file.publish();
  EXPECT_EQ(text_of(path), "new");
  EXPECT_EQ(complaint_of<Error>([&] { WholeFile(path + "1").write("x"); }),
            "file " + path + "1 cannot be written: File name too long");
}

TEST(WholeFile, SaysWhyItCannotBeWritten) {
  EXPECT_EQ(complaint_of<Error>([] { WholeFile("/nowhere/a.txt").write(""); }),
            "file /nowhere/a.txt cannot be written: No such file or directory");
  const ScratchFolder folder;
  EXPECT_EQ(complaint_of<Error>([&] { WholeFile(folder.path("")).write(""); }),
            "file " + folder.path("") + " cannot be written: Is a directory");
  for (const std::size_t bytes : {10, 1 << 20})
    EXPECT_EQ(complaint_of<Error>([&] { WholeFile("/dev/full").write(std::string(bytes, 'x')); }),
              "file /dev/full cannot be written: No space left on device");
}

}  // namespace
}  // namespace muro
