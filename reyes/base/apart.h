// Runs foreign code that may crash or never end in a process of its own.
#pragma once
#include <functional>
#include <optional>
#include <string>

namespace tomales {

/// Returns what `make` returns, or nothing if its process ended otherwise or took more than `mostSeconds`, as `fate`
/// says ("crashes (Segmentation fault)"). What it prints on standard output is lost. The process is a fork of this one,
/// so `make` must not wait for other threads; so this must not be called while a frame is made.
std::optional<std::string> runInFork(const std::function<std::string()>& make, int mostSeconds, std::string& fate);

}  // namespace tomales
