#include "reyes/app/watch/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace tomales {
namespace {

constexpr std::chrono::seconds kTick{1};
constexpr const char* kEraseLine = "\r\033[K";  ///< ECMA-48: EL.

std::string minutes(double seconds) {
  const auto whole = static_cast<int>(seconds);
  return fmt::format("{:d}:{:02d}", whole / 60, whole % 60);
}

}  // namespace

ProgressMeter::ProgressMeter(bool wanted, const char* phase)
    : wanted_(wanted),
      terminal_(::isatty(STDOUT_FILENO) != 0),
      start_(Clock::now()),
      phase_(phase),
      phaseStart_(start_) {
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
  std::fputs(percent_ >= 0 ? "\n" : kEraseLine, stdout);
  std::fflush(stdout);
}

void ProgressMeter::keepMoving() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, kTick, [this] { return done_; })) showBar();
}

void ProgressMeter::begin(const char* phase) {
  const std::lock_guard lock(mutex_);
  phase_ = phase, phaseStart_ = Clock::now();
}

std::function<void(float)> ProgressMeter::stage(float begin, float end) {
  return [this, begin, end](float fraction) { report(begin + (end - begin) * fraction); };
}

void ProgressMeter::report(float fraction) {
  if (!wanted_) return;
  const int percent = static_cast<int>(100 * std::clamp(fraction, 0.0f, 1.0f));
  const std::lock_guard lock(mutex_);
  if (percent <= percent_) return;
  percent_ = percent;
  if (terminal_) return showBar();
  std::fputs(fmt::format("R90000  {:2d}%\n", percent).c_str(), stdout);
  std::fflush(stdout);
  std::clearerr(stdout);  // a reader that has gone, as in `| head -1`, is no fault of the frame
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
  std::fputs(fmt::format("{}{} {} ", out, phase_, minutes(since(phaseStart_))).c_str(), stdout);
  std::fflush(stdout);
  std::clearerr(stdout);
}

}  // namespace tomales
