// The program that PluginTrial starts: loads plugins and says that it lives.
#include <dlfcn.h>

#include <climits>

#include "reyes/shade/plugin_trial_socket.h"
#include "reyes/shader_api.h"

using namespace tomales::trial;

int main() {
  constexpr int kIdleMilliseconds = 200;
  const auto say = [](char word) { return send(kSocket, &word, 1, MSG_NOSIGNAL) == 1; };
  close_range(kSocket + 1, ~0u, 0);  // what the parent has open is not to stay open here
  char path[PATH_MAX + 1];
  while (arrives(kSocket, kIdleMilliseconds)) {
    const ssize_t length = recv(kSocket, path, PATH_MAX, 0);
    if (length <= 0 || !say(kBegins)) break;
    path[length] = 0;
    if (void* handle = dlopen(path, RTLD_NOW | RTLD_LOCAL))
      if (const auto function = reinterpret_cast<TmShadersFunction>(dlsym(handle, TM_SHADERS_SYMBOL))) function();
    say(kLives);
  }
  _exit(0);  // destructors of plugins are not on trial
}
