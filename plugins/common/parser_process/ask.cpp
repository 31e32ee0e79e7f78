// SPDX-License-Identifier: MIT
#include "ask.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "muro/base/whole_library.hpp"
#include "protocol.hpp"

namespace muro::parser_process {

namespace {

namespace fs = std::filesystem;

/// Returns folders of the client library: beside the library or program that asks, in MURO_PLUGIN_PATH, and in the
/// user's folder.
std::vector<fs::path> folders() {
  std::vector<fs::path> found;
  Dl_info here{};
  if (dladdr(reinterpret_cast<const void*>(&folders), &here) != 0 && here.dli_fname) {
    std::error_code none;
    fs::path folder = fs::canonical(here.dli_fname, none).parent_path();
    // dladdr gives for a program only the name it was started with
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

/// Functions of the client library; if there is none, the reason.
struct ClientLibrary {
  AskFunction ask = nullptr;
  ShareFunction share = nullptr;
  ReleaseFunction release = nullptr;
  std::string missing;
};

template <class Function>
bool find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(library ? dlsym(library, name) : nullptr);
  return function != nullptr;
}

ClientLibrary load_client() {
  ClientLibrary client;
  std::string searched;
  for (const fs::path& folder : folders()) {
    const fs::path file = folder / client_file;
    std::error_code none;
    if (fs::is_regular_file(file, none)) {
      if (const std::string missing = missing_part_of_library(file.string()); !missing.empty()) {
        client.missing = file.string() + " cannot be loaded: " + missing;
        return client;
      }
      // never closed, because it holds the process that all libraries share
      void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
      if (find(library, ask_symbol, client.ask) && find(library, share_symbol, client.share) &&
          find(library, release_symbol, client.release))
        return client;
      const char* const why = dlerror();
      client.missing = "the library of the parser process cannot be loaded: ";
      client.missing += why ? std::string(why) : file.string() + " is of another muro";
      client.missing += "; install muro again";
      return client;
    }
    if (!searched.empty()) searched += ", ";
    searched += folder.string();
  }
  client.missing = "the program that reads such files, muro_parser, is not there (searched: " + searched +
                   "); install muro again, or set MURO_PLUGIN_PATH to the folder of its plugins";
  return client;
}

const ClientLibrary& client_library() {
  static const ClientLibrary client = load_client();
  return client;
}

/// Memory on the heap.
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

[[noreturn]] void fail(const Question& question, Ending ending, const std::string& text) {
  const std::string unread = question.subject + " cannot be read: ";
  if (ending == Ending::refused) throw Error(text);
  if (ending == Ending::no_service)
    throw Error(unread + "this muro was built without; install " + question.needs + ", configure and build again");
  throw Error(unread + text + (ending == Ending::no_process ? "" : "; " + question.advice));
}

const ClientLibrary& client_for(const Question& question) {
  const ClientLibrary& client = client_library();
  if (!client.missing.empty()) throw Error(question.subject + " cannot be read: " + client.missing);
  return client;
}

}  // namespace

Answer ask(const Question& question, std::span<const std::byte> request) {
  HeapSink sink;
  const auto ending = Ending(client_for(question).ask(question.service, request.data(), request.size(), &sink));
  if (ending != Ending::answered) fail(question, ending, sink.text());
  Answer answer;
  answer.bytes_ = std::move(sink.bytes);
  answer.size_ = sink.size;
  return answer;
}

SharedBytes ask_shared(const Question& question, std::span<const std::byte> request, const std::string& version) {
  const ClientLibrary& client = client_for(question);
  HeapSink sink;
  SharedAnswer answer;
  const auto ending =
      Ending(client.share(question.service, request.data(), request.size(), version.c_str(), &answer, &sink));
  if (ending != Ending::answered) fail(question, ending, sink.text());
  return {{static_cast<const std::byte*>(answer.bytes), answer.size}, {answer.handle, client.release}};
}

}  // namespace muro::parser_process
