// Files of web pages that are built into the program: CMake takes them from the folders named `page`.
#pragma once
#include <span>
#include <string_view>

namespace tomales {

struct PageFile {
  std::string_view name, text;
};

std::span<const PageFile> relightPage();
/// Has Chart.js besides, which draws the charts.
std::span<const PageFile> chartPage();

}  // namespace tomales
