#include "reyes/base/log.h"

#include <algorithm>
#include <cstdio>

#include "reyes/base/appended_file.h"
#include "reyes/base/crash_note.h"
#include "reyes/base/process.h"

namespace tomales {

std::string SourceLoc::text() const {
  if (!file) return "tomales";
  return line > 0 ? *file + ":" + std::to_string(line) : *file;
}

namespace {

bool isSame(const SourceLoc& a, const SourceLoc& b) {
  return a.line == b.line && (a.file == b.file || (a.file && b.file && *a.file == *b.file));
}

void addPlace(LogEntry& entry, const SourceLoc& where) {
  std::vector<SourceLoc>& places = entry.places;
  if (places.size() == Log::kMostPlaces) return;
  if (std::none_of(places.begin(), places.end(), [&](const SourceLoc& p) { return isSame(p, where); }))
    places.push_back(where);
}

/// Returns the beginning of a message, for a line that refers to one that was printed in full before.
std::string beginning(const std::string& message) {
  constexpr size_t kLongest = 60;
  const size_t end = std::min(message.find_first_of(";\n"), message.size());
  return end <= kLongest ? message.substr(0, end) : message.substr(0, kLongest) + " ...";
}

/// Returns the text with its control characters as \x1B, so that no byte of a scene commands the terminal. Tabs and
/// ends of lines stay. Terminals also obey U+0080 to U+009F, which UTF-8 writes as C2 80 to C2 9F.
std::string printable(std::string_view text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool afterC2 = i > 0 && text[i - 1] == '\xC2' && c >= 0x80 && c < 0xA0;
    const bool control = (c < 0x20 && c != '\t' && c != '\n') || c == 0x7F || afterC2;
    constexpr const char* kDigits = "0123456789ABCDEF";
    if (afterC2) out.pop_back();
    if (control)
      out.append({'\\', 'x', kDigits[c >> 4], kDigits[c & 15]});
    else
      out += text[i];
  }
  return out;
}

}  // namespace

Log::Log(Verbosity verbosity) : verbosity_(verbosity) {}
Log::~Log() {
  printRepeated();
  if (file_) reportCrashesAlsoTo(-1);
}

bool Log::alsoTo(const std::string& file, std::string& error) {
  auto opened = AppendedFile::open(file, error);
  const std::lock_guard lock(mutex_);
  if (opened) reportCrashesAlsoTo(opened->descriptor());
  if (opened) file_ = std::move(opened);
  return file_ != nullptr;
}

void Log::append(const std::string& line) {
  std::string why;
  if (!file_ || file_->write(timeNow() + ' ' + line, why)) return;
  reportCrashesAlsoTo(-1);
  file_.reset();
  entries_.push_back({Severity::Output, "log-write", "the log could not be written: " + why, {}, 1, {{}}});
  std::fprintf(stderr, "tomales: output error: %s [log-write]\n", entries_.back().message.c_str());
}

bool Log::isWanted(Severity severity) const {
  if (verbosity_ == Verbosity::Silent) return false;
  return verbosity_ == Verbosity::Verbose || severity > Severity::Warning ||
         (verbosity_ == Verbosity::Normal && severity >= Severity::Note);
}

void Log::printRepeated() const {
  std::vector<const LogEntry*> repeated;
  for (const LogEntry& e : entries_)
    if (e.places.size() > 1 && isWanted(e.severity)) repeated.push_back(&e);
  std::stable_sort(repeated.begin(), repeated.end(),
                   [](const LogEntry* a, const LogEntry* b) { return a->count > b->count; });
  for (size_t i = 0; i < std::min(repeated.size(), kMostRepeated); ++i) {
    const LogEntry& e = *repeated[i];
    std::string places;
    for (const SourceLoc& p : e.places) places += (places.empty() ? "" : ", ") + p.text();
    std::fprintf(stderr, "tomales: %d times: %s [%s]: %s%s\n", e.count, printable(beginning(e.message)).c_str(),
                 e.code.c_str(), printable(places).c_str(),
                 static_cast<size_t>(e.count) > e.places.size() && e.places.size() == kMostPlaces ? ", ..." : "");
  }
  if (repeated.size() > kMostRepeated)
    std::fprintf(stderr, "tomales: %zu other messages came from several places as well; the statistics have them\n",
                 repeated.size() - kMostRepeated);
}

void Log::report(Severity severity, std::string_view code, const SourceLoc& where, const std::string& message,
                 std::string_view subject) {
  const std::lock_guard lock(mutex_);
  const bool wholeFile = where.file && where.line == 0;
  const auto [it, fresh] = index_.try_emplace(
      {std::string(code), !subject.empty() ? std::string(subject) : message + (wholeFile ? *where.file : "")},
      entries_.size());
  if (!fresh) {
    LogEntry& known = entries_[it->second];
    ++known.count;
    return addPlace(known, where);
  }
  entries_.push_back({severity, std::string(code), message, where, 1, {where}});
  static constexpr const char* kNames[] = {"info", "note", "warning", "missing", "error", "output error"};
  const std::string text = printable(where.text() + ": " + kNames[static_cast<int>(severity)] + ": " + message + " [" +
                                     entries_.back().code + "]\n");
  // Messages of severity Info are not limited: the user asked for them, and a frame brings few.
  const int line = isWanted(severity) && severity > Severity::Info ? ++lines_[entries_.back().code] : 0;
  if (isWanted(severity) && line <= kMostLinesOfCode) std::fputs(text.c_str(), stderr);
  if (line == kMostLinesOfCode + 1)
    std::fprintf(stderr, "tomales: more of [%s] is not printed; the statistics have it\n",
                 entries_.back().code.c_str());
  append(text);
}

std::vector<LogEntry> Log::entries() const {
  const std::lock_guard lock(mutex_);
  return entries_;
}

Severity Log::worst() const {
  const std::lock_guard lock(mutex_);
  Severity worst = Severity::Info;
  for (const LogEntry& e : entries_) worst = std::max(worst, e.severity);
  return worst;
}

int Log::count(std::string_view code) const {
  const std::lock_guard lock(mutex_);
  int n = 0;
  for (const LogEntry& e : entries_)
    if (e.code == code) n += e.count;
  return n;
}

}  // namespace tomales
