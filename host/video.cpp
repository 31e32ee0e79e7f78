// SPDX-License-Identifier: MIT
#include "host/video.hpp"

#include <fmt/format.h>

#include <csignal>
#include <cstdlib>

#include "core/error.hpp"

namespace muro::host {

namespace {

/// Quoted as one argument of a shell command.
std::string shell_argument(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

Video::Video(const std::string& path, std::uint32_t width, std::uint32_t height, double frames_per_second)
    : file_(path, {.keep_extension = true}) {
  if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0)  // NOLINT(concurrency-mt-unsafe,cert-env33-c)
    throw SetupError("--video needs the program ffmpeg, which is not installed; install the package ffmpeg");
  std::signal(SIGPIPE, SIG_IGN);
  const std::string command = fmt::format(
      "ffmpeg -loglevel error -y -f rawvideo -pix_fmt rgb24 -s {}x{} -r {} -i - -pix_fmt yuv420p "
      "-vf 'scale=trunc(iw/2)*2:trunc(ih/2)*2' {}",
      width, height, frames_per_second, shell_argument("file:" + file_.location()));
  pipe_ = popen(command.c_str(), "w");  // NOLINT(cert-env33-c)
  if (!pipe_) throw SetupError("ffmpeg cannot be started");
}

Video::~Video() {
  if (pipe_) pclose(pipe_);
}

void Video::fail() {
  throw SetupError(
      fmt::format("the video {} cannot be written; ffmpeg has printed the reason above. The extension of the "
                  "name decides the format: .mp4, .webm, .mkv, .gif",
                  file_.path()));
}

void Video::add(std::span<const std::uint8_t> rgb) {
  if (std::fwrite(rgb.data(), 1, rgb.size(), pipe_) != rgb.size()) fail();
}

void Video::close() {
  const int status = pclose(pipe_);
  pipe_ = nullptr;
  if (status != 0) fail();
  try {
    file_.publish();
  } catch (const Error& e) {
    throw SetupError(e.what());
  }
}

}  // namespace muro::host
