// SPDX-License-Identifier: MIT
#include "library.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "muro/algorithm.hpp"

namespace muro::mjcf {

namespace {

struct LibraryError {
  std::string text;
};
void raise_error(const char* text) { throw LibraryError{text}; }

thread_local char last_warning[500];
void keep_warning(const char* text) { std::snprintf(last_warning, sizeof last_warning, "%s", text); }

/// Installs handlers. Without them errors would end the process, and warnings would be written to a file.
void catch_errors() {
  if (!mju_user_error) mju_user_error = &raise_error;
  if (!mju_user_warning) mju_user_warning = &keep_warning;
}

/// Joins the lines of a text of MuJoCo; empty lines are dropped.
std::string in_one_line(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (c != '\n' && c != '\r')
      out += c;
    else if (!out.empty() && !out.ends_with("; "))
      out += "; ";
  while (out.ends_with(' ') || out.ends_with(';')) out.pop_back();
  return out;
}

/// A file in memory, to which a library writes by its path.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("muro-mjcf", MFD_CLOEXEC)) {}
  ~MemoryFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
  std::string text() const {
    std::string all;
    char part[1 << 16];
    off_t at = 0;
    for (ssize_t n; descriptor_ >= 0 && (n = pread(descriptor_, part, sizeof part, at)) > 0; at += n)
      all.append(part, std::size_t(n));
    return all;
  }

 private:
  int descriptor_;
};

/// Returns the model that was compiled last, as MuJoCo writes it; empty if MuJoCo cannot write it.
std::string canonical_text(const mjModel& m) {
  const MemoryFile file;
  char error[1000] = "";
  if (mj_saveLastXML(file.path().c_str(), &m, error, sizeof error) != 1) return "";
  return file.text();
}

}  // namespace

Compiled compile(const std::string& text, const std::string& path) {
  catch_errors();
  last_warning[0] = 0;
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  if (path.size() >= sizeof files->filename[0])
    throw Error("the path of the file is longer than the " + std::to_string(sizeof files->filename[0] - 1) +
                " bytes that MuJoCo takes");
  if (mj_makeEmptyFileVFS(files.get(), path.c_str(), int(text.size())) != 0)
    throw Error("MuJoCo has no memory for a file of " + std::to_string(text.size()) + " bytes");
  std::copy(text.begin(), text.end(), static_cast<char*>(files->filedata[0]));
  Compiled out;
  char error[1000] = "";
  try {
    out.model.reset(mj_loadXML(path.c_str(), files.get(), error, sizeof error));
    if (out.model && out.model->nmesh + out.model->nhfield > 0) out.canonical = canonical_text(*out.model);
  } catch (const LibraryError& e) {
    out.model.reset();
    std::snprintf(error, sizeof error, "%s", e.text.c_str());
  }
  mj_deleteVFS(files.get());
  mj_freeLastXML();
  out.warning = in_one_line(last_warning);
  if (!out.model) out.error = in_one_line(error);
  if (!out.model && out.error.empty()) out.error = "it gives no reason";
  return out;
}

}  // namespace muro::mjcf
