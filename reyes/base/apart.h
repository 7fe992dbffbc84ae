// Work on foreign code that may crash or never end, in a process of its own.
#pragma once
#include <functional>
#include <optional>
#include <string>

namespace tomales {

/// What `make` returns. Nothing: its process ended otherwise or took more than `mostSeconds`, as `fate` says ("crashes
/// (Segmentation fault)"). What it prints on standard output is lost. The process is a fork of this one, so that `make`
/// must not wait for other threads: not to be used while a frame is made.
std::optional<std::string> madeApart(const std::function<std::string()>& make, int mostSeconds, std::string& fate);

}  // namespace tomales
