#include "reyes/base/stop.h"

namespace tomales {
namespace {

std::atomic<bool> wish{false};

}  // namespace

StopToken processStop() { return wish; }
void requestStop(bool wanted) { wish = wanted; }

}  // namespace tomales
