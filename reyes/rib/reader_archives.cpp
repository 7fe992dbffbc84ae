// Archives: files are read in place, and inline archives are recorded and replayed.
#include <fmt/format.h>

#include <filesystem>

#include "reyes/base/file_guesses.h"
#include "reyes/base/missing_file.h"
#include "reyes/base/search_path.h"
#include "reyes/base/standard_folders.h"
#include "reyes/rib/reader.h"
#include "reyes/rib/zip_member.h"

namespace tomales::rib {
namespace {

namespace fs = std::filesystem;

// Limits that no scene needs to exceed, so that archives that double each other end within a minute.
constexpr size_t kBudget = 10'000'000, kFileCost = 10;
constexpr size_t kReplayCost = 10;  ///< Cost of a request: most are objects, which take half a kilobyte each.

std::string canonical(const std::string& path) {
  std::error_code error;
  const fs::path out = fs::weakly_canonical(path, error);
  return error ? path : out.string();
}

/// The folder of a zip file's member is that of the zip file.
std::string folderOf(const std::string& path) {
  const std::string zip = zipOf(path);
  return fs::path(zip.empty() ? path : zip).parent_path().string();
}

/// Guesses where a file lies. A member of a zip file keeps its name within that.
std::vector<std::string> guesses(const std::string& name, const std::vector<std::string>& folders) {
  const size_t mark = std::min(name.find('!'), name.size());
  std::vector<std::string> out = pathSuffixes(name.substr(0, mark), folders);
  for (std::string& file : out) file += name.substr(mark);
  return out;
}

}  // namespace

void Reader::record(const Request& r) {
  std::optional<ArchiveRecording>& recording = open_.back().recording;
  if (!recording && r.name == "ArchiveEnd")
    return report(Severity::Warning, "rib-unbalanced", r, "without ArchiveBegin, ignored");
  if (!recording) {
    recording = ArchiveRecording{r, {}};
    return;
  }
  // Names that parameters had when the archive was recorded are resolved already; later ones need Declare too.
  declare(r, dictionary_, log_);
  recording->depth += (r.name == "ArchiveBegin") - (r.name == "ArchiveEnd");
  if (recording->depth == 0)
    endRecording();
  else
    recording->requests.push_back(r);
}

void Reader::endRecording() {
  ArchiveRecording done = std::move(*open_.back().recording);
  open_.back().recording.reset();
  proceduralContext_.reset();
  inlineArchives_[done.begin.args[0].strings[0]] = std::make_shared<const Requests>(std::move(done.requests));
}

void Reader::readArchiveNamed(const Request& r, const std::string& name) {
  const auto it = inlineArchives_.find(name);
  if (it == inlineArchives_.end()) return readArchiveFile(r, name);
  const std::shared_ptr<const Requests> archive = it->second;  // keeps it alive if it redefines itself
  replay(r, name, *archive);
}

void Reader::replay(const Request& r, const std::string& name, const Requests& archive) {
  const std::string key = "inline archive " + name;
  if (!mayEnter(r, key, kReplayCost)) return;
  enter(key, std::string(open_.back().folder));
  for (const Request& recorded : archive) {
    if (!spend(kReplayCost)) break;
    handle(recorded);
  }
  leave();
}

void Reader::readArchiveFile(const Request& r, const std::string& name) {
  std::string path = findFile(name, "archive");
  const std::vector<std::string> ends =
      path.empty() ? guesses(name, foldersFor("archive")) : std::vector<std::string>();
  for (size_t i = 0; i < ends.size() && path.empty(); ++i)
    if (path = findFile(ends[i], "archive"); !path.empty())
      report(Severity::Warning, "rib-elsewhere", r,
             "\"" + name.substr(0, 200) + "\" is not there; " + path + " is read, which has its name");
  tellOfFile(r, "archive", name, path);
  const auto stream = path.empty() ? nullptr : ByteStream::open(path);
  const std::string quoted = "\"" + name.substr(0, 200) + "\" ";
  if (!stream && !path.empty())
    report(Severity::Missing, "rib-missing-archive", r,
           quoted + "is not read: " + ByteStream::refusal(path) + "; nothing is read in its place");
  else if (!stream)
    report(Severity::Missing, "rib-missing-archive", r,
           quoted + "is missing or unreadable, looked for in " + listOfFolders(foldersFor("archive")) +
               hintOfMissing(name, {".rib"}, foldersFor("archive")) + "; nothing is read in its place");
  else if (mayEnter(r, canonical(path), kFileCost) && read(*stream, path, canonical(path), folderOf(path)) == 0)
    report(Severity::Missing, "rib-empty", r, quoted + "holds no RIB request that could be read");
}

std::shared_ptr<std::atomic<size_t>> Reader::newBudget() { return std::make_shared<std::atomic<size_t>>(kBudget); }

bool Reader::mayEnter(const Request& r, const std::string& key, size_t cost) {
  if (open_.size() == 1 && !inProcedural_) budget_ = newBudget();
  const auto refuse = [&](const std::string& why) {
    report(Severity::Missing, "rib-archive-recursion", r, why + "; ignored");
    return false;
  };
  if (std::any_of(open_.begin(), open_.end(), [&](const Level& l) { return l.key == key; }))
    return refuse("the archive reads itself");
  if (open_.size() > static_cast<size_t>(settings_.maxArchiveDepth))
    return refuse(fmt::format("more than {} archives within archives", settings_.maxArchiveDepth));
  if (!spend(cost))
    return refuse(fmt::format("the outermost archive stands for more than {} requests", kBudget / kReplayCost));
  return true;
}

// Several threads may spend the budget, which must never fall below 0.
bool Reader::spend(size_t cost) {
  size_t left = *budget_;
  while (left >= cost && !budget_->compare_exchange_weak(left, left - cost)) {
  }
  return left >= cost;
}

/// Replaces names of files by the paths that the search path finds.
void Reader::geometry(const Request& r) {
  Request found = r;
  const auto find = [&](std::string& file) {
    const std::string path = findFile(file, "texture");
    tellOfFile(r, "texture", file, path);
    if (!path.empty()) file = path;
  };
  for (Param& p : found.params) {
    if (p.name == "filename") std::for_each(p.strings.begin(), p.strings.end(), find);
    if (p.name == kVolumeStrings && !p.strings.empty()) find(p.strings[0]);
  }
  if (r.name == "Blobby" && r.args.size() > 3)
    std::for_each(found.args[3].strings.begin(), found.args[3].strings.end(), find);
  builder_.request(found);
}

std::vector<std::string> Reader::foldersFor(const char* category) const {
  std::vector<std::string> out = foldersOf(pathOf(builder_.options().searchPaths, category));
  out.push_back(open_.back().folder);
  out.insert(out.end(), settings_.archivePath.begin(), settings_.archivePath.end());
  for (const std::string& folder : foldersOf(standardPath(category))) out.push_back(folder);
  return out;
}

// Looks along the search path first, then beside the reading file, then in the folders of RibSettings.
std::string Reader::findFile(const std::string& written, const char* category) const {
  const std::string name = mapped(written, builder_.dirMap());
  std::error_code ignored;
  for (const fs::path folder : foldersFor(category))
    if (const fs::path path = folder / name; fs::is_regular_file(path, ignored) || !zipOf(path.string()).empty())
      return path.string();
  return "";
}

}  // namespace tomales::rib
