// SPDX-License-Identifier: MIT
#include "host/outputs/output_file.hpp"

#include "core/error.hpp"
#include "muro/base/whole_file.hpp"

namespace muro::host {

void write_file(const std::string& path, const std::string& text) {
  try {
    WholeFile file(path);
    file.write(text);
    file.publish();
  } catch (const Error& e) {
    throw StepError(e.what());
  }
}

}  // namespace muro::host
