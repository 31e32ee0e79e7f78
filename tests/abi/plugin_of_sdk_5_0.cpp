// SPDX-License-Identifier: MIT
// A plugin whose SDK knows less of the structs that may grow than this host does, as SDK 5.0 will beside later minor
// versions: each of these structs ends early. Written from the record of the layout and without the SDK. Its sensor
// logs what it sees; its reader builds a robot with two shapes.
#include <Eigen/Core>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <span>
#include <string_view>

namespace sdk_5_0 {

struct Stamp {
  char magic[8];
  std::uint32_t stamp_size, sdk_major, sdk_minor, pointer_size;
  char standard_library[16];
  std::uint32_t standard_library_abi, standard_library_debug, eigen_version, eigen_max_align_bytes,
      eigen_malloc_already_aligned, probe_size, probe_align, probe_layout;
  char compiler[64];
};
template <class T>
struct Rows {
  const T* first = nullptr;
  std::uint32_t size = 0, stride = sizeof(T);
  const T& operator[](std::uint32_t i) const {
    return *reinterpret_cast<const T*>(reinterpret_cast<const char*>(first) + std::size_t(i) * stride);
  }
};

// --- structs that may grow, without their last members
struct Link {
  std::uint32_t object;
  std::int32_t parent;
};
struct RobotView {
  std::string_view name;
  std::uint32_t id;
  std::uint64_t key;
  Rows<Link> links;
};
struct Item {
  const RobotView* robot;
  std::uint32_t object;  // without `level`
};
struct ParameterValue {
  std::string_view name;
  double number;  // without texts and lists
};
struct Parameter {  // without `length` and `choices`
  std::string_view name;
  std::uint8_t type = 0;
  std::string_view unit = "1", doc{};
  bool is_required = false, tunable = false;
  double default_number = 0;
  std::string_view default_text{};
  std::span<const double> default_reals{};
  double min = -1e9, max = 1e9;
};
struct PropertyUse {  // without `when`
  std::string_view key, doc;
};
struct alignas(8) Phase {  // without `fine_grained` and `enabled`
  std::uint8_t index_space, scope;
};
struct Step {  // without `phase`
  std::int64_t time;
  double dt;
  std::uint64_t index, seed;
};
struct Description {  // without `features`
  std::string_view id;
  std::uint8_t kind;
  std::string_view version, summary;
  Rows<Parameter> parameters;
  Rows<PropertyUse> reads, writes;
  std::uint32_t capabilities;
};
struct ReaderDescription {
  std::string_view id, version, summary;
  std::span<const std::string_view> extensions;
};
struct alignas(16) Shape {  // without `surface` and `color`
  std::uint32_t kind = 0, mesh = 0, texture = 0, material_source = 0;
  double size[3] = {};
  double position[3] = {}, orientation[4] = {0, 0, 0, 1};
};

// --- structs and interfaces that stay
struct ErrorText {
  char buffer[2048];
};
struct Range {
  std::uint32_t begin, end;
};
struct ValueType {
  std::string_view name;
  std::uint32_t size, align;
  std::uint8_t scalar;
  std::span<const std::string_view> labels;
  bool grows;
};
struct KeyInfo {
  std::string_view name, unit;
  const ValueType* type;
  std::uint8_t role;
  std::string_view doc;
};
struct ExtensionId;
class Host {
 public:
  virtual void log(std::uint8_t level, std::string_view text) noexcept = 0;

 protected:
  ~Host() = default;
};
class Connector {
 public:
  virtual Rows<Item> items() const noexcept = 0;
  virtual const Rows<ParameterValue>& parameters() const noexcept = 0;
  virtual const Rows<ParameterValue>& parameters_of(std::uint32_t i) const noexcept = 0;
  virtual Host& host() const noexcept = 0;

 protected:
  ~Connector() = default;
};
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
class RobotBuilder {
 public:
  virtual void base(std::string_view name) noexcept = 0;
  virtual void fork() noexcept = 0;
  virtual void end() noexcept = 0;
  virtual void translation(const double* offset) noexcept = 0;
  virtual void rotation(const double* turn) noexcept = 0;
  virtual void revolute(std::string_view name, const double* axis, const void* limits) noexcept = 0;
  virtual void prismatic(std::string_view name, const double* axis, const void* limits) noexcept = 0;
  virtual void mimic(std::string_view leader, double multiplier, double offset) noexcept = 0;
  virtual void body(std::string_view name) noexcept = 0;
  virtual std::uint32_t intern(std::string_view text) noexcept = 0;
  virtual void report(std::uint8_t severity, std::string_view text, int line, int column) noexcept = 0;
  virtual void set_raw(const KeyInfo& key, const void* data, std::uint32_t count) noexcept = 0;

 protected:
  ~RobotBuilder() = default;
};
class ReaderInstance {
 public:
  virtual bool read(std::string_view path, RobotBuilder&, ErrorText&) noexcept = 0;
  virtual void destroy() noexcept = 0;
  virtual bool read_world(std::string_view path, void* builder, ErrorText&) noexcept = 0;

 protected:
  ~ReaderInstance() = default;
};
template <class Of, class Instance>
struct Entry {
  const Of* description;
  Instance* (*create)(ErrorText*) noexcept;
  std::uint64_t description_size = sizeof(Of);
};
struct PluginTable {
  Stamp stamp;
  std::uint32_t table_size;
  std::string_view name, version, licence, summary;
  std::span<const Entry<Description, AlgorithmInstance>> algorithms;
  std::span<const Entry<ReaderDescription, ReaderInstance>> readers;
  std::uint32_t layout;
};

class Counter final : public AlgorithmInstance {
 public:
  bool connect(Connector& c, ErrorText&) noexcept override {
    host_ = &c.host();
    const Rows<Item> items = c.items();
    for (std::uint32_t i = 0; i < items.size; ++i) {
      const Rows<Link>& links = items[i].robot->links;
      for (std::uint32_t k = 0; k < links.size; ++k) parents_ += links[k].parent;
      objects_ += items[i].object == links[0].object;
    }
    for (std::uint32_t i = 0; i < c.parameters().size; ++i) sum_ += c.parameters()[i].number;
    return true;
  }
  bool connect_by_name(Connector&, ErrorText&) noexcept override { return true; }
  bool start(ErrorText&) noexcept override { return true; }
  Rows<Phase> phases() const noexcept override {
    static constexpr Phase all[] = {{1, 0}, {1, 1}, {0, 1}};  // items, items, whole
    return {all, 3};
  }
  bool step(const Step&, Range range, ErrorText&) noexcept override {
    served_ += range.end - range.begin;
    return true;
  }
  bool on_handover(std::uint32_t, ErrorText&) noexcept override { return true; }
  bool restored(ErrorText&) noexcept override { return true; }
  bool finish(ErrorText&) noexcept override {
    char text[160];
    std::snprintf(text, sizeof text, "parameters %g, parents %d, bases %d, served %d", sum_, parents_, objects_,
                  int(served_));
    host_->log(1, text);
    return true;
  }
  void destroy() noexcept override { delete this; }
  void* find_extension(const ExtensionId&) noexcept override { return nullptr; }

 private:
  Host* host_ = nullptr;
  double sum_ = 0;
  int parents_ = 0, objects_ = 0;
  std::uint32_t served_ = 0;
};

class Reader final : public ReaderInstance {
 public:
  bool read(std::string_view, RobotBuilder& builder, ErrorText&) noexcept override {
    static constexpr ValueType shape{"muro.Shape", sizeof(Shape), alignof(Shape), 7, {}, true};
    const double up[3] = {0, 0, 1};
    builder.base("base");
    const KeyInfo key{"collision.shapes", "m", &shape, 0, {}};
    const Shape shapes[2] = {{.kind = 0, .size = {1, 2, 3}}, {.kind = 1, .size = {4, 0, 0}, .position = {5, 6, 7}}};
    builder.set_raw(key, shapes, 2);
    builder.translation(up);
    builder.body("head");
    return true;
  }
  void destroy() noexcept override { delete this; }
  bool read_world(std::string_view, void*, ErrorText&) noexcept override { return false; }
};

constexpr Parameter parameters[] = {{.name = "first", .default_number = 3}, {.name = "second", .default_number = 4}};
constexpr PropertyUse reads[] = {{"pose", "of the base"}, {"twist", "of the base"}};
constexpr Description description{"sensor.of_sdk_5_0", 3,          "1.0.0", "Counts what it sees",
                                  {parameters, 2},     {reads, 2}, {},      0};
constexpr std::string_view extensions[] = {".of_sdk_5_0"};
constexpr ReaderDescription reader_description{"reader.of_sdk_5_0", "1.0.0", "Builds two shapes", extensions};
constexpr Entry<Description, AlgorithmInstance> algorithms[] = {
    {&description, [](ErrorText*) noexcept -> AlgorithmInstance* { return new Counter; }}};
constexpr Entry<ReaderDescription, ReaderInstance> readers[] = {
    {&reader_description, [](ErrorText*) noexcept -> ReaderInstance* { return new Reader; }}};

}  // namespace sdk_5_0

extern "C" __attribute__((visibility("default"))) const sdk_5_0::PluginTable muro_plugin;
constinit const sdk_5_0::PluginTable muro_plugin{
    .stamp = {.magic = {'M', 'U', 'R', 'O', 'P', 'L', 'U', 'G'},
              .stamp_size = 136,
              .sdk_major = 5,
              .sdk_minor = 0,
              .pointer_size = 8,
              .standard_library = "libstdc++",
              .standard_library_abi = _GLIBCXX_USE_CXX11_ABI,
              .standard_library_debug = 0,
              .eigen_version = EIGEN_WORLD_VERSION * 10000 + EIGEN_MAJOR_VERSION * 100 + EIGEN_MINOR_VERSION,
              .eigen_max_align_bytes = 16,
              .eigen_malloc_already_aligned = 1,
              .probe_size = 280,
              .probe_align = 8,
              .probe_layout = 0x1aaa705f,
              .compiler = "by hand"},
    .table_size = 248,
    .name = "of_sdk_5_0",
    .version = "1.0.0",
    .licence = "MIT",
    .summary = "A plugin of SDK 5.0",
    .algorithms = sdk_5_0::algorithms,
    .readers = sdk_5_0::readers,
    .layout = 0x70520132};
