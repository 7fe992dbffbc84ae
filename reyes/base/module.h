// Parts of the program that are loaded when they are first used.
#pragma once
#include <string>

namespace tomales {

/// Loads the module of this file name, which is never closed, and returns its function. Returns null on failure, and
/// `error` says why.
void* findInModule(const char* file, const char* function, std::string& error);

/// A function of a module, as `extern "C"` names it. Threads: make one as a static variable where it is called.
template <class Signature>
struct ModuleFunction {
  ModuleFunction(const char* file, const char* function)
      : call(reinterpret_cast<Signature*>(findInModule(file, function, error))) {}
  std::string error;  ///< Why `call` is null.
  Signature* const call;
};

}  // namespace tomales
