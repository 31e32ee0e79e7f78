// SPDX-License-Identifier: MIT
// The boundary between host and plugin: what crosses it, and the stamp that says whether it may.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "muro/algorithm.hpp"
#include "muro/model_reader.hpp"

namespace muro::abi {

inline constexpr std::uint32_t sdk_major = 5;
inline constexpr std::uint32_t sdk_minor = 0;

/// The C-only head of a plugin's table. Hosts read nothing else before all fields agree with theirs.
struct Stamp {
  char magic[8];             ///< "MUROPLUG"
  std::uint32_t stamp_size;  ///< sizeof(Stamp)
  std::uint32_t sdk_major;
  std::uint32_t sdk_minor;  ///< the host's may be newer
  std::uint32_t pointer_size;
  char standard_library[16];
  std::uint32_t standard_library_abi;    ///< _GLIBCXX_USE_CXX11_ABI, or libc++'s ABI version
  std::uint32_t standard_library_debug;  ///< _GLIBCXX_DEBUG changes the layout of containers
  std::uint32_t eigen_version;
  std::uint32_t eigen_max_align_bytes;
  std::uint32_t eigen_malloc_already_aligned;
  std::uint32_t probe_size;
  std::uint32_t probe_align;
  std::uint32_t probe_layout;  ///< hash of the places of its parts: padding hides what moves within a struct
  char compiler[64];           ///< printed, never compared
};

/// Text of a failure, copied across the boundary.
class ErrorText {
 public:
  ErrorText() { buffer_[0] = 0; }  // an error writes the other bytes
  void set(std::string_view text) noexcept {
    const std::size_t n = std::min(text.size(), sizeof buffer_ - 1);
    std::memcpy(buffer_, text.data(), n);
    buffer_[n] = 0;
  }
  std::string_view view() const noexcept { return buffer_; }

 private:
  char buffer_[2048];
};

/// An algorithm as the host holds it: nothing throws; false means failure, with a text. Later minor versions add
/// functions at the end, which a host does not call on plugins of older versions.
class AlgorithmInstance {
 public:
  virtual bool connect(Connector&, ErrorText&) noexcept = 0;
  virtual bool connect_by_name(Connector&, ErrorText&) noexcept = 0;
  virtual bool start(ErrorText&) noexcept = 0;
  virtual Rows<Phase> phases() const noexcept = 0;
  virtual bool step(const Step&, Range, ErrorText&) noexcept = 0;
  virtual bool on_handover(std::uint32_t item, ErrorText&) noexcept = 0;
  virtual bool restored(ErrorText&) noexcept = 0;
  virtual bool finish(ErrorText&) noexcept = 0;
  virtual void destroy() noexcept = 0;
  virtual void* find_extension(const ExtensionId&) noexcept = 0;

 protected:
  ~AlgorithmInstance() = default;
};

class ReaderInstance {
 public:
  virtual bool read(std::string_view path, RobotBuilder&, ErrorText&) noexcept = 0;
  virtual void destroy() noexcept = 0;
  virtual bool read_world(std::string_view path, WorldBuilder&, ErrorText&) noexcept = 0;

 protected:
  ~ReaderInstance() = default;
};

struct AlgorithmEntry {
  const Description* description;
  AlgorithmInstance* (*create)(ErrorText*) noexcept;
  std::uint64_t description_size;  ///< bytes of `description`
};
struct ReaderEntry {
  const ReaderDescription* description;
  ReaderInstance* (*create)(ErrorText*) noexcept;
  std::uint64_t description_size;  ///< bytes of `description`
};

/// The only symbol that a plugin exports: `extern "C" const muro::abi::PluginTable muro_plugin`.
struct PluginTable {
  Stamp stamp;
  std::uint32_t table_size;
  std::string_view name;
  std::string_view version;
  std::string_view licence;
  std::string_view summary;
  std::span<const AlgorithmEntry> algorithms;
  std::span<const ReaderEntry> readers;
  std::uint32_t layout;  ///< layout_of_contract()
};

inline constexpr char table_symbol[] = "muro_plugin";

}  // namespace muro::abi
