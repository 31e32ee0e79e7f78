// SPDX-License-Identifier: MIT
#include "tests/conformance/motion/recorded_contacts.hpp"

#include <fstream>
#include <sstream>

#include "tests/support/files.hpp"

namespace muro::conformance {

std::vector<RecordedContact> recorded_contacts(test::Scene& scene, const std::function<void()>& run) {
  const test::ScratchFolder folder;
  const std::string file = folder.path("contacts.csv");
  scene.use("recorder.contacts", 1000, {}, {{"file", file}});
  run();
  scene.finish();
  std::vector<RecordedContact> all;
  std::ifstream lines(file);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::vector<double> f;
    for (std::string field; std::getline(fields, field, ',');) f.push_back(std::strtod(field.c_str(), nullptr));
    all.push_back({{f.at(6), f.at(7), f.at(8)}, {f.at(10), f.at(11), f.at(12)}, f.at(9)});
  }
  return all;
}

}  // namespace muro::conformance
