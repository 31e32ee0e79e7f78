// SPDX-License-Identifier: MIT
#include "core/output_registry.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "muro/base/whole_file.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

namespace fs = std::filesystem;

/// Outputs and inputs in a folder of their own. Messages name it FOLDER.
struct Files {
  test::ScratchFolder folder;
  OutputRegistry registry;
  void write(const std::string& owner, const std::string& path) {
    registry.set_owner(owner);
    registry.file(path);
  }
  void read(const std::string& path, const std::string& what) {
    registry.set_owner("the scenario");
    registry.add_input(path, what);
  }
  std::string complaint() {
    std::string told = test::complaint_of<OutputError>([&] { registry.check(); });
    for (std::size_t at; (at = told.find(folder.path(""))) != std::string::npos;)
      told.replace(at, folder.path("").size(), "FOLDER/");
    return told;
  }
};

TEST(OutputRegistry, LetsDifferentFilesBe) {
  Files f;
  f.write("a", f.folder.path("a.csv"));
  f.write("b", f.folder.path("b.csv"));
  f.read(f.folder.file("s.yaml", ""), "a file of the scenario");
  f.write("c", "/dev/null");
  f.write("d", "/dev/null");
  EXPECT_EQ(f.complaint(), "no complaint");
}

TEST(OutputRegistry, FindsOneFileUnderTwoNames) {
  const auto complaint = [](const auto& prepare) {
    Files f;
    const std::string second = prepare(f.folder);
    f.write("a", f.folder.path("x.csv"));
    f.write("b", second);
    return f.complaint();
  };
  EXPECT_EQ(complaint([](auto& folder) { return folder.path("x.csv"); }),
            "a and b write to one file, FOLDER/x.csv; give each a file of its own");
  EXPECT_EQ(complaint([](auto& folder) { return folder.path("./x.csv"); }),
            "a and b write to one file, FOLDER/x.csv, which is also FOLDER/./x.csv; give each a file of its own");
}

TEST(OutputRegistry, FollowsLinksOfBothKinds) {
  const auto is_one = [](const auto& prepare) {
    Files f;
    const std::string first = f.folder.file("x.csv", "old"), second = prepare(f.folder);
    f.write("a", first);
    f.write("b", second);
    return f.complaint().find("a and b write to one file") != std::string::npos;
  };
  EXPECT_TRUE(is_one([](auto& folder) {
    fs::create_symlink("x.csv", folder.path("link"));
    return folder.path("link");
  }));
  EXPECT_TRUE(is_one([](auto& folder) {
    fs::create_hard_link(folder.path("x.csv"), folder.path("link"));
    return folder.path("link");
  }));
  EXPECT_TRUE(is_one([](auto& folder) {
    fs::create_directory_symlink(".", folder.path("here"));
    return folder.path("here/x.csv");
  }));
  EXPECT_FALSE(is_one([](auto& folder) { return folder.path("y.csv"); }));
}

TEST(OutputRegistry, KeepsInputsFromBeingOverwritten) {
  Files f;
  const std::string model = f.folder.file("rover.urdf", "<robot/>");
  fs::create_symlink(model, f.folder.path("link"));
  f.read(model, "a model");
  f.write("--report", f.folder.path("link"));
  f.registry.set_owner("pictures");
  f.registry.series(f.folder.path("rover_"), ".png");
  EXPECT_EQ(f.complaint(),
            "--report would overwrite FOLDER/link, which is FOLDER/rover.urdf, a model; choose another name");
}

TEST(OutputRegistry, KnowsTheFilesOfSeries) {
  Files f;
  const std::string texture = f.folder.file("cam_00001.500000.png", "");
  for (const char* owner : {"first", "second"}) {
    f.registry.set_owner(owner);
    f.registry.series(f.folder.path("cam_"), ".png");
    f.registry.series(f.folder.path("cam_depth_"), ".png");
  }
  f.read(texture, "a file of the scene");
  f.read(f.folder.file("cam_poster.png", ""), "a file of the scene");
  const std::string told = f.complaint();
  EXPECT_EQ(
      told,
      "first and second write to one file, FOLDER/cam_#.png; give each a file of its own\n"
      "first and second write to one file, FOLDER/cam_depth_#.png; give each a file of its own\n"
      "first would overwrite FOLDER/cam_#.png, which is FOLDER/cam_00001.500000.png, a file of the scene; choose "
      "another name\n"
      "second would overwrite FOLDER/cam_#.png, which is FOLDER/cam_00001.500000.png, a file of the scene; choose "
      "another name");
}

TEST(OutputRegistry, NoFileHasTheNameOfAFolderOfPictures) {
  Files f;
  f.write("log", f.folder.path("out"));
  f.registry.set_owner("pictures");
  f.registry.series(f.folder.path("out/pictures/cam_"), ".png");
  EXPECT_EQ(f.complaint(),
            "log and pictures write to one file, FOLDER/out, which is also FOLDER/out/pictures/cam_#.png; give each a "
            "file of its own");
}

TEST(OutputRegistry, KeepsPartsApartFromFiles) {
  Files f;
  f.write("a", f.folder.path("x.csv"));
  f.write("b", f.folder.path("x.csv.part"));
  EXPECT_EQ(f.complaint(),
            "a keeps FOLDER/x.csv under the name FOLDER/x.csv.part until it is complete, and b writes to it; choose "
            "another name");
}

TEST(OutputRegistry, TellsWhatCannotBeWritten) {
  const auto complaint = [](const std::string& name) {
    Files f;
    f.folder.file("file", "");
    f.write("a", f.folder.path(name));
    return f.complaint();
  };
  EXPECT_EQ(complaint("nowhere/x.csv"), "a: file FOLDER/nowhere/x.csv cannot be written: No such file or directory");
  EXPECT_EQ(complaint(""), "a: file FOLDER/ cannot be written: Is a directory");
  EXPECT_EQ(complaint("file/x.csv"), "a: file FOLDER/file/x.csv cannot be written: Not a directory");
  Files busy;
  WholeFile other(busy.folder.path("x.csv"));
  other.write("of another run");
  busy.write("a", busy.folder.path("x.csv"));
  EXPECT_EQ(busy.complaint(),
            "a: file FOLDER/x.csv is being written by another recorder or run; give each a file of its own");
  Files nowhere;
  nowhere.write("a", "/dev/fd/12345");
  EXPECT_EQ(nowhere.complaint(), "a: file /dev/fd/12345 cannot be written: Bad file descriptor");
  const std::string longest(256, 'n');
  EXPECT_EQ(complaint(longest), "a: file FOLDER/" + longest + " cannot be written: File name too long");
}

}  // namespace
}  // namespace muro
