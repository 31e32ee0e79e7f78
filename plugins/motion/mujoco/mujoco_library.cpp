// SPDX-License-Identifier: MIT
#include "mujoco_library.hpp"

#include <algorithm>
#include <mutex>

#include "muro/algorithm.hpp"

namespace muro::mujoco {

namespace {

constexpr const char* too_big =
    "its memory grows with the square of the number of robots and ends at 2 GB; give some of the robots another "
    "`world`";

void raise(const char* text) { throw LibraryError{text}; }

/// The last warning of MuJoCo in this thread.
thread_local char last_warning[500];
void keep(const char* text) { std::snprintf(last_warning, sizeof last_warning, "%s", text); }

/// Guards the compiler: MuJoCo keeps the last file that it has read, one per process.
std::mutex& compiling() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

void catch_errors() {
  static std::once_flag once;
  std::call_once(once, [] {
    if (!mju_user_error) mju_user_error = &raise;
    if (!mju_user_warning) mju_user_warning = &keep;
  });
}

void WarningLog::tell(const std::string& text) {
  if (told_.insert(text).second) host_.log(LogLevel::warning, "motion.mujoco: MuJoCo says: " + text);
}

Model compile(const std::string& mjcf, WarningLog& warnings) {
  catch_errors();
  last_warning[0] = 0;
  const std::lock_guard lock(compiling());
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  constexpr const char* name = "muro.xml";
  if (mj_makeEmptyFileVFS(files.get(), name, int(mjcf.size())) != 0)
    throw Error("MuJoCo has no memory for its model, a text of " + std::to_string(mjcf.size()) + " bytes");
  std::copy(mjcf.begin(), mjcf.end(), static_cast<char*>(files->filedata[0]));
  char text[1000] = "";
  Model model;
  try {
    model.reset(mj_loadXML(name, files.get(), text, sizeof text));
  } catch (const LibraryError& e) {
    std::snprintf(text, sizeof text, "%s", e.text.c_str());
  }
  mj_deleteVFS(files.get());
  mj_freeLastXML();
  if (!model) {
    if (std::string_view(text).find("mjData") != std::string_view::npos)
      throw Error("this world is too big for MuJoCo: " + std::string(too_big));
    if (std::string_view(text).find("ELEMENT_DEPTH") != std::string_view::npos)
      throw Error(
          "a robot has a chain of joints that is longer than MuJoCo's reader takes, which is a little less than 100; "
          "fix some of them, or move it by motion.bullet or motion.simplified");
    std::replace(std::begin(text), std::end(text), '\n', ' ');
    throw Error("MuJoCo cannot make a model of this world; mend the link or joint that it names: " + std::string(text));
  }
  if (last_warning[0]) warnings.tell(last_warning);
  return model;
}

Data make_data(const mjModel& model) {
  catch_errors();
  Data data;
  try {
    data.reset(mj_makeData(&model));
  } catch (const LibraryError&) {
    data.reset();
  }
  if (!data)
    throw Error("MuJoCo has no memory for a world of " + std::to_string(model.nv) + " degrees of freedom and " +
                std::to_string(model.njmax) + " rows of constraints: " + too_big);
  return data;
}

}  // namespace muro::mujoco
