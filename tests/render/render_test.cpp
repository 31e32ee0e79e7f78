// SPDX-License-Identifier: MIT
// Pictures that a user makes with `muro render`; read by libpng.
#include <gtest/gtest.h>

#include <array>
#include <set>

#include "plugins/common/image_file/png.hpp"
#include "tests/support/files.hpp"
#include "tests/support/picture.hpp"

namespace muro {
namespace {

const std::string muro_program = std::string("MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " ") + MURO_PROGRAM;
const std::string urban = MURO_TEST_SOURCE_DIR "/examples/urban/urban.yaml";

using Picture = test::Picture<>;

std::size_t colors_of(const Picture& picture) {
  const std::vector<std::uint8_t>& rgb = picture.values;
  std::set<std::array<std::uint8_t, 3>> all;
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) all.insert({rgb[i], rgb[i + 1], rgb[i + 2]});
  return all.size();
}

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
  EXPECT_GT(colors_of(picture), 500u);
}

TEST(Render, PutsTexturesOfAScenarioOnShapesOfSceneryAndRobots) {
  const test::ScratchFolder folder;
  // red, green; blue, white
  const std::uint8_t quarters[] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}, green[] = {0, 255, 0};
  image_file::write_png(folder.path("quarters.png"), image_file::Format::rgb8, 2, 2, quarters);
  image_file::write_png(folder.path("green.png"), image_file::Format::rgb8, 1, 1, green);
  const std::string scenario = folder.file("s.yaml", R"(
duration: 1
world: {objects: {box: {shape: {box: [2, 2, 2]}, texture: quarters.png, at: {x: 5, z: 1}}}}
robots: {ball: {shape: {sphere: 1}, mass: 1, texture: green.png, at: {x: 5, y: 4, z: 1}}}
)");
  const std::string file = folder.path("picture.png");
  const auto result = render(scenario + " --size 300x100 --fov 90 --from 0,2,1 --to 5,2,1 --out " + file);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const Picture picture(file);
  ASSERT_EQ(picture.width, 300u);
  const auto color = [&](std::size_t column, std::size_t row) {
    const std::uint8_t* p = &picture.values[3 * (row * 300 + column)];
    if (std::max({p[0], p[1], p[2]}) - std::min({p[0], p[1], p[2]}) < 40) return "white";
    return p[0] > p[1] && p[0] > p[2] ? "red" : p[1] > p[2] ? "green" : "blue";
  };
  // the face of the box is 4 m away and 2 m to the right; a quarter is 37 pixels wide
  EXPECT_STREQ(color(200, 25), "red");
  EXPECT_STREQ(color(250, 25), "green");
  EXPECT_STREQ(color(200, 75), "blue");
  EXPECT_STREQ(color(250, 75), "white");
  EXPECT_STREQ(color(90, 50), "green");
}

TEST(Render, ShowsRobotsOfOneModelInTheColoursOfTheirTeams) {
  const test::ScratchFolder folder;
  const auto pixels = [&](const std::string& changes) {
    const std::string file = folder.path("parade.png");
    const auto result =
        render(MURO_TEST_SOURCE_DIR
               "/examples/models/parade.yaml --set algorithms.pictures=off --camera observer/camera --out " +
               file +
               " --set robots.observer.camera.width=640 --set robots.observer.camera.height=360"
               " --set robots.blue_omni=off --set robots.yellow_omni=off" +
               changes);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    const Picture picture(file);
    struct {
      std::size_t red = 0, blue = 0;
    } count;
    for (std::size_t i = 0; i + 2 < picture.values.size(); i += 3) {
      const int r = picture.values[i], g = picture.values[i + 1], b = picture.values[i + 2];
      count.red += r > 2 * g && r > 2 * b;
      count.blue += b > 2 * r && b > g + 40;
    }
    return count;
  };
  const auto both = pixels(" --set robots.rover=off --set robots.orange_quadruped=off");
  EXPECT_GT(both.red, 300u);
  EXPECT_GT(both.blue, 300u);
  const auto one = pixels(
      " --set robots.rover=off --set robots.orange_quadruped=off"
      " --set 'robots.red_humanoids.materials.team.color=[0.1, 0.35, 0.8]'");
  EXPECT_LT(one.red, both.red / 4) << "lights at the back of the rover";
  EXPECT_GT(one.blue, both.blue + 300);
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

TEST(Render, OpensNoStreamAndWaitsForNoClient) {
  const test::ScratchFolder folder;
  const auto result = render(MURO_TEST_SOURCE_DIR "/examples/sil/sil.yaml --at 1 --size 160x120 --out " +
                             folder.path("sil.png") + " --set robots.rover.scanner.stream.pty=" + folder.path("laser"));
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(result.output.find("serves on"), std::string::npos) << result.output;
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
  EXPECT_LT(colors_of(picture), 30u) << "a wall, and nothing else";
  const auto wrong = render(scenario + " --camera scout/camer --out " + file);
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.output.find("no camera `scout/camer` (did you mean `scout/camera`?); there are: scout/camera"),
            std::string::npos)
      << wrong.output;
}

TEST(Render, WritesWhatItWasAskedForAndNothingElse) {
  const test::ScratchFolder folder;
  const std::string kept = folder.file("log.csv", "of the last run");
  const auto result = render(
      urban + " --at 0.1 --size 64x48 --out " + folder.path("team.png") +
      " --set 'algorithms.log={use: recorder.csv, rate: 10, file: " + kept +
      "}' --set 'algorithms.pictures={use: recorder.images, rate: 10, folder: " + folder.path("pictures") + "}'");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(test::text_of(kept), "of the last run");
  std::set<std::string> names;
  for (const auto& f : std::filesystem::directory_iterator(folder.path(""))) names.insert(f.path().filename());
  EXPECT_EQ(names, (std::set<std::string>{"log.csv", "team.png"}));
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

/// Makes a substitute for ffmpeg, which records its arguments and copies its input to the file of the video.
std::string stand_in(const test::ScratchFolder& folder) {
  std::filesystem::create_directory(folder.path("bin"));
  const std::string file = folder.file("bin/ffmpeg", "#!/bin/sh\necho \"$*\" >" + folder.path("asked") +
                                                         "\nfor last; do :; done\ncat >\"${last#file:}\"\n");
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  return "PATH=" + folder.path("bin") + ":$PATH ";
}

TEST(Render, HandsTheFramesOfAVideoToFfmpeg) {
  const test::ScratchFolder folder;
  const std::string video = folder.path("a video.mp4"),
                    arguments = urban + " --from -42,-30,7 --to -20,-20,0 --size 64x48";
  const auto result = test::run_command(stand_in(folder) + muro_program + " render " + arguments +
                                        " --device software --at 0.5 --until 1 --fps 10 --video '" + video + "'");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_NE(test::text_of(folder.path("asked")).find("-f rawvideo -pix_fmt rgb24 -s 64x48 -r 10 -i -"),
            std::string::npos);
  const std::string frames = test::text_of(video);
  constexpr std::size_t frame = 64 * 48 * 3;
  ASSERT_EQ(frames.size(), 6 * frame) << "at 0.5, 0.6, ... 1 s";
  const std::string file = folder.path("still.png");
  render(arguments + " --at 0.8 --out " + file);
  const Picture still(file);
  EXPECT_EQ(frames.compare(3 * frame, frame, reinterpret_cast<const char*>(still.values.data()), frame), 0)
      << "the fourth frame is the picture at that time";
  EXPECT_NE(frames.substr(0, frame), frames.substr(5 * frame)) << "robots move";
}

/// Returns a scenario in which a red box moves along x. After 10 s it is 20 m away from another box.
std::string drifting(const test::ScratchFolder& folder) {
  return folder.file("drift.yaml",
                     "duration: 10\nworld: {gravity: [0, 0, 0], objects: {ground: {shape: plane, at: {z: -0.1}}}}\n"
                     "robots:\n  goes: {shape: {box: [1, 1, 1]}, color: [0.9, 0.1, 0.1], mass: 1, velocity: [2, 0, 0], "
                     "at: {z: 0.5}, motion: {use: motion.simplified}}\n"
                     "  stays: {shape: {box: [1, 1, 1]}, mass: 1, at: {y: 4, z: 0.5}, motion: {use: "
                     "motion.simplified}}\n");
}

bool is_red(const std::uint8_t* pixel) { return pixel[0] > 2 * pixel[1] && pixel[0] > 60; }

TEST(Render, LooksAtTheRobotsThatMoveWhereTheyAreThen) {
  const test::ScratchFolder folder;
  const std::string file = folder.path("late.png");
  const auto result = render(drifting(folder) + " --at 10 --size 64x48 --out " + file);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const Picture picture(file);
  EXPECT_TRUE(is_red(&picture.values[3 * (24 * 64 + 32)])) << "in the middle of the picture";
}

TEST(Render, FollowsTheRobotsThatMoveInAVideo) {
  const test::ScratchFolder folder;
  const std::string video = folder.path("v.mp4");
  const auto result = test::run_command(stand_in(folder) + muro_program + " render " + drifting(folder) +
                                        " --device software --size 64x48 --fps 2 --video " + video);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const std::string frames = test::text_of(video);
  constexpr std::size_t frame = 64 * 48 * 3;
  ASSERT_EQ(frames.size(), 21 * frame);
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(frames.data());
  for (std::size_t k = 0; k < 21; ++k) {
    std::size_t red = 0;
    for (std::size_t i = 0; i < frame; i += 3) red += is_red(bytes + k * frame + i);
    EXPECT_GT(red, 20u) << "it is in frame " << k;
  }
}

#ifdef MURO_HAS_FFMPEG
TEST(Render, MakesAVideoThatPlays) {
  const test::ScratchFolder folder;
  const std::string video = folder.path("video.mp4");
  const auto result = render(urban + " --size 65x49 --until 0.4 --fps 10 --video " + video);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(test::run_command("ffmpeg -loglevel error -i " + video + " -f rawvideo -pix_fmt rgb24 - | wc -c").output,
            std::to_string(5 * 64 * 48 * 3) + "\n")
      << "five frames, of an even number of pixels either way";
  const auto wrong = render(urban + " --size 64x48 --until 0.2 --video " + folder.path("video.what"));
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.output.find("The extension of the name decides the format"), std::string::npos) << wrong.output;
  EXPECT_FALSE(std::filesystem::exists(folder.path("video.what")));
}
#endif

TEST(Render, SaysThatAVideoNeedsFfmpegAndWhatElseIsWrong) {
  const auto with_path = [](const std::string& path, const std::string& arguments) {
    return test::run_command("PATH=" + path + " " + muro_program + " render " + urban + " " + arguments);
  };
  const auto without = with_path("/nowhere", "--video /tmp/video.mp4");
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_NE(without.output.find("needs the program ffmpeg"), std::string::npos) << without.output;
  EXPECT_NE(with_path("$PATH", "").output.find("give --out FILE.png for a picture, or --video FILE.mp4 for a video"),
            std::string::npos);
  EXPECT_NE(with_path("$PATH", "--video /tmp/video.mp4 --until 1e9 --fps 1000").output.find("the video would have"),
            std::string::npos);
  EXPECT_NE(
      with_path("$PATH", "--video /tmp/video.mp4 --at 3 --until 2").output.find("--until is 2 s but must be later"),
      std::string::npos);
}

}  // namespace
}  // namespace muro
