// SPDX-License-Identifier: MIT
#include "own_symbols.hpp"

#include <dlfcn.h>
#include <elf.h>
#include <link.h>

#include <algorithm>
#include <cstdint>
#include <span>

namespace muro::control {

namespace {

/// What a relocation puts into its place; `none` for those that are no plain address of a symbol.
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

/// The dynamic section of a loaded library.
class Dynamic {
 public:
  explicit Dynamic(const link_map& library) : base_(library.l_addr) {
    const char *relocations = nullptr, *plt = nullptr;
    std::uint64_t relocation_bytes = 0, plt_bytes = 0, plt_kind = 0;
    for (const ElfW(Dyn)* d = library.l_ld; d->d_tag != DT_NULL; ++d) switch (d->d_tag) {
        case DT_SYMTAB:
          symbols_ = reinterpret_cast<const ElfW(Sym)*>(at(d->d_un.d_ptr));
          break;
        case DT_STRTAB:
          names_ = at(d->d_un.d_ptr);
          break;
        case DT_RELA:
          relocations = at(d->d_un.d_ptr);
          break;
        case DT_RELASZ:
          relocation_bytes = d->d_un.d_val;
          break;
        case DT_JMPREL:
          plt = at(d->d_un.d_ptr);
          break;
        case DT_PLTRELSZ:
          plt_bytes = d->d_un.d_val;
          break;
        case DT_PLTREL:
          plt_kind = d->d_un.d_val;
          break;
        default:
          break;
      }
    if (relocations) relocations_[0] = span(relocations, relocation_bytes);
    if (plt && plt_kind == DT_RELA) relocations_[1] = span(plt, plt_bytes);
  }

  /// Calls `see(name, address)` for each reference to a function or variable that the library defines for all.
  template <class See>
  void for_own_references(See see) const {
    if (!symbols_ || !names_) return;
    for (const std::span<const ElfW(Rela)> list : relocations_)
      for (const ElfW(Rela) & r : list) {
        const Puts puts_what = puts(ELF64_R_TYPE(r.r_info));
        const std::uint64_t number = ELF64_R_SYM(r.r_info);
        if (puts_what == Puts::none || number == 0) continue;
        const ElfW(Sym)& symbol = symbols_[number];
        // weak ones are parts of C++ that libraries are meant to have in common
        if (symbol.st_shndx == SHN_UNDEF || ELF64_ST_BIND(symbol.st_info) != STB_GLOBAL) continue;
        const std::uintptr_t found = *reinterpret_cast<const std::uintptr_t*>(base_ + r.r_offset);
        const std::uintptr_t addend = puts_what == Puts::address ? 0 : std::uintptr_t(r.r_addend);
        see(names_ + symbol.st_name, reinterpret_cast<const void*>(found - addend));
      }
  }

 private:
  /// glibc has made most of these numbers addresses already.
  const char* at(std::uintptr_t place) const {
    return reinterpret_cast<const char*>(place < base_ ? base_ + place : place);
  }
  static std::span<const ElfW(Rela)> span(const char* begin, std::uint64_t bytes) {
    return {reinterpret_cast<const ElfW(Rela)*>(begin), bytes / sizeof(ElfW(Rela))};
  }

  std::uintptr_t base_;
  const ElfW(Sym) * symbols_ = nullptr;
  const char* names_ = nullptr;
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

}  // namespace muro::control
