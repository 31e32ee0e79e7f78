// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <span>
#include <string>

#include "muro/base/whole_file.hpp"

namespace muro::host {

/// Throws SetupError with the known formats when the extension of the name is not one of them.
void check_video_format(const std::string& path);

/// A video file that ffmpeg encodes from frames; it gets its name when it is complete.
class Video {
 public:
  /// Throws SetupError when there is no ffmpeg, StepError when the file cannot be created.
  Video(const std::string& path, std::uint32_t width, std::uint32_t height, double frames_per_second);
  /// Removes a file that was not closed.
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  /// Adds a frame: sRGB, rows from the top. Throws StepError when ffmpeg fails, as on a full disk.
  void add(std::span<const std::uint8_t> rgb);
  void close();

 private:
  [[noreturn]] void fail();

  WholeFile file_;
  std::FILE* pipe_ = nullptr;
};

}  // namespace muro::host
