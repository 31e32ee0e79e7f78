// SPDX-License-Identifier: MIT
// MuJoCo as a library: ownership of its objects, and its errors as exceptions.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <set>
#include <string>

#include "muro/connector.hpp"

namespace muro::mujoco {

struct Deleter {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
  void operator()(mjData* d) const { mj_deleteData(d); }
};
using Model = std::unique_ptr<mjModel, Deleter>;
using Data = std::unique_ptr<mjData, Deleter>;

inline Vec3 vector_of(const mjtNum* v) { return {v[0], v[1], v[2]}; }

/// An error of MuJoCo. It would end the process: see catch_errors.
struct LibraryError {
  std::string text;
};

/// Logs warnings of MuJoCo's compiler through a host, each text once.
class WarningLog {
 public:
  explicit WarningLog(Host& host) : host_(host) {}
  void tell(const std::string& text);

 private:
  Host& host_;
  std::set<std::string> told_;
};

/// Makes errors of MuJoCo in this process throw LibraryError from now on, unless the process has its own handler.
/// Warnings are neither printed nor written to a file; warnings of steps are in mjData::warning. [any thread]
void catch_errors();

/// Compiles a model. Throws muro::Error with the compiler's text. [any thread]
Model compile(const std::string& mjcf, WarningLog& warnings);

/// Makes data for a model. Throws muro::Error when there is no memory for it. [any thread]
Data make_data(const mjModel& model);

}  // namespace muro::mujoco
