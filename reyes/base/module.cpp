#include "reyes/base/module.h"

#include <dlfcn.h>

#include "reyes/base/process.h"

namespace tomales {
namespace {

/// Opens the module beside the program, as built, or in lib, as installed; else where the loader finds it, by the run
/// path of the program (CMakeLists.txt). A sanitizer's loader uses its own run path.
void* openModule(const char* file) {
  for (const auto& path : besideProgram(file))
    if (void* handle = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL)) return handle;
  return dlopen(file, RTLD_LAZY | RTLD_LOCAL);
}

}  // namespace

void* moduleFunction(const char* file, const char* function, std::string& error) {
  void* handle = openModule(file);
  void* found = handle ? dlsym(handle, function) : nullptr;
  if (!found) error = dlerror();
  return found;
}

}  // namespace tomales
