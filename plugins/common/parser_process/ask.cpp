// SPDX-License-Identifier: MIT
#include "ask.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "muro/toolkit/whole_library.hpp"
#include "protocol.hpp"

namespace muro::parser_process {

namespace {

namespace fs = std::filesystem;

/// Where the client library may be: beside the library or program that asks, in MURO_PLUGIN_PATH, and in the user's
/// folder.
std::vector<fs::path> folders() {
  std::vector<fs::path> found;
  Dl_info here{};
  if (dladdr(reinterpret_cast<const void*>(&folders), &here) != 0 && here.dli_fname) {
    std::error_code none;
    fs::path folder = fs::canonical(here.dli_fname, none).parent_path();
    // a program knows itself by the name it was started with
    if (none) folder = fs::canonical("/proc/self/exe", none).parent_path();
    found.push_back(folder / "parser");
    found.push_back(folder.parent_path() / "lib" / "muro" / "parser");
  }
  const char* path = std::getenv("MURO_PLUGIN_PATH");
  std::string_view rest = path ? path : "";
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    if (end > 0) found.push_back(fs::path(rest.substr(0, end)) / "parser");
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (const char* home = std::getenv("HOME")) found.push_back(fs::path(home) / ".local" / "lib" / "muro" / "parser");
  return found;
}

/// The function of the client library; where there is none, null and the reason.
AskFunction load_client(std::string& reason) {
  std::string searched;
  for (const fs::path& folder : folders()) {
    const fs::path file = folder / client_file;
    std::error_code none;
    if (fs::is_regular_file(file, none)) {
      if (const std::string missing = missing_part_of_library(file.string()); !missing.empty()) {
        reason = file.string() + " cannot be loaded: " + missing;
        return nullptr;
      }
      // never closed: it holds the process that all libraries share
      void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
      void* const function = library ? dlsym(library, ask_symbol) : nullptr;
      if (function) return reinterpret_cast<AskFunction>(function);
      const char* const why = dlerror();
      reason = "the library of the parser process cannot be loaded: ";
      reason += why ? std::string(why) : file.string() + " is of another muro";
      reason += "; install muro again";
      return nullptr;
    }
    if (!searched.empty()) searched += ", ";
    searched += folder.string();
  }
  reason = "the program that reads such files, muro_parser, is not there (searched: " + searched +
           "); install muro again, or set MURO_PLUGIN_PATH to the folder of its plugins";
  return nullptr;
}

/// Room on the heap.
struct HeapSink : Sink {
  std::unique_ptr<std::byte[]> bytes{};
  std::size_t size = 0;

  HeapSink() : Sink{&HeapSink::make_room} {}
  static void* make_room(Sink* sink, std::uint64_t size) noexcept {
    auto& self = *static_cast<HeapSink*>(sink);
    self.bytes.reset(new (std::nothrow) std::byte[size]);
    self.size = self.bytes ? size : 0;
    return self.bytes.get();
  }
  std::string text() const { return {reinterpret_cast<const char*>(bytes.get()), size}; }
};

}  // namespace

Answer ask(const Question& question, std::span<const std::byte> request) {
  static std::string missing;
  static const AskFunction client = load_client(missing);
  if (!client) throw Error(question.subject + " cannot be read: " + missing);
  HeapSink sink;
  switch (Ending(client(question.service, request.data(), request.size(), &sink))) {
    case Ending::answered: {
      Answer answer;
      answer.bytes_ = std::move(sink.bytes);
      answer.size_ = sink.size;
      return answer;
    }
    case Ending::refused:
      throw Error(sink.text());
    case Ending::no_service:
      throw Error(question.subject + " cannot be read: this muro was built without; install " + question.needs +
                  ", configure and build again");
    case Ending::no_process:
      throw Error(question.subject + " cannot be read: " + sink.text());
    default:
      throw Error(question.subject + " cannot be read: " + sink.text() + "; " + question.advice);
  }
}

}  // namespace muro::parser_process
