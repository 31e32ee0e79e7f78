// SPDX-License-Identifier: MIT
// FMUs and robots for the tests of controller.fmu.
#pragma once

#include <gtest/gtest.h>
#include <zip.h>

#include <regex>

#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::fmu {

using Texts = std::vector<std::string>;
using Settings = std::map<std::string, ParameterInput>;

/// Parts that the build has made: model2.so, model3.so, ..., description_2.xml, ... and complete FMUs.
inline const std::string parts = FMU_PARTS "/";

/// Folder for libraries of this machine, by version of FMI.
inline const std::string platform_of[] = {"", "", "linux64", FMU_PLATFORM_3};

struct Entry {
  std::string name, bytes;
  unsigned mode = 0;  ///< Unix mode; 0: none is stored
};

/// Writes a zip archive.
inline void write_archive(const std::string& path, const std::vector<Entry>& entries) {
  int code = 0;
  zip_t* zip = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
  ASSERT_NE(zip, nullptr) << path;
  for (const Entry& e : entries) {
    zip_source_t* source = zip_source_buffer(zip, e.bytes.data(), e.bytes.size(), 0);
    const zip_int64_t i = zip_file_add(zip, e.name.c_str(), source, ZIP_FL_ENC_UTF_8);
    ASSERT_GE(i, 0) << zip_strerror(zip);
    if (e.mode != 0)
      zip_file_set_external_attributes(zip, zip_uint64_t(i), 0, ZIP_OPSYS_UNIX, zip_uint32_t(e.mode) << 16);
  }
  ASSERT_EQ(zip_close(zip), 0) << zip_strerror(zip);
}

/// All capability flags that are supported here.
inline const std::string able_2 =
    R"(canHandleVariableCommunicationStepSize="true" canGetAndSetFMUstate="true" canSerializeFMUstate="true")";
inline const std::string able_3 =
    R"(canHandleVariableCommunicationStepSize="true" canGetAndSetFMUState="true" canSerializeFMUState="true" mightReturnEarlyFromDoStep="true")";

inline std::string description(int version, const std::string& flags) {
  const std::string text = test::text_of(parts + "description_" + std::to_string(version) + ".xml");
  return std::regex_replace(text, std::regex("@flags@"), flags);
}

/// Writes an FMU with these flags. `library`: a library in `parts`; "" for model2 or model3.
inline void write_fmu(const std::string& path, int version, const std::string& flags, std::string library = "") {
  if (library.empty()) library = "model" + std::to_string(version);
  write_archive(path, {{"modelDescription.xml", description(version, flags)},
                       {"binaries/" + platform_of[version] + "/model.so", test::text_of(parts + library + ".so")}});
}

/// Returns values for inputs without a property, so that a test gives only some inputs.
inline Texts closed_inputs(int version) {
  Texts all{"u=0", "angle=0", "int_in=0", "bool_in=false", "choice_in=1"};
  if (version == 3)
    for (const char* name : {"f32", "i64", "u64", "i32", "u32", "i16", "u16", "i8", "u8"})
      all.push_back(std::string(name) + "_in=0");
  if (version == 3) all.insert(all.end(), {"vector_in=1 2 3", "bytes_in=00ff10203040"});
  return all;
}

/// Robots "a", "b", ... that move as commanded, at 20 Hz, with properties of any kind.
struct Bench : test::Scene {
  explicit Bench(int robots = 1) {
    const RobotTree tree = test::tree_of([](RobotBuilder& t) {
      t.base("body");
      t.set(keys::inertial, {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1});
    });
    a = &add("a", tree);
    if (robots > 1) b = &add("b", tree, {{4, 0, 0}, Quat::Identity()});
    for (int i = 2; i < robots; ++i) add(std::string(1, char('a' + i)), tree, {{4.0 * i, 0, 0}, Quat::Identity()});
    use("motion.point", 20, all_robots());
    set_log([this](LogLevel level, std::string_view text) {
      if (level >= LogLevel::info) said += std::string(text) + "\n";
    });
  }

  /// `values`: parameters of the FMU, in addition to the values for its other inputs.
  void control(const std::string& path, int version, Settings settings = {}, Texts values = {}, double rate = 10) {
    const Texts* in = std::get_if<Texts>(&settings["inputs"]);
    const Texts connected = in ? *in : Texts();
    for (const std::string& text : closed_inputs(version)) {
      const std::string name = text.substr(0, text.find('=') + 1);
      const auto is_of_it = [&](const std::string& i) { return i.starts_with(name); };
      if (std::none_of(connected.begin(), connected.end(), is_of_it) &&
          std::none_of(values.begin(), values.end(), is_of_it))
        values.push_back(text);
    }
    if (!in) settings.erase("inputs");
    settings["fmu"] = path;
    if (is_isolated) settings["isolate"] = std::string("process");
    settings["parameters"] = values;
    use("controller.fmu", rate, is_of_world ? std::vector<Item>{} : all_robots(), settings);
  }

  /// `outputs`: "variable=property" for the outputs that a test reads.
  void control(const std::string& path, int version, const Texts& outputs, Texts values = {}, double rate = 10) {
    control(path, version, Settings{{"outputs", outputs}}, std::move(values), rate);
  }

  /// Returns a property that the test writes and the FMU reads. It exists before the controllers search it.
  template <class T>
  T& source(const Key<T>& key, const T& value = {}) {
    return place(key, usage::variable, value);
  }
  /// Returns a property that the test reads and the FMU writes.
  template <class T>
  T& sink(const Key<T>& key, const T& value = {}) {
    return place(key, usage::input, value);
  }
  template <class T>
  T& place(const Key<T>& key, Usage usage, const T& value) {
    PropertyStore& store = world().store();
    return *static_cast<T*>(
        store.bind(store.add_accessor("the test"), a->base(), key, usage, Multiplicity::single, 1, &value));
  }
  Twist& command(const RobotView& r) { return world().value(r.base(), keys::command_twist); }

  const RobotView* a = nullptr;
  const RobotView* b = nullptr;
  bool is_of_world = false;  ///< one FMU, not for a robot
  bool is_isolated = false;  ///< each instance in a separate process
  std::string said;          ///< log lines
};

/// Returns the error message of a failed build, or run.
inline std::string refusal(Bench& bench) {
  return test::complaint_of([&] { bench.build(); });
}
inline std::string failure(Bench& bench, double seconds) {
  return test::complaint_of<StepError>([&] { bench.run_for(seconds); });
}

}  // namespace muro::fmu
