// SPDX-License-Identifier: MIT
#include "host/video.hpp"

#include <fmt/format.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "core/error.hpp"

namespace muro::host {

namespace {

/// As one word of a shell's command.
std::string word(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

Video::Video(std::string path, std::uint32_t width, std::uint32_t height, double frames_per_second)
    : path_(std::move(path)) {
  namespace fs = std::filesystem;
  if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0)  // NOLINT(concurrency-mt-unsafe,cert-env33-c)
    throw SetupError("--video needs the program ffmpeg, which is not there; install the package ffmpeg");
  const fs::path file(path_);
  part_ = (file.parent_path() / (file.stem().string() + ".part" + file.extension().string())).string();
  std::signal(SIGPIPE, SIG_IGN);
  const std::string command = fmt::format(
      "ffmpeg -loglevel error -y -f rawvideo -pix_fmt rgb24 -s {}x{} -r {} -i - -pix_fmt yuv420p "
      "-vf 'scale=trunc(iw/2)*2:trunc(ih/2)*2' {}",
      width, height, frames_per_second, word("file:" + part_));
  pipe_ = popen(command.c_str(), "w");  // NOLINT(cert-env33-c)
  if (!pipe_) throw SetupError("ffmpeg cannot be started");
}

Video::~Video() {
  if (pipe_) pclose(pipe_);
  std::error_code code;
  std::filesystem::remove(part_, code);
}

void Video::fail() {
  throw SetupError("the film " + path_ +
                   " cannot be made; ffmpeg says why above. The ending of the name tells the "
                   "kind of film: .mp4, .webm, .mkv, .gif");
}

void Video::add(std::span<const std::uint8_t> rgb) {
  if (std::fwrite(rgb.data(), 1, rgb.size(), pipe_) != rgb.size()) fail();
}

void Video::close() {
  const int status = pclose(pipe_);
  pipe_ = nullptr;
  std::error_code code;
  if (status == 0) std::filesystem::rename(part_, path_, code);
  if (status != 0 || code) fail();
}

}  // namespace muro::host
