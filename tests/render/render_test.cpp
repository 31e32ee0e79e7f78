// SPDX-License-Identifier: MIT
// Pictures as a user makes them, with `muro render`; read by libpng.
#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <set>

#include "tests/support/files.hpp"

namespace muro {
namespace {

const std::string muro_program = std::string("MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " ") + MURO_PROGRAM;
const std::string urban = MURO_TEST_SOURCE_DIR "/examples/urban/urban.yaml";

struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  explicit Picture(const std::string& path) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&image, path.c_str())) return;
    image.format = PNG_FORMAT_RGB;
    rgb.resize(PNG_IMAGE_SIZE(image));
    width = image.width, height = image.height;
    png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr);
  }
  std::size_t colors() const {
    std::set<std::array<std::uint8_t, 3>> all;
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) all.insert({rgb[i], rgb[i + 1], rgb[i + 2]});
    return all.size();
  }
};

test::CommandResult render(const std::string& arguments) {
  return test::run_command(muro_program + " render " + arguments + " --device software");
}

TEST(Render, DrawsTheUrbanTeamFromOutside) {
  const test::ScratchFolder folder;
  const std::string file = folder.path("team.png");
  const auto result = render(urban + " --at 1 --size 320x200 --out " + file);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const Picture picture(file);
  EXPECT_EQ(picture.width, 320u);
  EXPECT_EQ(picture.height, 200u);
  EXPECT_GT(picture.colors(), 500u);
}

TEST(Render, DrawsTheSameBytesTwiceAndOthersLater) {
  const test::ScratchFolder folder;
  const auto bytes = [&](const std::string& at) {
    const std::string file = folder.path("team.png");
    render(urban + " --at " + at + " --from -42,-30,7 --to -20,-20,0 --size 160x120 --out " + file);
    return test::text_of(file);
  };
  const std::string first = bytes("1");
  EXPECT_FALSE(first.empty());
  EXPECT_TRUE(bytes("1") == first);
  EXPECT_FALSE(bytes("8") == first) << "the team has moved";
}

TEST(Render, DrawsWhatTheCameraOfARobotSees) {
  const test::ScratchFolder folder;
  const std::string scenario = folder.file(
      "see.yaml",
      "duration: 1\nworld: {objects: {wall: {shape: {box: [0.2, 40, 40]}, at: {x: 3}}}}\nrobots:\n  scout:\n    "
      "model: " MURO_TEST_SOURCE_DIR
      "/examples/models/rover.urdf\n    motion: {use: motion.point}\n"
      "    camera: {use: camera.opengl, on: laser_link, rate: 10, width: 64, height: 48, see_self: false}\n");
  const std::string file = folder.path("seen.png");
  const auto result = render(scenario + " --at 0.5 --camera scout/camera --out " + file);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const Picture picture(file);
  EXPECT_EQ(picture.width, 64u);
  EXPECT_LT(picture.colors(), 30u) << "a wall, and nothing else";
  const auto wrong = render(scenario + " --camera scout/camer --out " + file);
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.output.find("no camera `scout/camer` (did you mean `scout/camera`?); there are: scout/camera"),
            std::string::npos)
      << wrong.output;
}

TEST(Render, TellsWhatIsWrongAndWritesNothing) {
  const test::ScratchFolder folder;
  const std::string file = folder.path("x.png");
  const std::pair<std::string, std::string> mistakes[] = {
      {" --size 10 --out " + file, "--size is `10` but must be WIDTHxHEIGHT"},
      {" --out " + folder.path("x.jpg"), "must be a file NAME.png"},
      {" --from 1,2,3 --to 1,2,3 --out " + file, "--from and --to are the same point"},
      {" --camera a --from 1,2,3 --out " + file, "give one of both"},
  };
  for (const auto& [arguments, message] : mistakes) {
    const auto result = render(urban + arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_NE(result.output.find(message), std::string::npos) << result.output;
  }
  EXPECT_TRUE(test::text_of(file).empty());
}

}  // namespace
}  // namespace muro
