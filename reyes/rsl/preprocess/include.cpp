#include "reyes/rsl/preprocess/include.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "reyes/rsl/standard_headers.h"

namespace tomales::compiler {
namespace {

namespace fs = std::filesystem;

/// Returns the path without symbolic links and ".."; empty if there is no such file.
std::string realPath(const std::string& path) {
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  return error ? std::string() : real.string();
}

/// Turns "\r\n" of DOS and "\r" of the old Macintosh into the '\n' of Unix.
void plainLineEnds(std::string& text) {
  if (text.find('\r') == std::string::npos) return;
  size_t to = 0;
  for (size_t from = 0; from < text.size(); ++from) {
    const bool isPair = text[from] == '\r' && from + 1 < text.size() && text[from + 1] == '\n';
    if (!isPair) text[to++] = text[from] == '\r' ? '\n' : text[from];
  }
  text.resize(to);
}

}  // namespace

std::string folderOf(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

ReadFile readFile(const std::string& path) {
  ReadFile out{path, {}, {}};
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    out.failure = "there is no such file";
  } else if (!fs::is_regular_file(status)) {
    out.failure = "it is not a plain file";
  } else {
    std::ifstream in(path, std::ios::binary);
    out.text.resize(std::min<uintmax_t>(fs::file_size(path, error), kMostFileBytes + 1));
    in.read(out.text.data(), static_cast<std::streamsize>(out.text.size()));
    if (error || !in) out.failure = "it cannot be read";
    if (out.text.size() > kMostFileBytes) out.failure = fmt::format("it is larger than {} MiB", kMostFileBytes >> 20);
  }
  if (!out.failure.empty()) out.text.clear();
  plainLineEnds(out.text);
  return out;
}

ReadFile asFile(const std::string& name, std::string text) {
  ReadFile out{name, std::move(text), {}};
  plainLineEnds(out.text);
  return out;
}

IncludeSearch::IncludeSearch(const PreprocessOptions& options, const std::string& ownFolder)
    : folders_(options.includeFolders), standard_(options.standardHeaders) {
  for (const std::string& folder : folders_) permitted_.push_back(realPath(folder));
  if (!ownFolder.empty()) permitted_.push_back(realPath(ownFolder));
  std::erase(permitted_, std::string());
  const fs::path own = realPath(ownFolder);
  if (own.empty()) return;
  for (const fs::path& folder : {own / "include", own.parent_path(), own.parent_path() / "include"})
    collections_.push_back(folder.string());
}

bool IncludeSearch::isPermitted(const std::string& path) const {
  return std::ranges::any_of(permitted_, [&](const std::string& folder) {
    return path.starts_with(folder) && (folder.back() == '/' || path[folder.size()] == '/');
  });
}

bool IncludeSearch::isHeaderOfCollection(const std::string& folder, const std::string& wanted,
                                         const std::string& real) const {
  const fs::path file = real;
  return file.extension() == ".h" && (fs::path(realPath(folder)) / wanted).lexically_normal() == file &&
         std::ranges::find(collections_, file.parent_path().string()) != collections_.end();
}

ReadFile IncludeSearch::find(std::string_view name, bool isQuoted, const std::string& fromFolder) const {
  std::string wanted(name);
  std::ranges::replace(wanted, '\\', '/');
  std::vector<std::string> folders = folders_;
  if (isQuoted && !fromFolder.empty()) folders.insert(folders.begin(), fromFolder);
  ReadFile out{wanted, {}, "there is no such file beside the file or in the folders for headers"};
  bool isThere = false;
  for (const std::string& folder : folders) {
    const std::string path = wanted.starts_with('/') ? wanted : folder == "." ? wanted : folder + "/" + wanted;
    const std::string real = realPath(path);
    if (real.empty()) continue;
    if (isPermitted(real) || isHeaderOfCollection(folder, wanted, real)) return readFile(path);
    isThere = true;
    out.failure = "it is outside of the folders from which files may be included";
  }
  // Collections of shaders name such headers relative to their folders: "../include/normals.h".
  for (const std::string& header : {wanted, isThere ? std::string() : fs::path(wanted).filename().string()})
    if (const std::string_view own = standard_ ? standardHeader(header) : std::string_view(); !own.empty())
      return asFile(wanted, std::string(own));
  if (fs::path(wanted).extension() == ".h" && fs::path(wanted).filename() == wanted)
    for (const std::string& folder : collections_)
      if (const std::string path = fs::path(folder) / wanted; realPath(path) == path) return readFile(path);
  return out;
}

}  // namespace tomales::compiler
