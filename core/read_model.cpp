// SPDX-License-Identifier: MIT
#include "core/read_model.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <functional>

#include "core/c_locale.hpp"
#include "core/error.hpp"
#include "core/missing_file.hpp"
#include "core/running_call.hpp"

namespace muro {
namespace {

using Read = std::function<bool(abi::ReaderInstance&, const std::string& path, abi::ErrorText&)>;

/// Reads a file. `what` names the file in messages: "model rover.urdf".
void read_file(Registry& registry, const std::string& path, const std::string& what, const Read& read) {
  const CLocale locale;
  std::error_code code;
  const bool exists = std::filesystem::exists(path, code);
  if (code) throw SetupError(fmt::format("{} cannot be read: {}", what, code.message()));
  if (!exists) throw SetupError(what + why_missing(path));
  abi::ErrorText error;
  abi::ReaderInstance* reader = registry.reader_for(path).create(&error);
  if (!reader) throw SetupError(fmt::format("the reader for {} cannot be created: {}", path, error.view()));
  const Callee callee{.name = what};
  const CallScope scope(callee, "read");
  const std::string absolute = std::filesystem::absolute(path, code).string();
  const bool fine = read(*reader, code ? path : absolute, error);
  reader->destroy();
  if (!fine) throw SetupError(fmt::format("{}: {}", what, error.view()));
}

void check_problems(const std::vector<RobotTree::Problem>& found, const std::string& what) {
  std::vector<std::string> problems;
  for (const RobotTree::Problem& p : found)
    if (p.severity == Severity::error)
      problems.push_back(p.line > 0 ? fmt::format("{}:{}:{}: {}", what, p.line, p.column, p.text)
                                    : fmt::format("{}: {}", what, p.text));
  if (!problems.empty()) throw SetupError(problems);
}

}  // namespace

RobotTree read_model(Registry& registry, const std::string& path, std::span<const PackageFolder> packages) {
  RobotTree tree;
  tree.set_packages(packages);
  const std::string what = "model " + path;
  read_file(registry, path, what, [&](abi::ReaderInstance& reader, const std::string& file, abi::ErrorText& error) {
    return reader.read(file, tree, error);
  });
  tree.set_packages({});
  if (tree.usable()) tree.close();
  check_problems(tree.problems(), what);
  return tree;
}

WorldModel read_world(Registry& registry, const std::string& path, std::span<const PackageFolder> packages) {
  WorldModel world;
  world.set_packages(packages);
  const std::string what = "world " + path;
  read_file(registry, path, what, [&](abi::ReaderInstance& reader, const std::string& file, abi::ErrorText& error) {
    return reader.read_world(file, world, error);
  });
  world.set_packages({});
  world.close();
  check_problems(world.problems(), what);
  return world;
}

}  // namespace muro
