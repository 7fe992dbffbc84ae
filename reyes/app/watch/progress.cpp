#include "reyes/app/watch/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

namespace tomales {
namespace {

constexpr std::chrono::seconds kTick{1};
constexpr const char* kEraseLine = "\r\033[K";  ///< ECMA-48: EL.
constexpr int kStepOfPass = 10;                 ///< Step of the progress of a pass, in per cent, off the terminal.

std::string minutes(double seconds) {
  const auto whole = static_cast<int>(seconds);
  return fmt::format("{:d}:{:02d}", whole / 60, whole % 60);
}

int percentOf(float share) { return static_cast<int>(100 * std::clamp(share, 0.0f, 1.0f)); }

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
  std::clearerr(stdout);  // a reader that has gone, as in `| head -1`, is no fault of the frame
}

}  // namespace

ProgressMeter::ProgressMeter(bool wanted, const char* pass, ProgressWatcher watcher)
    : wanted_(wanted),
      terminal_(::isatty(STDOUT_FILENO) != 0),
      watcher_(std::move(watcher)),
      start_(Clock::now()),
      pass_(pass),
      passStart_(start_) {
  if (wanted_ && terminal_) mover_ = std::thread([this] { keepMoving(); });
}

ProgressMeter::~ProgressMeter() {
  if (!mover_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  wake_.notify_one();
  mover_.join();
  print(percent_ >= 0 ? "\n" : kEraseLine);
}

void ProgressMeter::keepMoving() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, kTick, [this] { return done_; })) showBar();
}

void ProgressMeter::begin(const char* pass) {
  if (watcher_) watcher_(pass, 0);
  const std::lock_guard lock(mutex_);
  enter(pass);
}

std::function<void(float)> ProgressMeter::pass(const char* name, float begin, float end) {
  return [this, name, begin, end](float share) { report(name, share, begin + (end - begin) * share); };
}

void ProgressMeter::finish() {
  if (!wanted_) return;
  const std::lock_guard lock(mutex_);
  if (passPercent_ >= 0) tellPass(1);
  tellFrame(1);
}

void ProgressMeter::report(const char* pass, float share, float frame) {
  if (watcher_) watcher_(pass, share);
  if (!wanted_) return;
  const std::lock_guard lock(mutex_);
  if (std::string_view(pass_) != pass) enter(pass);
  if (passPercent_ < 0 && share > 0) tellPass(0);
  tellPass(share);
  tellFrame(frame);
}

void ProgressMeter::enter(const char* pass) {
  pass_ = pass;
  passStart_ = Clock::now();
  passPercent_ = -1;
}

void ProgressMeter::tellPass(float share) {
  const int percent = percentOf(share), step = terminal_ ? 1 : kStepOfPass;
  if (percent / step <= passPercent_ / step && passPercent_ >= 0) return;
  passPercent_ = percent;
  if (!terminal_) print(fmt::format("{} {:3d} %\n", pass_, percent - percent % step));
}

void ProgressMeter::tellFrame(float share) {
  const int percent = percentOf(share);
  if (percent <= percent_) return;
  percent_ = percent;
  terminal_ ? showBar() : print(fmt::format("R90000  {:2d}%\n", percent));
}

void ProgressMeter::showBar() const {
  const auto since = [](Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); };
  std::string out = kEraseLine;
  if (percent_ >= 0) {
    const auto filled = static_cast<size_t>(percent_ * 40 / 100);
    const double left = percent_ > 0 ? since(start_) * (100 - percent_) / percent_ : 0;
    out += fmt::format("[{}{}] {:3d}%  {} left  ", std::string(filled, '#'), std::string(40 - filled, ' '), percent_,
                       minutes(left));
  }
  out += pass_;
  if (passPercent_ >= 0) out += fmt::format(" {} %", passPercent_);
  print(fmt::format("{} {} ", out, minutes(since(passStart_))));
}

}  // namespace tomales
