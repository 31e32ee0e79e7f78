// SPDX-License-Identifier: MIT
#include "own_symbols.hpp"

#include <dlfcn.h>
#include <elf.h>
#include <link.h>

#include <algorithm>
#include <cstdint>
#include <span>

namespace muro {

namespace {

/// The value that a relocation writes; `none` for relocations that do not write the address of a symbol.
enum class Puts { none, address, address_plus_addend };

Puts puts(std::uint64_t type) {
#if defined(__x86_64__)
  if (type == R_X86_64_GLOB_DAT || type == R_X86_64_JUMP_SLOT) return Puts::address;
  if (type == R_X86_64_64) return Puts::address_plus_addend;
#elif defined(__aarch64__)
  if (type == R_AARCH64_GLOB_DAT || type == R_AARCH64_JUMP_SLOT || type == R_AARCH64_ABS64)
    return Puts::address_plus_addend;
#endif
  static_cast<void>(type);
  return Puts::none;
}

/// Reads the word at `place`. The place may be in tables that AddressSanitizer forbids all other code to read.
[[gnu::no_sanitize_address]] std::uintptr_t word_at(std::uintptr_t place) {
  return *reinterpret_cast<const std::uintptr_t*>(place);
}

/// The dynamic section of a loaded library.
class Dynamic {
 public:
  explicit Dynamic(const link_map& library)
      : base_(library.l_addr),
        entries_(library.l_ld),
        symbols_(reinterpret_cast<const ElfW(Sym) *>(address(DT_SYMTAB))),
        names_(address(DT_STRTAB)) {
    relocations_[0] = relocations(DT_RELA, DT_RELASZ);
    if (value(DT_PLTREL) == DT_RELA) relocations_[1] = relocations(DT_JMPREL, DT_PLTRELSZ);
  }

  /// Calls `see(name, address)` for each reference to a global function or variable that the library defines itself.
  template <class See>
  void for_own_references(See see) const {
    if (!symbols_ || !names_) return;
    for (const std::span<const ElfW(Rela)> list : relocations_)
      for (const ElfW(Rela) & r : list) {
        const Puts puts_what = puts(ELF64_R_TYPE(r.r_info));
        const std::uint64_t number = ELF64_R_SYM(r.r_info);
        if (puts_what == Puts::none || number == 0) continue;
        const ElfW(Sym)& symbol = symbols_[number];
        // weak symbols are parts of C++ that libraries are meant to share
        if (symbol.st_shndx == SHN_UNDEF || ELF64_ST_BIND(symbol.st_info) != STB_GLOBAL) continue;
        const std::uintptr_t found = word_at(base_ + r.r_offset);
        const std::uintptr_t addend = puts_what == Puts::address ? 0 : std::uintptr_t(r.r_addend);
        see(names_ + symbol.st_name, reinterpret_cast<const void*>(found - addend));
      }
  }

 private:
  /// Returns 0 when there is no such entry.
  std::uint64_t value(std::int64_t tag) const {
    for (const ElfW(Dyn)* d = entries_; d->d_tag != DT_NULL; ++d)
      if (d->d_tag == tag) return d->d_un.d_val;
    return 0;
  }
  /// Returns null when there is no such entry. glibc has already turned most of these numbers into addresses.
  const char* address(std::int64_t tag) const {
    const std::uintptr_t place = value(tag);
    if (place == 0) return nullptr;
    return reinterpret_cast<const char*>(place < base_ ? base_ + place : place);
  }
  std::span<const ElfW(Rela)> relocations(std::int64_t list, std::int64_t bytes) const {
    const char* const begin = address(list);
    if (!begin) return {};
    return {reinterpret_cast<const ElfW(Rela)*>(begin), value(bytes) / sizeof(ElfW(Rela))};
  }

  std::uintptr_t base_;
  const ElfW(Dyn) * entries_;
  const ElfW(Sym) * symbols_;
  const char* names_;
  std::span<const ElfW(Rela)> relocations_[2];
};

}  // namespace

std::vector<Interposed> interposed_symbols(void* library) {
  std::vector<Interposed> all;
  link_map* map = nullptr;
  Dl_info own{};
  if (dlinfo(library, RTLD_DI_LINKMAP, &map) != 0 || dladdr(map->l_ld, &own) == 0) return all;
  Dynamic(*map).for_own_references([&](const char* name, const void* address) {
    Dl_info found{};
    if (dladdr(address, &found) == 0 || found.dli_fbase == own.dli_fbase) return;
    if (std::none_of(all.begin(), all.end(), [&](const Interposed& i) { return i.name == name; }))
      all.push_back({name, found.dli_fname ? found.dli_fname : "another library"});
  });
  return all;
}

}  // namespace muro
