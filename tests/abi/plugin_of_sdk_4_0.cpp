// SPDX-License-Identifier: MIT
// A plugin as SDK 4.0 built it, written without the SDK from the record of its layout. Hosts of all later minor
// versions load it. Its sensor logs what it reads.
#include <Eigen/Core>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string_view>

namespace sdk_4_0 {

struct Stamp {
  char magic[8];
  std::uint32_t stamp_size, sdk_major, sdk_minor, pointer_size;
  char standard_library[16];
  std::uint32_t standard_library_abi, standard_library_debug, eigen_version, eigen_max_align_bytes,
      eigen_malloc_already_aligned, probe_size, probe_align, probe_layout;
  char compiler[64];
};

struct ErrorText {
  char buffer[2048];
};
struct Item {
  const void* robot;
  std::uint32_t object, level;
};
struct Step {
  std::int64_t time;
  double dt;
  std::uint64_t index, seed;
  std::uint32_t phase;
};
struct Range {
  std::uint32_t begin, end;
};
struct Phase;

struct ExtensionId {
  std::string_view name;
  std::uint32_t version, layout;
};
class Host {
 public:
  virtual void log(std::uint8_t level, std::string_view text) noexcept = 0;
  virtual void* find_extension(const ExtensionId& id) noexcept = 0;

 protected:
  ~Host() = default;
};
class Connector {
 public:
  virtual std::span<const Item> items() const noexcept = 0;
  virtual const void* parameters() const noexcept = 0;
  virtual const void* parameters_of(std::uint32_t i) const noexcept = 0;
  virtual Host& host() const noexcept = 0;

 protected:
  ~Connector() = default;
};
class AlgorithmInstance {
 public:
  virtual bool connect(Connector&, ErrorText&) noexcept = 0;
  virtual bool connect_by_name(Connector&, ErrorText&) noexcept = 0;
  virtual bool start(ErrorText&) noexcept = 0;
  virtual std::span<const Phase* const> phases() const noexcept = 0;
  virtual bool step(const Step&, Range, ErrorText&) noexcept = 0;
  virtual bool on_handover(std::uint32_t item, ErrorText&) noexcept = 0;
  virtual bool restored(ErrorText&) noexcept = 0;
  virtual bool finish(ErrorText&) noexcept = 0;
  virtual void destroy() noexcept = 0;

 protected:
  ~AlgorithmInstance() = default;
};

using Nothing = std::span<const char* const>;
struct Description {
  std::string_view id;
  std::uint8_t kind;
  std::string_view version, summary;
  Nothing parameters, reads, writes;
  std::uint32_t capabilities;
  std::uint64_t features;
};
struct AlgorithmEntry {
  const Description* description;
  AlgorithmInstance* (*create)(ErrorText*) noexcept;
};
struct PluginTable {
  Stamp stamp;
  std::uint32_t table_size;
  std::string_view name, version, licence, summary;
  std::span<const AlgorithmEntry> algorithms;
  Nothing readers;
  std::uint32_t layout;
};

constexpr std::uint8_t info = 1, sensor = 3;
constexpr std::uint32_t inspection_layout = 0xdcb9b3c4;

class Counter final : public AlgorithmInstance {
 public:
  bool connect(Connector& c, ErrorText&) noexcept override {
    host_ = &c.host();
    items_ = c.items().size();
    has_inspection_ = host_->find_extension({"muro.Inspection", 1, inspection_layout}) != nullptr;
    return true;
  }
  bool connect_by_name(Connector&, ErrorText&) noexcept override { return true; }
  bool start(ErrorText&) noexcept override { return true; }
  std::span<const Phase* const> phases() const noexcept override { return {}; }
  bool step(const Step& step, Range, ErrorText& error) noexcept override {
    time_ = step.time;
    if (step.index == ++steps_ - 1) return true;
    std::snprintf(error.buffer, sizeof error.buffer, "step %llu is not the next one",
                  static_cast<unsigned long long>(step.index));
    return false;
  }
  bool on_handover(std::uint32_t, ErrorText&) noexcept override { return true; }
  bool restored(ErrorText&) noexcept override { return true; }
  bool finish(ErrorText&) noexcept override {
    char text[128];
    std::snprintf(text, sizeof text, "%llu items, %llu steps, the last at %lld ns, %s",
                  static_cast<unsigned long long>(items_), static_cast<unsigned long long>(steps_),
                  static_cast<long long>(time_), has_inspection_ ? "with Inspection" : "without Inspection");
    host_->log(info, text);
    return true;
  }
  void destroy() noexcept override { delete this; }

 private:
  Host* host_ = nullptr;
  std::uint64_t items_ = 0, steps_ = 0;
  std::int64_t time_ = -1;
  bool has_inspection_ = false;
};

constexpr Description description{"sensor.of_sdk_4_0", sensor, "1.0.0", "Counts its steps", {}, {}, {}, 0, 0};
constexpr AlgorithmEntry algorithms[] = {
    {&description, [](ErrorText*) noexcept -> AlgorithmInstance* { return new Counter; }}};

}  // namespace sdk_4_0

extern "C" __attribute__((visibility("default"))) const sdk_4_0::PluginTable muro_plugin;
constinit const sdk_4_0::PluginTable muro_plugin{
    .stamp = {.magic = {'M', 'U', 'R', 'O', 'P', 'L', 'U', 'G'},
              .stamp_size = 136,
              .sdk_major = 4,
              .sdk_minor = 0,
              .pointer_size = 8,
              .standard_library = "libstdc++",
              .standard_library_abi = _GLIBCXX_USE_CXX11_ABI,
              .standard_library_debug = 0,
              .eigen_version = EIGEN_WORLD_VERSION * 10000 + EIGEN_MAJOR_VERSION * 100 + EIGEN_MINOR_VERSION,
              .eigen_max_align_bytes = 16,
              .eigen_malloc_already_aligned = 1,
              .probe_size = 368,
              .probe_align = 16,
              .probe_layout = 0x825c0d25,
              .compiler = "by hand"},
    .table_size = 248,
    .name = "of_sdk_4_0",
    .version = "1.0.0",
    .licence = "MIT",
    .summary = "A plugin of SDK 4.0",
    .algorithms = sdk_4_0::algorithms,
    .readers = {},
    .layout = 0xa0369903};
