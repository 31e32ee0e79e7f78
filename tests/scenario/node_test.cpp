// SPDX-License-Identifier: MIT
#include "host/scenario/node.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>

#include "core/error.hpp"
#include "host/scenario/yaml.hpp"
#include "tests/support/files.hpp"

namespace muro::host {
namespace {

using test::ScratchFolder;

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const SetupError& e) {
    return e.what();
  }
  return "";
}

TEST(Node, RemembersWhereEachPartStands) {
  const ScratchFolder folder;
  const Node root = load_yaml(folder.file("a.yaml", "a:\n  b: [1, two]\n"));
  EXPECT_EQ(root.find("a")->find("b")->list[1].location.text(), folder.path("a.yaml") + ":2:10");
}

TEST(Node, AnIncludedFileIsOverruledByWhatStandsBesideTheInclude) {
  const ScratchFolder folder;
  folder.file("parts/base.yaml", "x: 1\ny: {p: 1, q: 2}\n");
  const Node root = load_yaml(folder.file("a.yaml", "include: parts/base.yaml\ny: {q: 3}\nz: 4\n"));
  EXPECT_EQ(root.find("x")->scalar, "1");
  EXPECT_EQ(root.find("y")->find("p")->scalar, "1");
  EXPECT_EQ(root.find("y")->find("q")->scalar, "3");
  EXPECT_EQ(root.find("x")->location.text(), folder.path("parts/base.yaml") + ":1:4");
  EXPECT_EQ(root.find("include"), nullptr);
}

TEST(Node, LaterIncludesOverruleEarlierOnes) {
  const ScratchFolder folder;
  folder.file("one.yaml", "a: 1\nb: 1\n");
  folder.file("two.yaml", "b: 2\n");
  const Node root = load_yaml(folder.file("a.yaml", "include: [one.yaml, two.yaml]\n"));
  EXPECT_EQ(root.find("a")->scalar, "1");
  EXPECT_EQ(root.find("b")->scalar, "2");
}

TEST(Node, OverridesMakeWhatIsMissing) {
  Node root = parse_yaml("robots: {rovers: {count: 2}}", {"x", 0, 0});
  apply_override(root, "robots.rovers.count=100");
  apply_override(root, "robots.rovers.motion.use=motion.point");
  apply_override(root, "robots.rovers[0-4].motion={use: motion.simplified, rate: 500}");
  const Node* rovers = root.find("robots")->find("rovers");
  EXPECT_EQ(rovers->find("count")->scalar, "100");
  EXPECT_EQ(rovers->find("count")->location.text(), "--set robots.rovers.count=100");
  EXPECT_EQ(rovers->find("motion")->find("use")->scalar, "motion.point");
  EXPECT_EQ(rovers->find("variants")->find("0-4")->find("motion")->find("rate")->scalar, "500");
}

TEST(Node, OverridesOfWrongFormAreNamed) {
  Node root = parse_yaml("a: {b: 1}", {"x", 0, 0});
  EXPECT_EQ(error_of([&] { apply_override(root, "a.b"); }),
            "--set a.b: write path=value, such as robots.rovers.count=100");
  EXPECT_EQ(error_of([&] { apply_override(root, "a.b.c=1"); }), "--set a.b.c=1: `c` cannot be a key of a single value");
  EXPECT_EQ(error_of([&] { apply_override(root, "a..c=1"); }), "--set a..c=1: the path has an empty part");
  EXPECT_EQ(error_of([&] { apply_override(root, "a[1.c=1"); }), "--set a[1.c=1: `[` is not closed by `]`");
  for (const char* wrong : {"a[0].c=1", "robots[0].c=1", "robots.a.b[0].c=1", "robots.a[0][1].c=1"})
    EXPECT_NE(error_of([&] { apply_override(root, wrong); }), "") << wrong;
  EXPECT_EQ(error_of([&] { apply_override(root, "robots.a[0]c=1"); }),
            "--set robots.a[0]c=1: behind `]` comes `.` or the end of the path");
  EXPECT_NE(error_of([&] { apply_override(root, "a=[1"); }).find("--set a=[1: not YAML"), std::string::npos);
}

TEST(Node, DeepNestingIsAnErrorNotACrash) {
  const ScratchFolder folder;
  const std::string path = folder.file("deep.yaml", "a: " + std::string(5000, '[') + std::string(5000, ']'));
  EXPECT_NE(error_of([&] { load_yaml(path); }).find("nested more than 100 levels deep"), std::string::npos);
}

TEST(Node, AliasesOfAliasesAreCountedNotMade) {
  const ScratchFolder folder;
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string n = std::to_string(i), before = "*a" + std::to_string(i - 1);
    text += "a" + n + ": &a" + n + " [" + before;
    for (int k = 0; k < 9; ++k) text += ", " + before;
    text += "]\n";
  }
  const std::string path = folder.file("a.yaml", text);
  EXPECT_EQ(error_of([&] { load_yaml(path); }).rfind(path + ":6:", 0), 0u);
}

TEST(Node, FilesThatIncludeOthersManyTimesAreCounted) {
  const ScratchFolder folder;
  folder.file("f0.yaml", "a: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]\n");
  for (int i = 1; i < 8; ++i) {
    const std::string before = "f" + std::to_string(i - 1) + ".yaml";
    std::string text;
    for (int k = 0; k < 10; ++k) text += "k" + std::to_string(k) + ": {include: " + before + "}\n";
    folder.file("f" + std::to_string(i) + ".yaml", text);
  }
  EXPECT_NE(error_of([&] { load_yaml(folder.path("f7.yaml")); }).find("more than 1000000 values"), std::string::npos);
}

TEST(Node, MergeKeysGiveWhatTheMapDoesNotSayItself) {
  const ScratchFolder folder;
  const Node root =
      load_yaml(folder.file("a.yaml", "p: &p {x: 1, y: 1}\nq: &q {y: 2, z: 2}\nr: {<<: [*p, *q], x: 3}\n"));
  const Node* r = root.find("r");
  EXPECT_EQ(r->find("x")->scalar, "3");
  EXPECT_EQ(r->find("y")->scalar, "1");
  EXPECT_EQ(r->find("z")->scalar, "2");
  EXPECT_EQ(r->find("<<"), nullptr);
  const std::string path = folder.file("b.yaml", "a: {<<: 3}\n");
  EXPECT_EQ(error_of([&] { load_yaml(path); }), path + ":1:9: `<<` takes a map, or a list of maps");
}

TEST(Node, OnlyWordsAndWrittenNullsSwitchOff) {
  const ScratchFolder folder;
  const Node root =
      load_yaml(folder.file("a.yaml", "a: ~\nb: null\nc: Off\nd: FALSE\ne: \"off\"\nf: 0\ng:\nh: {i: , j: ~}\n"));
  for (const char* off : {"a", "b", "c", "d"}) EXPECT_TRUE(root.find(off)->is_off() && !root.find(off)->empty) << off;
  for (const char* on : {"e", "f"}) EXPECT_FALSE(root.find(on)->is_off()) << on;
  EXPECT_TRUE(root.find("g")->empty);
  EXPECT_EQ(root.find("g")->location.line, 7) << "an empty value stands where its key does";
  EXPECT_TRUE(root.find("h")->find("i")->empty);
  EXPECT_FALSE(root.find("h")->find("j")->empty);
}

TEST(Node, AFileHoldsOneDocument) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.yaml", "---\na: 1\n---\nb: 2\n");
  EXPECT_EQ(error_of([&] { load_yaml(path); }), path + ":3:1: a second YAML document begins here; a file holds one");
}

TEST(Node, WhatIsNoRegularFileIsNamed) {
  const ScratchFolder folder;
  const std::string fifo = folder.path("fifo");
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(error_of([&] { load_yaml(fifo); }), fifo + " is not a regular file");
  EXPECT_EQ(error_of([&] { load_yaml("/dev/zero"); }), "/dev/zero is not a regular file");
  EXPECT_EQ(error_of([&] { load_yaml("/tmp"); }), "/tmp is a folder, not a file");
  const std::string longest(5000, 'x');
  EXPECT_EQ(error_of([&] { load_yaml(longest); }), "file " + longest + " cannot be read: File name too long");
}

}  // namespace
}  // namespace muro::host
