// SPDX-License-Identifier: MIT
#include "tests/models/model_table.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace muro::test {

namespace {

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  return begin == text.npos ? "" : text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

std::vector<std::string> columns_of(const std::string& line) {
  std::vector<std::string> columns;
  std::istringstream rest(line);
  for (std::string column; std::getline(rest, column, '|');) columns.push_back(trimmed(column));
  return columns;
}

}  // namespace

std::string models_folder() { return MODELS; }

std::vector<ModelCase> model_cases() {
  std::ifstream file(models_folder() + "/models.txt");
  std::vector<ModelCase> cases;
  for (std::string line; std::getline(file, line);) {
    if (trimmed(line).empty() || line[0] == '#') continue;
    const std::vector<std::string> columns = columns_of(line);
    if (columns.size() < 2) throw std::runtime_error("models.txt needs a file and a result: " + line);
    ModelCase c;
    c.file = columns[0];
    c.said.assign(columns.begin() + 2, columns.end());
    std::istringstream result(columns[1]);
    std::string word;
    if (columns[1] == "refused")
      c.is_refused = true;
    else if (!(result >> c.links >> word) || (c.is_world() && !(result >> c.models >> word)))
      throw std::runtime_error("models.txt knows `refused`, `3 links` and `1 object 2 models` as results: " + line);
    cases.push_back(std::move(c));
  }
  return cases;
}

}  // namespace muro::test
