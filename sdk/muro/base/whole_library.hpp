// SPDX-License-Identifier: MIT
// A check that the file of a shared library is complete, before it is loaded.
#pragma once

#include <elf.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace muro {

/// ELF number of the machine for which this program is built.
inline constexpr std::uint16_t own_elf_machine =
#if defined(__x86_64__)
    EM_X86_64;
#elif defined(__aarch64__)
    EM_AARCH64;
#else
    EM_NONE;  // any machine is accepted
#endif

/// Returns what is wrong with a shared library that was copied only in part or is for other machines, as the end of a
/// sentence. Returns "" when its file is as long as its tables say, or is no such library. The system's loader maps a
/// partial file and dies of SIGBUS at its end, so call this before dlopen().
inline std::string missing_part_of_library(const std::string& path) {
  std::error_code code;
  const std::uint64_t size = std::filesystem::file_size(path, code);
  std::ifstream file(path, std::ios::binary);
  Elf64_Ehdr header{};
  if (code || !file.read(reinterpret_cast<char*>(&header), sizeof header) ||
      std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 || header.e_ident[EI_CLASS] != ELFCLASS64)
    return "";
  if (own_elf_machine != EM_NONE && header.e_machine != own_elf_machine)
    return "it is built for another machine, which has the ELF number " + std::to_string(header.e_machine) +
           " and not " + std::to_string(own_elf_machine) + "; build it for this one";
  std::uint64_t needed = 0;
  const auto need = [&](std::uint64_t begin, std::uint64_t length) {
    const std::uint64_t end = begin + length < begin ? ~std::uint64_t(0) : begin + length;
    needed = end > needed ? end : needed;
  };
  need(header.e_phoff, std::uint64_t(header.e_phnum) * header.e_phentsize);
  if (header.e_shoff > 0) need(header.e_shoff, std::uint64_t(header.e_shnum) * header.e_shentsize);
  for (unsigned i = 0; i < header.e_phnum && needed <= size; ++i) {
    Elf64_Phdr segment{};
    file.seekg(std::streamoff(header.e_phoff + std::uint64_t(i) * header.e_phentsize));
    if (!file.read(reinterpret_cast<char*>(&segment), sizeof segment)) break;
    if (segment.p_type != PT_NULL) need(segment.p_offset, segment.p_filesz);
  }
  if (needed <= size) return "";
  return "the file has " + std::to_string(size) + " bytes and should have at least " + std::to_string(needed) +
         ": it was copied only in part, or is damaged; copy or build it again";
}

}  // namespace muro
