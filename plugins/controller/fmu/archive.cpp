// SPDX-License-Identifier: MIT
#include "archive.hpp"

#include <sys/stat.h>
#include <unistd.h>
#include <zip.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <set>

#include "muro/algorithm.hpp"
#include "plugins/common/text/one_line.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::fmu {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view description_name = "modelDescription.xml";
constexpr std::size_t longest_name = 1024;

struct CloseZip {
  void operator()(zip_t* zip) const { zip_discard(zip); }
};
struct CloseEntry {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Returns the fault of an entry's name, as the end of a sentence; "" when the name stays within its folder.
std::string fault_of(std::string_view name) {
  if (name.empty()) return "which is empty";
  if (name.size() > longest_name) return "which is longer than " + std::to_string(longest_name) + " bytes";
  if (name.front() == '/' || (name.size() > 1 && name[1] == ':')) return "which is an absolute path";
  if (name.find('\\') != name.npos) return "which has a backslash; folders are separated by /";
  for (std::string_view rest = name; !rest.empty();) {
    const std::size_t end = std::min(rest.find('/'), rest.size());
    if (rest.substr(0, end) == "..") return "which leads out of its folder";
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return "";
}

/// Returns the name of an entry without the leading `./` that some programs write.
std::string plain(std::string name) {
  while (name.starts_with("./") && name.size() > 2) name.erase(0, 2);
  return name;
}

class Unpacking {
 public:
  Unpacking(const std::string& path, const fs::path& folder, const std::vector<std::string>& platforms,
            const ArchiveLimits& limits)
      : path_(path), folder_(folder), limits_(limits) {
    for (const std::string& p : platforms) wanted_.push_back("binaries/" + p + "/");
    wanted_.emplace_back("resources/");
  }

  Archive run() {
    int code = 0;
    zip_.reset(zip_open(path_.c_str(), ZIP_RDONLY, &code));
    if (!zip_) fail_to_open(code);
    const zip_int64_t count = zip_get_num_entries(zip_.get(), 0);
    if (std::uint64_t(count) > limits_.entries)
      throw Error(path_ + " holds " + std::to_string(count) + " files; at most " + std::to_string(limits_.entries) +
                  " are read");
    for (zip_int64_t i = 0; i < count; ++i) read_entry(zip_uint64_t(i));
    if (!found_description_)
      throw Error(path_ + " is no FMU: it holds no " + std::string(description_name) +
                  ", which stands at the top of the archive" +
                  (deeper_description_.empty()
                       ? ""
                       : "; it holds " + quote(deeper_description_) + ": pack what is in that folder, not the folder"));
    archive_.platforms.assign(platforms_.begin(), platforms_.end());
    return std::move(archive_);
  }

 private:
  [[noreturn]] void fail_to_open(int code) const {
    std::error_code unused;
    if (!fs::exists(path_, unused))
      throw Error("there is no FMU " + path_ + "; relative paths start at the scenario's folder");
    if (fs::is_directory(path_, unused))
      throw Error(path_ + " is a folder; an FMU is a zip archive of what is in it: (cd " + path_ +
                  " && zip -r ../NAME.fmu .)");
    if (is_cut_off(code))
      throw Error(path_ + " is a zip archive without an end: it was copied only in part; copy it again");
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string reason = one_line(zip_error_strerror(&error));
    zip_error_fini(&error);
    throw Error(path_ + " cannot be read as a zip archive: " + reason + "; an FMU is one");
  }
  /// Whether the file begins as a zip archive, but lacks the end record with the place of the list of files (22 bytes
  /// and a comment). libzip has one code for that and for other faults of the list.
  bool is_cut_off(int code) const {
    bool may_be = code == ZIP_ER_NOZIP;
#ifdef ZIP_ER_TRUNCATED_ZIP  // older versions do not have it
    may_be = may_be || code == ZIP_ER_TRUNCATED_ZIP;
#endif
    const std::unique_ptr<std::FILE, CloseFile> file(may_be ? std::fopen(path_.c_str(), "rbe") : nullptr);
    char begin[4] = {};
    if (!file || std::fread(begin, 1, sizeof begin, file.get()) != sizeof begin ||
        std::memcmp(begin, "PK\3\4", sizeof begin) != 0)
      return false;
    constexpr std::size_t record = 22, longest_comment = 65535;
    std::string end(record + longest_comment, '\0');
    if (std::fseek(file.get(), -long(end.size()), SEEK_END) != 0) std::rewind(file.get());  // the file is shorter
    end.resize(std::fread(end.data(), 1, end.size(), file.get()));
    const std::size_t at = end.rfind("PK\5\6");
    return at == end.npos || end.size() - at < record;
  }
  [[noreturn]] void fail(const std::string& name, const std::string& what) const {
    throw Error(path_ + ": file " + quote(name) + " of the archive " + what);
  }

  void read_entry(zip_uint64_t i) {
    const char* raw = zip_get_name(zip_.get(), i, ZIP_FL_ENC_RAW);
    const std::string name = plain(raw ? raw : "");
    if (const std::string fault = fault_of(name); !fault.empty())
      throw Error(path_ + " holds a file with the name " + quote(name) + ", " + fault + "; nothing of it is used");
    check_kind(i, name);
    if (name == description_name) {
      if (found_description_) fail(name, "is there twice");
      found_description_ = true;
      archive_.description = content(i, name, limits_.description_bytes);
      return;
    }
    if (name.ends_with("/" + std::string(description_name))) deeper_description_ = name;
    constexpr std::string_view binaries = "binaries/";
    if (name.starts_with(binaries)) {
      const std::size_t end = name.find('/', binaries.size());
      if (end != name.npos) platforms_.insert(name.substr(binaries.size(), end - binaries.size()));
    }
    const bool is_wanted =
        std::any_of(wanted_.begin(), wanted_.end(), [&](const std::string& w) { return name.starts_with(w); });
    if (!is_wanted) return;
    if (name.starts_with("resources/")) archive_.has_resources = true;
    write(i, name);
  }

  void check_kind(zip_uint64_t i, const std::string& name) const {
    zip_uint8_t system = 0;
    zip_uint32_t attributes = 0;
    if (zip_file_get_external_attributes(zip_.get(), i, 0, &system, &attributes) != 0 || system != ZIP_OPSYS_UNIX)
      return;
    const mode_t kind = (attributes >> 16) & S_IFMT;
    if (kind == S_IFLNK) fail(name, "is a symbolic link; an FMU holds files and folders only");
    if (kind != 0 && kind != S_IFREG && kind != S_IFDIR) fail(name, "is neither a file nor a folder");
  }

  /// Passes the bytes of an entry to `take`, in pieces. Limits apply to these bytes, not to the given sizes.
  template <class Take>
  void read(zip_uint64_t i, const std::string& name, std::uint64_t most, Take take) {
    const std::unique_ptr<zip_file_t, CloseEntry> file(zip_fopen_index(zip_.get(), i, 0));
    if (!file) {
      const bool is_packed_oddly = zip_error_code_zip(zip_get_error(zip_.get())) == ZIP_ER_COMPNOTSUPP;
      fail(name, "cannot be read: " + one_line(zip_strerror(zip_.get())) +
                     (is_packed_oddly ? "; pack it by `deflate`, as the standard says" : ""));
    }
    std::vector<char> buffer(1 << 16);
    std::uint64_t size = 0;
    while (true) {
      const zip_int64_t n = zip_fread(file.get(), buffer.data(), buffer.size());
      if (n < 0) fail(name, "cannot be read: " + one_line(zip_file_strerror(file.get())));
      if (n == 0) return;
      size += std::uint64_t(n);
      total_ += std::uint64_t(n);
      if (size > most)
        fail(name, "has more than " + std::to_string(most) + " bytes when unpacked, which is the most that is read");
      if (total_ > limits_.all_bytes)
        throw Error(path_ + " has more than " + std::to_string(limits_.all_bytes) +
                    " bytes when unpacked, which is the most that is read");
      take(std::string_view(buffer.data(), std::size_t(n)));
    }
  }

  std::string content(zip_uint64_t i, const std::string& name, std::uint64_t most) {
    std::string bytes;
    read(i, name, most, [&](std::string_view piece) { bytes += piece; });
    return bytes;
  }

  void write(zip_uint64_t i, const std::string& name) {
    const fs::path target = folder_ / name;
    std::error_code code;
    if (name.back() == '/') {
      fs::create_directories(target, code);
      if (code) fail(name, "cannot be written to " + target.string() + ": " + code.message());
      return;
    }
    fs::create_directories(target.parent_path(), code);
    const std::unique_ptr<std::FILE, CloseFile> file(code ? nullptr : std::fopen(target.c_str(), "wbxe"));
    if (!file && errno == EEXIST && !code) fail(name, "is there twice");
    if (!file)
      fail(name, "cannot be written to " + target.string() + ": " + (code ? code.message() : std::strerror(errno)));
    bool written = true;
    read(i, name, limits_.file_bytes, [&](std::string_view piece) {
      written = written && std::fwrite(piece.data(), 1, piece.size(), file.get()) == piece.size();
    });
    if (!written || std::fflush(file.get()) != 0)
      fail(name, "cannot be written to " + target.string() + ": " + std::strerror(errno));
  }

  const std::string& path_;
  const fs::path& folder_;
  ArchiveLimits limits_;
  std::vector<std::string> wanted_;  ///< name prefixes of the files to write
  std::unique_ptr<zip_t, CloseZip> zip_;
  Archive archive_;
  std::set<std::string> platforms_;
  std::uint64_t total_ = 0;
  bool found_description_ = false;
  std::string deeper_description_;  ///< name of a modelDescription.xml in a folder
};

}  // namespace

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

void PrivateFolder::create() {
  std::error_code code;
  const fs::path parent = fs::temp_directory_path(code);
  std::string pattern = (parent / "muro-fmu-XXXXXX").string();
  if (code || !mkdtemp(pattern.data()))  // mode 0700
    throw Error("no folder for an unpacked FMU can be made in " + (code ? "TMPDIR" : parent.string()) + ": " +
                (code ? code.message() : std::strerror(errno)) + "; set TMPDIR to a folder that may be written");
  path_ = pattern;
}

Archive unpack(const std::string& path, const fs::path& folder, const std::vector<std::string>& platforms,
               const ArchiveLimits& limits) {
  return Unpacking(path, folder, platforms, limits).run();
}

}  // namespace muro::fmu
