#include "reyes/app/watch/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace tomales {

ProgressMeter::ProgressMeter(bool wanted)
    : wanted_(wanted), terminal_(::isatty(STDOUT_FILENO) != 0), start_(std::chrono::steady_clock::now()) {}

ProgressMeter::~ProgressMeter() {
  if (wanted_ && terminal_ && shown_ >= 0) std::fputs("\n", stdout);
}

std::function<void(float)> ProgressMeter::stage(float begin, float end) {
  return [this, begin, end](float fraction) { report(begin + (end - begin) * fraction); };
}

void ProgressMeter::report(float fraction) {
  if (!wanted_) return;
  const int percent = static_cast<int>(100 * std::clamp(fraction, 0.0f, 1.0f));
  const std::lock_guard lock(mutex_);
  if (percent <= shown_) return;
  shown_ = percent;
  if (terminal_)
    showBar(percent);
  else
    std::fputs(fmt::format("R90000  {:2d}%\n", percent).c_str(), stdout);
  std::fflush(stdout);
  std::clearerr(stdout);  // a reader that has gone, as in `| head -1`, is no fault of the frame
}

void ProgressMeter::showBar(int percent) const {
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
  const auto left = static_cast<int>(percent > 0 ? passed.count() * (100 - percent) / percent : 0);
  const auto filled = static_cast<size_t>(percent * 40 / 100);
  std::fputs(fmt::format("\r[{}{}] {:3d}%  {:d}:{:02d} left ", std::string(filled, '#'), std::string(40 - filled, ' '),
                         percent, left / 60, left % 60)
                 .c_str(),
             stdout);
}

}  // namespace tomales
