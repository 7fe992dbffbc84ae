#include "reyes/shade/function_plugins.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "reyes/base/crash_note.h"
#include "reyes/base/input_file.h"
#include "reyes/base/loaded_plugins.h"

namespace tomales {

namespace fs = std::filesystem;

std::vector<const TmFunction*> FunctionPlugins::named(const std::string& name,
                                                      const std::vector<std::string>& folders) {
  const std::lock_guard lock(mutex_);
  std::vector<const TmFunction*> out;
  for (const std::string& folder : folders) {
    const auto [it, isNew] = folders_.try_emplace(folder);
    if (isNew) open(folder, it->second);
    if (const auto found = it->second.find(name); found != it->second.end())
      out.insert(out.end(), found->second.begin(), found->second.end());
  }
  return out;
}

void FunctionPlugins::open(const std::string& folder, Functions& out) {
  std::vector<fs::path> files;
  std::error_code none;
  for (auto it = fs::directory_iterator(folder, none); !none && it != fs::directory_iterator(); it.increment(none))
    if (it->path().extension() == ".so") files.push_back(it->path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) load(file.string(), out);
}

// Plugins are never closed, since a compiled shader may outlive this object.
void FunctionPlugins::load(const std::string& path, Functions& out) {
  if (const std::string problem = inputProblem(path); !problem.empty())
    return refuse(path, "cannot be loaded: " + problem);
  if (const std::string fate = trial_.fateOf(path); !fate.empty()) return refuse(path, fate + "; it is left out");
  noteLoadedPlugin(path);
  const CrashNote note({"shader plugin", path.c_str(), "while plugins are loaded", nullptr, nullptr, 0});
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) return;  // it may be a procedural, which calls functions that the renderer has
  const auto function = reinterpret_cast<TmFunctionsFunction>(dlsym(handle, TM_FUNCTIONS_SYMBOL));
  if (!function) return;  // it has shaders only
  const TmFunctionLibrary* library = function();
  if (!library || library->abi != TM_SHADER_ABI || library->structBytes < sizeof *library ||
      library->functionBytes != sizeof(TmFunction))
    return refuse(path, "its functions are of another version; compile it against the headers of this one");
  for (int32_t k = 0; k < library->count; ++k) {
    const TmFunction& f = library->functions[k];
    if (const std::string name = rslNameOf(f); !name.empty())
      out[name].push_back(&f);
    else
      refuse(path, fmt::format("a shader cannot call \"{}\": its prototype is not one that {} describes",
                               f.prototype ? f.prototype : "", "reyes/shader/functions.h"));
  }
}

void FunctionPlugins::refuse(const std::string& path, const std::string& problem) {
  log_.report(Severity::Missing, "shader-plugin", {std::make_shared<const std::string>(path), 0},
              path + ": " + problem);
}

}  // namespace tomales
