// The program that PluginTrial starts: it loads plugins, and reports that it is still running.
#include <dlfcn.h>

#include <climits>
#include <cstring>

#include "reyes/base/plugin_trial_socket.h"
#include "reyes/shader/functions.h"
#include "reyes/shader_api.h"

using namespace tomales::trial;

namespace {

volatile size_t read_bytes = 0;  // volatile, so that no read is left out

void read(const char* text) {
  if (text) read_bytes = read_bytes + std::strlen(text);
}

void read(const TmParamDecl& p) {
  read(p.name);
  read(p.doc);
  const bool texts = TM_TYPE_OF(p.type) == TM_STRING;
  for (int32_t i = 0; texts && p.strings && i < p.arrayLength; ++i) read(p.strings[i]);
  for (int32_t i = 0; !texts && p.floats && i < p.arrayLength; ++i) read_bytes = read_bytes + (p.floats[i] != 0);
}

/// Reads everything that the renderer would read of the plugin, so that a wild pointer crashes this process.
void read(const TmShaderLibrary* library) {
  if (!library || library->abi != TM_SHADER_ABI || library->structBytes < sizeof(TmShaderLibrary)) return;
  read(library->fault);
  for (int32_t k = 0; k < library->count; ++k) {
    const TmShader* s = library->shaders[k];
    if (!s || s->abi != TM_SHADER_ABI || s->structBytes < sizeof(TmShader)) continue;
    read(s->name);
    read(s->doc);
    read(s->fault);
    for (int32_t i = 0; s->params && s->paramBytes == sizeof(TmParamDecl) && i < s->paramCount; ++i) read(s->params[i]);
  }
}

void read(const TmFunctionLibrary* library) {
  if (!library || library->abi != TM_SHADER_ABI || library->structBytes < sizeof(TmFunctionLibrary)) return;
  const bool known = library->functionBytes == sizeof(TmFunction);
  for (int32_t k = 0; known && k < library->count; ++k) read(library->functions[k].prototype);
}

}  // namespace

int main() {
  constexpr int kIdleMilliseconds = 200;
  const auto say = [](char word) { return send(kSocket, &word, 1, MSG_NOSIGNAL) == 1; };
  close_range(kSocket + 1, ~0u, 0);  // close the files of the parent
  char path[PATH_MAX + 1];
  while (arrives(kSocket, kIdleMilliseconds)) {
    const ssize_t length = recv(kSocket, path, PATH_MAX, 0);
    if (length <= 0 || !say(kBegins)) break;
    path[length] = 0;
    void* handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!handle) handle = dlopen(path, RTLD_LAZY | RTLD_LOCAL);  // procedurals call functions that the renderer has
    if (handle) {
      if (const auto shaders = reinterpret_cast<TmShadersFunction>(dlsym(handle, TM_SHADERS_SYMBOL))) read(shaders());
      if (const auto all = reinterpret_cast<TmFunctionsFunction>(dlsym(handle, TM_FUNCTIONS_SYMBOL))) read(all());
    }
    say(kLives);
  }
  _exit(0);  // destructors of plugins are not on trial
}
