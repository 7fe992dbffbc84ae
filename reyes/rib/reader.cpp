#include "reyes/rib/reader.h"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>

#include "reyes/rib/parser.h"

namespace tomales::rib {
namespace {
namespace fs = std::filesystem;

std::string canonical(const std::string& path) {
  std::error_code error;
  const fs::path out = fs::weakly_canonical(path, error);
  return error ? path : out.string();
}

SourceLoc wholeFile(const std::string& name) { return {std::make_shared<const std::string>(name), 0}; }

}  // namespace

bool Reader::readFile(const std::string& path) {
  const auto stream = ByteStream::open(path);
  if (stream) return readTop(*stream, path == "-" ? "standard input" : path);
  log_.report(Severity::Error, "rib-open", wholeFile(path), "the file cannot be opened");
  return false;
}

bool Reader::readText(const std::string& text, const std::string& name) {
  return readTop(*ByteStream::fromMemory(text), name);
}

bool Reader::readTop(ByteStream& stream, const std::string& name) {
  last_ = wholeFile(name);
  if (read(stream, name) > 0) return true;
  log_.report(Severity::Error, "rib-empty", wholeFile(name),
              "the file holds no RIB request that could be read");
  return false;
}

size_t Reader::read(ByteStream& stream, const std::string& name) {
  open_.push_back(name);
  Parser parser(stream, name, dictionary_, log_);
  size_t count = 0;
  for (std::optional<Request> request = parser.next(); request; request = parser.next(), ++count)
    handle(*request);
  if (stream.damaged())
    log_.report(Severity::Missing, "rib-gzip", wholeFile(name),
                "the compressed data is damaged; its readable part is used");
  open_.pop_back();
  return count;
}

void Reader::handle(const Request& r) {
  last_ = r.where;
  // The contents of an inline archive are for later.
  if (r.name == "ArchiveBegin") ++inlineArchives_;
  if (inlineArchives_ > 0) {
    if (r.name == "ArchiveBegin")
      log_.report(Severity::Missing, "rib-unsupported", r.where,
                  "ArchiveBegin is not supported yet, its contents are ignored");
    if (r.name == "ArchiveEnd") --inlineArchives_;
    return;
  }
  if (r.name == "Declare") declare(r);
  if (r.name == "ReadArchive") return readArchive(r);
  builder_.request(r);
}

void Reader::declare(const Request& r) {
  if (!dictionary_.declare(r.args[0].strings[0], r.args[1].strings[0]))
    log_.report(Severity::Warning, "rib-declaration", r.where,
                fmt::format("Declare: \"{}\" is no declaration of \"{}\"; ignored",
                            r.args[1].strings[0].substr(0, 80), r.args[0].strings[0].substr(0, 80)));
}

void Reader::readArchive(const Request& r) {
  const std::string& name = r.args[0].strings[0];
  const std::string path = findArchive(name);
  const auto stream = path.empty() ? nullptr : ByteStream::open(path);
  const auto isSame = [&](const std::string& other) { return canonical(other) == canonical(path); };
  const auto refuse = [&](Severity severity, const char* code, const std::string& why) {
    log_.report(severity, code, r.where, fmt::format("ReadArchive \"{}\": {}", name.substr(0, 200), why));
  };
  if (!stream)
    refuse(Severity::Missing, "rib-missing-archive",
           "the file is missing or unreadable; nothing is read in its place");
  else if (std::any_of(open_.begin(), open_.end(), isSame))
    refuse(Severity::Warning, "rib-archive-recursion", "the archive reads itself; ignored");
  else if (open_.size() > static_cast<size_t>(settings_.maxArchiveDepth))
    refuse(Severity::Warning, "rib-archive-recursion",
           fmt::format("more than {} archives within archives; ignored", settings_.maxArchiveDepth));
  else if (read(*stream, path) == 0)
    refuse(Severity::Missing, "rib-empty", "the archive holds no RIB request that could be read");
}

// The search path first, then beside the file that reads, then where the caller says.
std::string Reader::findArchive(const std::string& name) const {
  std::vector<fs::path> folders;
  const auto& paths = builder_.options().searchPaths;
  if (const auto it = paths.find("archive"); it != paths.end()) {
    std::istringstream list(it->second);
    for (std::string folder; std::getline(list, folder, ':');)
      if (!folder.empty()) folders.push_back(folder);
  }
  folders.push_back(fs::path(open_.back()).parent_path());
  folders.insert(folders.end(), settings_.archivePath.begin(), settings_.archivePath.end());
  std::error_code ignored;
  for (const fs::path& folder : folders)
    if (const fs::path path = folder / name; fs::is_regular_file(path, ignored)) return path.string();
  return "";
}

}  // namespace tomales::rib
