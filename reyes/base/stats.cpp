#include "reyes/base/stats.h"

#include <ctime>

namespace tomales {

double Stats::lightRays() const {
  return static_cast<double>(rays.gather + rays.transmission + rays.specular + rays.reference);
}

void Stats::addShader(const std::string& name, int64_t vertices, double time_s) {
  const std::lock_guard lock(mutex_);
  ShaderFigures& f = shaders_[name];
  f.vertices += vertices;
  f.time_s += time_s;
}

void Stats::addStage(const std::string& name, double wall_s, double cpu_s) {
  const std::lock_guard lock(mutex_);
  StageFigures& f = stages_[name];
  f.wall_s += wall_s;
  f.cpu_s += cpu_s;
}

void Stats::addAudit(const std::string& light, const AuditFigures& figures) {
  const std::lock_guard lock(mutex_);
  audits_[light] = figures;
}

void Stats::addOutput(const std::string& file) {
  const std::lock_guard lock(mutex_);
  outputs_.push_back(file);
}

std::vector<std::string> Stats::outputs() const {
  const std::lock_guard lock(mutex_);
  return outputs_;
}

std::map<std::string, Stats::AuditFigures> Stats::audits() const {
  const std::lock_guard lock(mutex_);
  return audits_;
}

std::map<std::string, Stats::ShaderFigures> Stats::byShader() const {
  const std::lock_guard lock(mutex_);
  return shaders_;
}

std::map<std::string, Stats::StageFigures> Stats::stages() const {
  const std::lock_guard lock(mutex_);
  return stages_;
}

namespace {

double secondsOf(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

double processCpuSeconds() { return secondsOf(CLOCK_PROCESS_CPUTIME_ID); }
double threadCpuSeconds() { return secondsOf(CLOCK_THREAD_CPUTIME_ID); }

StageTimer::StageTimer(Stats& stats, std::string name, double (*cpuSeconds)())
    : stats_(stats),
      name_(std::move(name)),
      start_(std::chrono::steady_clock::now()),
      cpuSeconds_(cpuSeconds),
      cpuStart_(cpuSeconds()) {}

StageTimer::~StageTimer() {
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start_;
  stats_.addStage(name_, wall.count(), cpuSeconds_() - cpuStart_);
}

}  // namespace tomales
