#include "reyes/base/missing_file.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "reyes/base/near_names.h"
#include "reyes/base/text.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// Lists files of folders, until a limit of entries has been seen, because a scene may name the root of a large disk.
class Listing {
 public:
  /// Adds the files of a folder, sorted, and of the folders in it down to `depth`.
  void add(const fs::path& folder, int depth) {
    std::error_code none;
    if (!seen_.insert(fs::weakly_canonical(folder, none).string()).second) return;
    std::vector<fs::path> files, below;
    for (auto it = fs::directory_iterator(folder, none); !none && it != fs::directory_iterator(); it.increment(none)) {
      if (++count_ > kMost) break;
      std::error_code unknown;
      (it->is_directory(unknown) ? below : files).push_back(it->path());
    }
    std::sort(files.begin(), files.end());
    std::sort(below.begin(), below.end());
    files_.insert(files_.end(), files.begin(), files.end());
    for (const fs::path& f : below)
      if (depth > 0 && f.filename().string()[0] != '.') add(f, depth - 1);
  }
  const std::vector<fs::path>& files() const { return files_; }

 private:
  static constexpr int kMost = 5000;
  std::set<std::string> seen_;
  std::vector<fs::path> files_;
  int count_ = 0;
};

class Wanted {
 public:
  Wanted(const std::string& name, const std::vector<std::string>& endings)
      : name_(lowerCase(fs::path(name).filename().string())),
        stem_(fs::path(name_).stem().string()),
        endings_(endings) {}

  bool is(const fs::path& file) const {
    const fs::path other = lowerCase(file.filename().string());
    return other == name_ || ((other.stem() == stem_ || other.stem() == name_) && isEnding(other.extension().string()));
  }
  bool isEnding(const std::string& ending) const {
    return std::find(endings_.begin(), endings_.end(), ending) != endings_.end();
  }

 private:
  const std::string name_, stem_;
  const std::vector<std::string>& endings_;
};

std::string shown(const fs::path& file) { return "\"" + file.lexically_normal().string() + "\""; }

}  // namespace

std::string hintOfMissing(const std::string& name, const std::vector<std::string>& endings,
                          const std::vector<std::string>& folders) {
  const Wanted wanted(name, endings);
  Listing searched, around;
  for (const std::string& folder : folders) searched.add(folder, 0);
  const auto same = [&](const Listing& in) {
    return std::find_if(in.files().begin(), in.files().end(), [&](const fs::path& f) { return wanted.is(f); });
  };
  if (const auto it = same(searched); it != searched.files().end()) return "; there is " + shown(*it);
  for (const std::string& folder : folders) around.add(folder, 2);
  for (const std::string& folder : folders) around.add(fs::path(folder) / "..", 2);
  if (const auto it = same(around); it != around.files().end())
    return "; " + shown(*it) + " is there, in a folder that is not searched";
  std::vector<std::string> names;
  for (const fs::path& file : searched.files())
    if (wanted.isEnding(lowerCase(file.extension().string()))) names.push_back(file.filename().string());
  return didYouMean(fs::path(name).filename().string(), names);
}

std::string listOfFolders(const std::vector<std::string>& folders) {
  std::vector<std::string> names;
  for (const std::string& folder : folders)
    if (const std::string f = folder.empty() ? "." : folder; std::find(names.begin(), names.end(), f) == names.end())
      names.push_back(f);
  std::string out;
  for (size_t i = 0; i < names.size(); ++i) out += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return out;
}

}  // namespace tomales
