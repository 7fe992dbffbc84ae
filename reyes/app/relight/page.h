// The files of the page, which CMake takes from reyes/app/relight/page.
#pragma once
#include <span>
#include <string_view>

namespace tomales {

struct PageFile {
  std::string_view name, text;
};

std::span<const PageFile> pageFiles();

}  // namespace tomales
