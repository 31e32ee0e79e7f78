// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <span>
#include <string>

namespace muro::host {

/// A film, by ffmpeg: frames are handed to it one after the other, and the file is there when it is complete.
class Video {
 public:
  /// Throws SetupError where there is no ffmpeg.
  Video(std::string path, std::uint32_t width, std::uint32_t height, double frames_per_second);
  /// What was not closed is removed.
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  /// sRGB, rows from the top. Throws SetupError when ffmpeg takes no more.
  void add(std::span<const std::uint8_t> rgb);
  void close();

 private:
  [[noreturn]] void fail();

  std::string path_, part_;
  std::FILE* pipe_ = nullptr;
};

}  // namespace muro::host
