#include "reyes/app/watch/run_report.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "reyes/app/build_info.h"
#include "reyes/app/watch/stats_json.h"
#include "reyes/base/appended_file.h"
#include "reyes/base/process.h"
#include "reyes/base/unfinished_file.h"
#include "reyes/image.h"

namespace tomales {
namespace {

constexpr const char* kIsRead = "it would replace what is read";

double secondsSince(std::chrono::steady_clock::time_point t) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
}

bool appendTo(const std::string& path, const std::string& line, std::string& why) {
  const auto file = AppendedFile::open(path, why);
  return file && file->write(line, why);
}

constexpr const char* kFrameDone = "frame-done";

/// Returns the messages of `now` that are not in `before`, with their counts and places since then.
std::vector<LogEntry> newOf(const std::vector<LogEntry>& before, std::vector<LogEntry> now) {
  for (size_t i = 0; i < before.size(); ++i) {
    now[i].count -= before[i].count;
    auto& places = now[i].places;
    const auto old = static_cast<std::ptrdiff_t>(before[i].places.size());
    if (std::ssize(places) > old) {
      places.erase(places.begin(), places.begin() + old);
      now[i].where = places.front();
    }
  }
  std::erase_if(now, [](const LogEntry& e) { return e.count == 0; });
  return now;
}

}  // namespace

RunReport::RunReport(const RenderSettings& settings, Log& log) : settings_(settings), log_(log) {
  openLog();
  startFigures();
}

void RunReport::openLog() {
  if (settings_.report.logFile.empty()) return;
  std::string why = kIsRead;
  if (isAmong(settings_.report.logFile, settings_.input.files) || !log_.alsoTo(settings_.report.logFile, why))
    return log_.report(Severity::Output, "log-write", {},
                       "\"" + settings_.report.logFile + "\" could not be written: " + why);
  log_.report(Severity::Info, "run", {},
              fmt::format("version {} ({}) on {}, process {}: {}", kVersion, sourceCommit(), hostName(), ::getpid(),
                          settings_.report.commandLine));
}

bool RunReport::appends() const { return settings_.report.statsFile.ends_with(".jsonl"); }
bool RunReport::isPerFrame() const {
  return appends() || settings_.report.statsFile.find('#') != std::string::npos ||
         (settings_.report.statsHeader && settings_.report.statsFile.empty());
}

std::string RunReport::statsFile() const { return withFrameNumber(settings_.report.statsFile, frame_.value_or(0)); }

RunFigures RunReport::figures() const {
  RunFigures out{frame_, secondsSince(start_), processCpuSeconds() - cpuStart_, std::max(peak_, peakResidentBytes()),
                 newOf(before_, log_.entries())};
  std::erase_if(out.messages, [](const LogEntry& e) { return e.code == kFrameDone; });  // the figures say it themselves
  return out;
}

void RunReport::write() {
  if (settings_.report.statsFile.empty()) return;
  const std::string file = statsFile(), text = statsText(settings_, *stats_, figures(), appends() ? -1 : 2);
  std::string why = kIsRead;
  if (isAmong(file, settings_.input.files) || !(appends() ? appendTo(file, text, why) : writeFile(file, text, why)))
    log_.report(Severity::Output, "stats-write", {}, "\"" + file + "\" could not be written: " + why);
}

void RunReport::flush() {
  if (!appends()) write();
}

void RunReport::end(const SourceLoc& where) {
  write();
  if (settings_.report.statsHeader) fillHeaders();
  say(where);
  if (isPerFrame() && settings_.report.profileShaders) printShaderProfile(*stats_);
  isPerFrame() ? startFigures() : startFrame();
}

void RunReport::fillHeaders() const {
  const std::vector<std::string> all = stats_->outputs();
  const std::string text = statsOfHeader(settings_, *stats_, figures());
  for (size_t k = outputsSaid_; k < all.size(); ++k) fillStatistics(all[k], text);
}

void RunReport::say(const SourceLoc& where) {
  std::string outputs;
  const std::vector<std::string> all = stats_->outputs();
  for (; outputsSaid_ < all.size(); ++outputsSaid_)
    outputs += (outputs.empty() ? "\"" : ", \"") + all[outputsSaid_] + '"';
  log_.report(
      Severity::Info, kFrameDone, where,
      fmt::format("frame {} of \"{}\" wrote {}; it took {:.2f} s ({:.2f} CPU s) and {:.0f} MB on {}",
                  frame_.value_or(0), settings_.input.files.empty() ? "" : settings_.input.files.front(),
                  outputs.empty() ? "nothing" : outputs, secondsSince(frameStart_),
                  processCpuSeconds() - frameCpuStart_, static_cast<double>(peakResidentBytes()) / 1e6, hostName()));
}

void RunReport::skip() { isPerFrame() ? startFigures() : startFrame(); }

void RunReport::finish() {
  if (isPerFrame()) return;
  write();
  if (settings_.report.profileShaders) printShaderProfile(*stats_);
}

void RunReport::startFrame() {
  frameStart_ = Clock::now();
  frameCpuStart_ = processCpuSeconds();
  peak_ = std::max(peak_, peakResidentBytes());
  restartPeak();
}

void RunReport::startFigures() {
  startFrame();
  stats_.emplace();
  start_ = frameStart_;
  cpuStart_ = frameCpuStart_;
  peak_ = 0;
  outputsSaid_ = 0;
  before_ = log_.entries();
}

}  // namespace tomales
