#include "reyes/base/stop.h"

namespace tomales {
namespace {

std::atomic<bool> wish{false};

}  // namespace

const std::atomic<bool>& stopFlag() { return wish; }
void requestStop(bool wanted) { wish = wanted; }

}  // namespace tomales
