// SPDX-License-Identifier: MIT
#include "host/outputs/video.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

#include "core/error.hpp"

namespace muro::host {

namespace {

/// Returns the text quoted as one argument of a shell command.
std::string shell_argument(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// Returns the result of `work`; its errors become errors of the run.
template <class Work>
auto guarded(Work work) {
  try {
    return work();
  } catch (const Error& e) {
    throw StepError(e.what());
  }
}

}  // namespace

void check_video_format(const std::string& path) {
  constexpr const char* known[] = {".mp4", ".webm", ".mkv", ".gif", ".apng", ".avi", ".flv",
                                   ".m4v", ".mov",  ".mpg", ".ogv", ".ts",   ".wmv"};
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  if (std::find(std::begin(known), std::end(known), extension) == std::end(known))
    throw SetupError(
        fmt::format("--video is `{}`. The extension of the name decides the format: {}", path, fmt::join(known, ", ")));
}

Video::Video(const std::string& path, std::uint32_t width, std::uint32_t height, double frames_per_second)
    : file_(path, {.keep_extension = true}) {
  if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0)  // NOLINT(concurrency-mt-unsafe,cert-env33-c)
    throw SetupError("--video needs the program ffmpeg, which is not installed; install the package ffmpeg");
  const std::string command = fmt::format(
      "ffmpeg -loglevel error -y -f rawvideo -pix_fmt rgb24 -s {}x{} -r {} -i - -pix_fmt yuv420p "
      "-vf 'scale=trunc(iw/2)*2:trunc(ih/2)*2' {}",
      width, height, frames_per_second, shell_argument("file:" + guarded([&] { return file_.location(); })));
  pipe_ = popen(command.c_str(), "w");  // NOLINT(cert-env33-c)
  if (!pipe_) throw StepError("ffmpeg cannot be started");
}

Video::~Video() {
  if (pipe_) pclose(pipe_);
}

void Video::fail() {
  // ffmpeg prints its own reason when its input ends
  if (pipe_) pclose(pipe_);
  pipe_ = nullptr;
  throw StepError(fmt::format("the video {} cannot be written; ffmpeg has printed the reason above", file_.path()));
}

void Video::add(std::span<const std::uint8_t> rgb) {
  if (std::fwrite(rgb.data(), 1, rgb.size(), pipe_) != rgb.size()) fail();
}

void Video::close() {
  const int status = pclose(pipe_);
  pipe_ = nullptr;
  if (status != 0) fail();
  guarded([&] { return file_.publish(), 0; });
}

}  // namespace muro::host
