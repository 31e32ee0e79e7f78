// SPDX-License-Identifier: MIT
#include "archive.hpp"

#include <sys/stat.h>

#include "fmu_testing.hpp"
#include "muro/algorithm.hpp"

namespace muro::fmu {
namespace {

namespace fs = std::filesystem;

/// Returns the error message for an archive of these entries; "" when it is unpacked.
std::string refusal_of(const std::vector<Entry>& entries, const ArchiveLimits& limits = {}) {
  const test::ScratchFolder scratch;
  write_archive(scratch.path("x.fmu"), entries);
  PrivateFolder folder;
  folder.create();
  try {
    unpack(scratch.path("x.fmu"), folder.path(), {"linux64"}, limits);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

const Entry xml{"modelDescription.xml", "<x/>"};

TEST(Archive, WritesWhatRunsHereAndResourcesAndNothingElse) {
  const test::ScratchFolder scratch;
  write_archive(scratch.path("x.fmu"), {xml,
                                        {"binaries/", ""},
                                        {"binaries/linux64/", ""},
                                        {"binaries/linux64/model.so", "machine code"},
                                        {"binaries/linux64/lib/other.so", "more"},
                                        {"binaries/win64/model.dll", "no"},
                                        {"resources/a/table.txt", std::string(200'000, 'x')},
                                        {"sources/model.c", "int x;"}});
  std::string path;
  {
    PrivateFolder folder;
    folder.create();
    path = folder.path();
    struct stat about {};
    ASSERT_EQ(stat(path.c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 0777, 0700u);
    const Archive archive = unpack(scratch.path("x.fmu"), folder.path(), {"linux64"});
    EXPECT_EQ(archive.description, "<x/>");
    EXPECT_EQ(archive.platforms, (std::vector<std::string>{"linux64", "win64"}));
    EXPECT_TRUE(archive.has_resources);
    EXPECT_EQ(test::text_of(path + "/binaries/linux64/model.so"), "machine code");
    EXPECT_EQ(test::text_of(path + "/binaries/linux64/lib/other.so"), "more");
    EXPECT_EQ(test::text_of(path + "/resources/a/table.txt"), std::string(200'000, 'x'));
    EXPECT_FALSE(fs::exists(path + "/binaries/win64"));
    EXPECT_FALSE(fs::exists(path + "/sources"));
  }
  EXPECT_FALSE(fs::exists(path)) << "it is removed at its end";
}

TEST(Archive, RefusesNamesThatLeadOutOfItsFolder) {
  for (const auto& [name, fault] : {std::pair<std::string, std::string>{"../x.so", "leads out of its folder"},
                                    {"resources/../../x", "leads out of its folder"},
                                    {"resources/..", "leads out of its folder"},
                                    {"/etc/passwd", "is an absolute path"},
                                    {"C:/windows/x", "is an absolute path"},
                                    {"resources\\..\\x", "has a backslash"},
                                    {"resources/" + std::string(2000, 'x'), "is longer than 1024 bytes"}}) {
    const std::string said = refusal_of({xml, {name, "bad"}});
    EXPECT_SAYS(said, "holds a file with the name `");
    EXPECT_SAYS(said, fault);
  }
  EXPECT_EQ(refusal_of({xml, {"resources/a..b", "good"}, {"resources/...", "good"}}), "");
}

TEST(Archive, RefusesLinksAndDevices) {
  EXPECT_SAYS(refusal_of({xml, {"resources/link", "/etc/passwd", S_IFLNK | 0777}}), "is a symbolic link");
  EXPECT_SAYS(refusal_of({xml, {"sources/link", "/", S_IFLNK | 0777}}), "is a symbolic link");
  EXPECT_SAYS(refusal_of({xml, {"resources/pipe", "", S_IFIFO | 0777}}), "is neither a file nor a folder");
}

TEST(Archive, RefusesAFileThatIsThereTwiceAndAFileThatIsAFolder) {
  EXPECT_SAYS(refusal_of({xml, {"resources/a", ""}, {"resources/a/b", ""}}), "cannot be written to ");
  EXPECT_SAYS(refusal_of({xml, {"resources/a/b", ""}, {"resources/a", ""}}), "`resources/a` of the archive ");
}

TEST(Archive, RefusesWhatGrowsTooLargeWhenUnpacked) {
  const ArchiveLimits limits{.entries = 5, .file_bytes = 1'000'000, .all_bytes = 2'500'000, .description_bytes = 1000};
  const std::string million(1'000'000, '\0');
  EXPECT_EQ(refusal_of({xml, {"resources/a", million}, {"resources/b", million}}, limits), "");
  EXPECT_SAYS(refusal_of({xml, {"resources/a", million + "x"}}, limits),
              "`resources/a` of the archive has more than 1000000 bytes when unpacked");
  EXPECT_SAYS(refusal_of({xml, {"resources/a", million}, {"resources/b", million}, {"resources/c", million}}, limits),
              "x.fmu has more than 2500000 bytes when unpacked");
  EXPECT_SAYS(refusal_of({{"modelDescription.xml", std::string(1001, ' ')}}, limits), "has more than 1000 bytes");
  EXPECT_SAYS(refusal_of({xml, {"1", ""}, {"2", ""}, {"3", ""}, {"4", ""}, {"5", ""}}, limits),
              "holds 6 files; at most 5 are read");
}

TEST(Archive, CountsTheBytesThatComeAndNotWhatTheArchiveSays) {
  const test::ScratchFolder scratch;
  const std::string path = scratch.path("liar.fmu");
  write_archive(path, {xml, {"resources/bomb", std::string(3'000'000, '\0')}});
  std::string bytes = test::text_of(path);
  const std::string size("\xc0\xc6\x2d\x00", 4), small("\x10\x00\x00\x00", 4);  // 3000000 and 16, in both headers
  for (std::size_t at; (at = bytes.find(size)) != bytes.npos;) bytes.replace(at, 4, small);
  scratch.file("liar.fmu", bytes);
  PrivateFolder folder;
  folder.create();
  const ArchiveLimits limits{.file_bytes = 1'000'000};
  EXPECT_THROW(unpack(path, folder.path(), {"linux64"}, limits), Error);
  std::error_code none;
  const std::uintmax_t written = fs::file_size(folder.path() / "resources/bomb", none);
  EXPECT_TRUE(none || written <= limits.file_bytes) << written;
}

TEST(Archive, SaysWhatIsNoArchiveAndWhatIsNoFmu) {
  const test::ScratchFolder scratch;
  const auto refusal_of_file = [&](const std::string& path) {
    return test::complaint_of<Error>([&] { unpack(path, scratch.path("out"), {"linux64"}); });
  };
  EXPECT_SAYS(refusal_of_file(scratch.path("none.fmu")), "there is no FMU ");
  EXPECT_SAYS(refusal_of_file(scratch.file("text.fmu", "hello")), "cannot be read as a zip archive: ");
  EXPECT_SAYS(refusal_of_file(scratch.file("empty.fmu", "")), "empty.fmu ");
  write_archive(scratch.path("other.fmu"), {{"word/document.xml", "<x/>"}});
  EXPECT_SAYS(refusal_of_file(scratch.path("other.fmu")), "is no FMU: it holds no modelDescription.xml");
  write_archive(scratch.path("whole.fmu"), {xml, {"resources/a", std::string(5000, 'a') + "b"}});
  std::string bytes = test::text_of(scratch.path("whole.fmu"));
  bytes[bytes.find("resources/a") + 14] ^= 0x55;  // within the packed bytes
  EXPECT_SAYS(refusal_of_file(scratch.file("damaged.fmu", bytes)), "`resources/a` of the archive cannot be read: ");
}

TEST(Archive, SaysOfThoseAloneThatLackTheirEndThatTheyDo) {
  const test::ScratchFolder scratch;
  write_archive(scratch.path("whole.fmu"), {xml, {"resources/a", std::string(5000, 'a') + "b"}});
  const std::string whole = test::text_of(scratch.path("whole.fmu"));
  const auto refusal_of_bytes = [&](const std::string& bytes) {
    const std::string path = scratch.file("x.fmu", bytes);
    return test::complaint_of<Error>([&] { unpack(path, scratch.path("out"), {"linux64"}); });
  };
  const std::size_t list = whole.find("PK\1\2"), end = whole.rfind("PK\5\6");
  for (const std::size_t size : {whole.size() / 2, list, list + 20, end, whole.size() - 1})
    EXPECT_SAYS(refusal_of_bytes(whole.substr(0, size)),
                "x.fmu is a zip archive without an end: it was copied only in part")
        << size;
  std::string early = whole, late = whole, damaged = whole, shorter = whole;
  early[end + 16] = 0;  // place of the list, little endian
  late[end + 17] = 1;
  damaged[list] = 'X';
  shorter.erase(40, 20);
  for (const std::string& bytes : {early, late, damaged, shorter}) {
    const std::string said = refusal_of_bytes(bytes);
    EXPECT_SAYS(said, "x.fmu cannot be read as a zip archive: ");
    EXPECT_EQ(said.find("copied"), said.npos) << said;
  }
  EXPECT_SAYS(refusal_of_bytes(late), "inconsistent") << "libzip's reason";
}

TEST(Archive, SaysHowAnFmuIsPackedWhereItIsNot) {
  const test::ScratchFolder scratch;
  EXPECT_SAYS(test::complaint_of<Error>([&] { unpack(scratch.path(""), scratch.path("out"), {"linux64"}); }),
              " is a folder; an FMU is a zip archive of what is in it: (cd ");
  EXPECT_SAYS(refusal_of({{"model/modelDescription.xml", "<x/>"}, {"model/binaries/linux64/model.so", ""}}),
              "it holds `model/modelDescription.xml`: pack what is in that folder, not the folder");
  write_archive(scratch.path("x.fmu"), {xml});
  std::string bytes = test::text_of(scratch.path("x.fmu"));
  bytes.replace(bytes.find("PK\3\4") + 8, 1, "\x62");   // PPMd for `xml`, in its own header
  bytes.replace(bytes.find("PK\1\2") + 10, 1, "\x62");  // and in the list of all
  const std::string path = scratch.file("ppmd.fmu", bytes);
  EXPECT_SAYS(test::complaint_of<Error>([&] { unpack(path, scratch.path("out"), {"linux64"}); }),
              "pack it by `deflate`, as the standard says");
}

TEST(Archive, TakesNamesThatBeginWithTheFolderItself) {
  const test::ScratchFolder scratch;
  write_archive(scratch.path("x.fmu"), {{"./modelDescription.xml", "<x/>"}, {"./binaries/linux64/model.so", "code"}});
  PrivateFolder folder;
  folder.create();
  EXPECT_EQ(unpack(scratch.path("x.fmu"), folder.path(), {"linux64"}).description, "<x/>");
  EXPECT_EQ(test::text_of(folder.path() / "binaries/linux64/model.so"), "code");
  EXPECT_SAYS(refusal_of({xml, {"./modelDescription.xml", "<x/>"}}), "is there twice");
  EXPECT_SAYS(refusal_of({xml, {"./../x", ""}}), "leads out of its folder");
  EXPECT_SAYS(refusal_of({xml, {".//etc/passwd", ""}}), "is an absolute path");
}

}  // namespace
}  // namespace muro::fmu
