#include "reyes/base/unfinished_folder.h"

#include <fmt/format.h>

#include <fstream>

#include "reyes/base/chunk_file.h"

namespace tomales {
namespace {

std::filesystem::path markOf(const std::filesystem::path& folder) { return folder / "unfinished"; }

}  // namespace

UnfinishedFolder::UnfinishedFolder(const std::filesystem::path& folder) : mark_(markOf(folder)) {
  std::ofstream mark(mark_);
  mark << "Files of this folder are missing until the program that writes it has ended.\n";
  if (!mark.flush()) throw WriteError(fmt::format("\"{}\" cannot be written", mark_.string()));
}

void UnfinishedFolder::finish() {
  std::error_code none;
  std::filesystem::remove(mark_, none);
}

void requireFinished(const std::filesystem::path& folder) {
  std::error_code none;
  if (const std::filesystem::path mark = markOf(folder); std::filesystem::exists(mark, none))
    throw FileError(
        fmt::format("folder \"{}\" is not whole: the program that makes it still runs or was ended. Run it again, or "
                    "remove \"{}\" to use what is there",
                    folder.string(), mark.string()));
}

}  // namespace tomales
