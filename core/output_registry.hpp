// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "muro/ext/outputs.hpp"

namespace muro {

/// Files that cannot be written, or must not be written.
class OutputError final : public SetupError {
 public:
  using SetupError::SetupError;
};

/// Files that a simulation reads and writes, to be checked before it runs. Two names are one file when they lead to it
/// by any path or link.
class OutputRegistry final : public Outputs {
 public:
  /// Sets the owner of the files that are named from now on, as in messages: "log (recorder.csv, urban.yaml:7:3)",
  /// "--report".
  void set_owner(std::string owner) { owner_ = std::move(owner); }
  void file(std::string_view path) noexcept override;
  void series(std::string_view begin, std::string_view end) noexcept override;
  /// Adds a file that the present owner reads, and may write. A path counts once. `what`: "the scenario", "which log
  /// reads".
  void add_input(const std::string& path, const std::string& what);

  /// Whether anything is written.
  bool empty() const { return outputs_.empty(); }
  /// Throws OutputError with all mistakes: two outputs in one file, an output in place of an input, a missing folder.
  void check() const;

 private:
  /// The file to which a name leads.
  struct Place {
    std::string target;       ///< without links
    std::uint64_t number[2];  ///< device and inode of the file there
    int error = 0;            ///< why it cannot be inspected (errno); 0: it can, or it does not exist
    bool exists = false;
    bool is_folder = false;
    bool is_device = false;  ///< a character device, which takes several outputs
    bool is_regular = false;
  };
  struct Output {
    std::string owner;
    std::string path;        ///< as given; for a series with # in place of the number
    Place place;             ///< for a series the place of its folder
    std::string begin, end;  ///< begin and end of the file names of a series, in its folder
    bool is_series = false;
  };
  struct Input {
    std::string owner, path, what;
    Place place;
  };
  static Place place_of(const std::string& path);
  static bool same_place(const Place& a, const Place& b);
  static bool is_member(const Output& series, const std::string& target);
  static bool is_folder_of(const Output& file, const Output& series);
  static bool are_one(const Output& a, const Output& b);
  static bool is_part_of(const Output& a, const Output& b);
  static void try_to_write(const Output& output, std::vector<std::string>& problems);
  void check_folder(const Output& output, std::vector<std::string>& problems) const;

  std::string owner_ = "the program";
  std::vector<Output> outputs_;
  std::vector<Input> inputs_;
  std::set<std::string> known_inputs_;
};

}  // namespace muro
