#include "reyes/base/module.h"

#include <dlfcn.h>

#include "reyes/base/process.h"

namespace tomales {
namespace {

/// Opens the module beside the program, as built, or in lib, as installed; otherwise where the loader finds it.
void* openModule(const char* file, std::string& error) {
  for (const auto& path : besideProgram(file)) {
    if (void* handle = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL)) return handle;
    if (error.empty()) error = dlerror();
  }
  void* const handle = dlopen(file, RTLD_LAZY | RTLD_LOCAL);
  if (!handle && error.empty()) error = dlerror();
  return handle;
}

}  // namespace

void* findInModule(const char* file, const char* function, std::string& error) {
  std::string problem;
  void* const handle = openModule(file, problem);
  void* const found = handle ? dlsym(handle, function) : nullptr;
  if (!found) error = handle ? dlerror() : problem;
  return found;
}

}  // namespace tomales
