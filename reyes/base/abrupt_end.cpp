#include "reyes/base/abrupt_end.h"

#include <unistd.h>

#include <mutex>

namespace tomales {
namespace {

struct Registry {
  std::mutex mutex;
  std::list<std::function<void()>> undos;
};

/// It is never destroyed, because a signal may come while static objects are destroyed.
Registry& registry() {
  static auto* const only = new Registry;
  return *only;
}

}  // namespace

AtAbruptEnd::AtAbruptEnd(std::function<void()> undo) {
  const std::lock_guard lock(registry().mutex);
  place_ = registry().undos.insert(registry().undos.end(), std::move(undo));
}

AtAbruptEnd::~AtAbruptEnd() {
  const std::lock_guard lock(registry().mutex);
  registry().undos.erase(place_);
}

void endAbruptly(int exitCode) {
  const std::lock_guard lock(registry().mutex);  // held to the end, so that nothing is undone twice
  for (auto undo = registry().undos.rbegin(); undo != registry().undos.rend(); ++undo) (*undo)();
  ::_exit(exitCode);
}

}  // namespace tomales
