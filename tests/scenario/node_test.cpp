// SPDX-License-Identifier: MIT
#include "host/scenario/node.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
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
  EXPECT_EQ(error_of([&] { apply_override(root, "a.b.c=1"); }), "--set a.b.c=1: `c` has no place inside a single value");
  EXPECT_EQ(error_of([&] { apply_override(root, "a..c=1"); }), "--set a..c=1: the path has an empty part");
  EXPECT_EQ(error_of([&] { apply_override(root, "a[1.c=1"); }), "--set a[1.c=1: `[` is not closed by `]`");
  EXPECT_NE(error_of([&] { apply_override(root, "a=[1"); }).find("--set a=[1: not YAML"), std::string::npos);
}

TEST(Node, DeepNestingIsAnErrorNotACrash) {
  const ScratchFolder folder;
  const std::string path = folder.file("deep.yaml", "a: " + std::string(300, '[') + std::string(300, ']'));
  EXPECT_NE(error_of([&] { load_yaml(path); }).find("nested more than 100 levels deep"), std::string::npos);
}

}  // namespace
}  // namespace muro::host
