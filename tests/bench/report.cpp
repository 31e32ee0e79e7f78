// SPDX-License-Identifier: MIT
#include "tests/bench/report.hpp"

#include <unistd.h>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace muro::bench {

namespace {

using nlohmann::ordered_json;

/// The value of the first line of /proc/cpuinfo that begins with `what`.
std::string cpu_info(const std::string& what) {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind(what, 0) == 0 && line.find(':') + 2 < line.size()) return line.substr(line.find(':') + 2);
  return "unknown";
}

ordered_json machine() {
  const std::string flags = " " + cpu_info("flags") + " ";
  const auto has = [&](const char* flag) { return flags.find(std::string(" ") + flag + " ") != std::string::npos; };
  return {{"processor", cpu_info("model name")},
          {"cores", sysconf(_SC_NPROCESSORS_ONLN)},
          {"vectors", has("avx512f") ? "AVX-512"
                      : has("avx2")  ? "AVX2"
                                     : "SSE2"},
          {"virtual", has("hypervisor")},
          {"compiler", MURO_BENCH_COMPILER}};
}

std::string machine_line(const ordered_json& m) {
  return m["processor"].get<std::string>() + ", " + m["cores"].dump() + " cores, " + m["vectors"].get<std::string>() +
         (m["virtual"].get<bool>() ? ", virtual machine" : "") + ", " + m["compiler"].get<std::string>();
}

std::string text_of(const Cell& cell) {
  if (cell.is_string()) return cell.get<std::string>();
  std::string text = cell.dump();
  if (cell.is_number_integer())
    for (int at = int(text.size()) - 3; at > 0 && text.size() > 4; at -= 3) text.insert(std::size_t(at), " ");
  return text;
}

template <class Cells>
std::string line_of(const Cells& cells) {
  std::string line = "|";
  for (const auto& c : cells) line += " " + text_of(c) + " |";
  return line + "\n";
}

std::string head_of(const ordered_json& columns) {
  std::string rule = "|";
  for (std::size_t i = 0; i < columns.size(); ++i) rule += "---|";
  return "\n" + line_of(columns) + rule + "\n";
}

const ordered_json ratio_columns = {"ratio", "found", "target"};

std::string ratio_line(const ordered_json& r) { return line_of(ordered_json{r["what"], r["value"], r["target"]}); }

/// Returns the whole file as a page of Markdown.
std::string page(const ordered_json& all) {
  std::string out = "# Benchmarks\n\n" + machine_line(all["machine"]) + "\n" + head_of(ratio_columns);
  for (const auto& bench : all["benchmarks"])
    for (const auto& r : bench["ratios"]) out += ratio_line(r);
  for (const auto& bench : all["benchmarks"]) {
    out += "\n## " + bench["title"].get<std::string>() + "\n\n`" + bench["command"].get<std::string>() + "`\n";
    for (const auto& table : bench["tables"]) {
      out += "\n" + table["title"].get<std::string>() + "\n" + head_of(table["columns"]);
      for (const auto& row : table["rows"]) out += line_of(row);
    }
    for (const auto& note : bench["notes"]) out += "\n" + note.get<std::string>() + "\n";
  }
  return out;
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  if (!(file << text).flush()) throw std::runtime_error("cannot write " + path);
}

}  // namespace

Report::Report(const std::string& name, const std::string& title, int argc, char** argv)
    : name_(name), arguments_(argv + 1, argv + argc) {
  file_ = argument("json", "");
  std::string own;
  for (std::size_t i = 0; i + 1 < arguments_.size(); i += 2)
    if (arguments_[i] != "--json") own += " " + arguments_[i] + " " + arguments_[i + 1];
  const std::string command = "./dev bench " + name + (own.empty() ? "" : " --" + own);
  found_ = {{"name", name}, {"title", title}, {"command", command}};
  for (const char* list : {"ratios", "tables", "notes"}) found_[list] = ordered_json::array();
  std::printf("%s; %s\n", machine_line(machine()).c_str(), command.c_str());
}

std::string Report::argument(const std::string& name, const std::string& default_value) const {
  for (std::size_t i = 0; i + 1 < arguments_.size(); ++i)
    if (arguments_[i] == "--" + name) return arguments_[i + 1];
  return default_value;
}

void Report::table(const std::string& title, const std::vector<std::string>& columns) {
  found_["tables"].push_back({{"title", title}, {"columns", columns}, {"rows", ordered_json::array()}});
  std::printf("\n%s\n%s", title.c_str(), head_of(columns).c_str());
  std::fflush(stdout);
}

void Report::row(const std::vector<Cell>& cells) {
  ordered_json& table = found_["tables"].back();
  ordered_json values;
  for (std::size_t i = 0; i < cells.size(); ++i) values[table["columns"][i].get<std::string>()] = cells[i];
  table["rows"].push_back(values);
  std::printf("%s", line_of(values).c_str());
  std::fflush(stdout);
}

void Report::ratio(const std::string& what, double value, const std::string& target) {
  found_["ratios"].push_back({{"what", what}, {"value", fixed(value, 2)}, {"target", target}});
}

void Report::finish() {
  if (!found_["ratios"].empty()) std::printf("%s", head_of(ratio_columns).c_str());
  for (const auto& r : found_["ratios"]) std::printf("%s", ratio_line(r).c_str());
  for (const auto& n : found_["notes"]) std::printf("\n%s\n", n.get<std::string>().c_str());
  if (file_.empty()) return;
  ordered_json all = {{"machine", machine()}, {"benchmarks", ordered_json::array()}};
  if (std::ifstream there(file_); there) {
    const ordered_json before = ordered_json::parse(there);
    for (const auto& bench : before["benchmarks"])
      if (bench["name"] != name_) all["benchmarks"].push_back(bench);
  }
  all["benchmarks"].push_back(found_);
  write(file_, all.dump(1) + "\n");
  const std::size_t dot = file_.rfind(".json");
  write((dot == std::string::npos ? file_ : file_.substr(0, dot)) + ".md", page(all));
}

}  // namespace muro::bench
