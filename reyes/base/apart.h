// Runs foreign code, which may crash or never end, in a process of its own.
#pragma once
#include <functional>
#include <optional>
#include <string>

namespace tomales {

/// Returns the result of `make`, or nothing if its process crashed or took more than `mostSeconds`; `fate` then says so
/// ("crashes (Segmentation fault)"). Its standard output is lost. The process is a fork of this one, so `make` must not
/// wait for other threads: do not call this while a frame is made.
std::optional<std::string> runInFork(const std::function<std::string()>& make, int mostSeconds, std::string& fate);

}  // namespace tomales
