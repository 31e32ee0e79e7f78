// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace muro {

/// A function or variable that a library defines, but does not get when it asks for it.
struct Interposed {
  std::string name;  ///< "step"
  std::string by;    ///< path of the library that comes first and has a symbol of this name: "/lib/.../libc.so.6"
};

/// Returns the interposed symbols of `library`, a handle of dlopen. The dynamic linker binds a reference to the first
/// symbol of its name, also when the library defines that symbol itself. The program and the libraries it is linked
/// with come before a library that is loaded later (System V ABI, "Shared Object Dependencies").
std::vector<Interposed> interposed_symbols(void* library);

}  // namespace muro
