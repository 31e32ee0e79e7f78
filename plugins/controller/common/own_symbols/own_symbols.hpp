// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace muro {

/// A function or variable of a library that the library itself does not get when it asks for it.
struct Interposed {
  std::string name;  ///< "step"
  std::string by;    ///< path of the library that has one of the same name and comes first: "/lib/.../libc.so.6"
};

/// The dynamic linker binds a reference to a symbol of the library's own to the first one of that name, and the program
/// and what it is linked with come before a library that is loaded later (System V ABI, "Shared Object Dependencies").
/// These are the symbols of `library`, a handle of dlopen, where that was another one.
std::vector<Interposed> interposed_symbols(void* library);

}  // namespace muro
