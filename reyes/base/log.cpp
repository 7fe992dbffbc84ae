#include "reyes/base/log.h"

#include <cstdio>

namespace tomales {

std::string SourceLoc::text() const {
  if (!file) return "tomales";
  return line > 0 ? *file + ":" + std::to_string(line) : *file;
}

void Log::report(Severity severity, std::string_view code, const SourceLoc& where, const std::string& message) {
  const std::lock_guard lock(mutex_);
  const auto [it, fresh] =
      index_.try_emplace({std::string(code), where.file ? *where.file : "", where.line}, entries_.size());
  if (!fresh) {
    ++entries_[it->second].count;
    return;
  }
  entries_.push_back({severity, std::string(code), message, where});
  const bool wanted = verbosity_ == Verbosity::Verbose || severity > Severity::Warning ||
                      (verbosity_ == Verbosity::Normal && severity == Severity::Warning);
  static constexpr const char* kNames[] = {"info", "warning", "missing", "error", "output error"};
  const int line = wanted ? ++lines_[entries_.back().code] : 0;
  if (wanted && line <= kMostLinesOfCode)
    std::fprintf(stderr, "%s: %s: %s [%s]\n", where.text().c_str(), kNames[static_cast<int>(severity)], message.c_str(),
                 entries_.back().code.c_str());
  if (line == kMostLinesOfCode + 1)
    std::fprintf(stderr, "tomales: more of [%s] is not printed; the statistics have it\n",
                 entries_.back().code.c_str());
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
