// SPDX-License-Identifier: MIT
// FMUs: archives, model descriptions, and their variables in a scenario.
#include <sstream>

#include "muro/algorithm.hpp"
#include "plugins/controller/fmu/archive.hpp"
#include "plugins/controller/fmu/input_table.hpp"
#include "plugins/controller/fmu/mapping.hpp"
#include "plugins/controller/fmu/model_description.hpp"
#include "tests/fuzz/target.hpp"

namespace muro::fuzz {

namespace {

const fmu::ArchiveLimits limits{
    .entries = 100, .file_bytes = 1 << 20, .all_bytes = 2 << 20, .description_bytes = 1 << 20};

const char* const some_variables = R"(<fmiModelDescription fmiVersion="3.0" modelName="m" instantiationToken="t">
<CoSimulation modelIdentifier="m"/><ModelVariables>
<Float64 name="in" valueReference="1" causality="input" start="0"/>
<Float64 name="out[1]" valueReference="2" causality="output"/>
<Float64 name="'a=b'" valueReference="3" causality="parameter" variability="tunable" start="0"/>
</ModelVariables></fmiModelDescription>)";

void read_archive(Bytes bytes) {
  fmu::PrivateFolder folder;
  folder.create();
  const fmu::Archive archive = fmu::unpack(file_with(bytes, "x.fmu"), folder.path(), {"linux64"}, limits);
  for (const auto& file : std::filesystem::recursive_directory_iterator(folder.path()))
    require(file.is_directory() || (file.is_regular_file() && file.file_size() <= limits.file_bytes),
            "an archive has written what it must not");
  fmu::read_model_description(archive.description, "x.fmu");
}

const fmu::ModelDescription& variables() {
  static const fmu::ModelDescription description = fmu::read_model_description(some_variables, "x.fmu");
  return description;
}

/// Reads lines of "PARAMETER TEXT".
void read_mappings(const std::string& text) {
  const fmu::ModelDescription& description = variables();
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t blank = std::min(line.find(' '), line.size());
    const std::string_view mapping = std::string_view(line).substr(std::min(blank + 1, line.size()));
    const std::string parameter = line.substr(0, blank);
    if (parameter == "inputs" || parameter == "outputs")
      fmu::read_mapping(parameter, std::span(&mapping, 1), description);
    else
      fmu::read_start_values(std::span(&mapping, 1), description);
  }
}

}  // namespace

/// Reads an archive, a table of inputs, a model description, or lines of a scenario, depending on the first bytes.
void read_as_fmu(Bytes bytes) {
  const std::string text = text_of(bytes);
  try {
    if (text.starts_with("PK"))
      read_archive(bytes);
    else if (text.starts_with("time") || text.starts_with("\"time"))
      fmu::InputTable(file_with(bytes, "x.csv"), variables());
    else if (text.starts_with("inputs") || text.starts_with("outputs") || text.starts_with("parameters"))
      read_mappings(text);
    else
      for (const fmu::Variable& v : fmu::read_model_description(text, "x.fmu").variables)
        require(v.size <= 1'000'000, "an array is too long");
  } catch (const Error& e) {
    outcome(e.what());
  }
}

}  // namespace muro::fuzz
