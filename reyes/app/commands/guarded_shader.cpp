#include "reyes/app/commands/guarded_shader.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <vector>

namespace tomales {
namespace {

/// The shader that is watched, as the one shader of a library.
struct Watched {
  const TmShader* real = nullptr;
  TmShader guarded{};
  const TmShader* list[1] = {nullptr};
  TmShaderLibrary library{};
  std::set<std::string> faults;
} watched;

/// A copy of an array between two guards.
class GuardedArray {
 public:
  GuardedArray(std::string name, const float* from, int padded)
      : name_(std::move(name)),
        padded_(static_cast<size_t>(padded)),
        memory_(padded_ + 3 * kGuard, kUntouched),
        begin_(kGuard + alignment()) {
    if (from) std::copy_n(from, padded_, data());
    before_ = memory_;
  }
  float* data() { return memory_.data() + begin_; }
  const std::string& name() const { return name_; }

  /// Tells whether anything except the active points has changed.
  bool wroteOutside() const {
    for (size_t k = 0; k < memory_.size(); ++k)
      if ((k < begin_ || k >= begin_ + padded_) && isWritten(k)) return true;
    return false;
  }
  bool wroteInactive(const std::vector<uint8_t>& active) const {
    for (size_t i = 0; i < padded_; ++i)
      if (!active[i] && isWritten(begin_ + i)) return true;
    return false;
  }
  bool isFinite(const std::vector<uint8_t>& active) const {
    for (size_t i = 0; i < padded_; ++i)
      if (active[i] && !std::isfinite(memory_[begin_ + i])) return false;
    return true;
  }

 private:
  static constexpr size_t kGuard = TM_LANES;
  static constexpr float kUntouched = -42.125f;
  size_t alignment() const {
    constexpr uintptr_t kBytes = 64;
    const auto address = reinterpret_cast<uintptr_t>(memory_.data());
    return (kBytes - address % kBytes) % kBytes / sizeof(float);
  }
  /// Compares bits, since a shader may have written a NaN.
  bool isWritten(size_t k) const { return std::bit_cast<uint32_t>(memory_[k]) != std::bit_cast<uint32_t>(before_[k]); }
  std::string name_;
  size_t padded_;
  std::vector<float> memory_;
  size_t begin_;
  std::vector<float> before_;
};

/// A copy of a batch with guarded arrays, in which every third point is switched off.
class GuardedBatch {
 public:
  explicit GuardedBatch(const TmGrid* g)
      : grid(*g), active_(static_cast<size_t>(g->padded), 0), params_(g->params, g->params + paramCount() + 1) {
    for (int i = 0; i < g->count; ++i) active_[static_cast<size_t>(i)] = g->active[i] && i % 3 != 1;
    grid.active = active_.data();
    guard("P", grid.P);
    guard("N", grid.N);
    guard("Ci", grid.Ci);
    guard("Oi", grid.Oi);
    guard("L", grid.L);
    guard("Cl", grid.Cl);
    guard("alpha", grid.alpha);
    for (int i = 0; i < paramCount(); ++i) guardOutput(watched.real->params[i], params_[static_cast<size_t>(i)]);
    grid.params = params_.data();
  }

  void noteFaults() const {
    for (const GuardedArray& a : arrays_) {
      if (a.wroteOutside()) noteFault("writes outside of its arrays, beside " + a.name());
      if (a.wroteInactive(active_)) noteFault("writes " + a.name() + " of points that are not active");
      if (!a.isFinite(active_)) noteFault("leaves NaN or infinity in " + a.name());
    }
    if (watched.real->kind == TM_SURFACE && (watched.real->capabilities & TM_KEEPS_OPACITY) && !keepsOpacity())
      noteFault("writes another Oi than Os, but has declared TM_KEEPS_OPACITY");
  }

  TmGrid grid;

 private:
  static int paramCount() { return watched.real->paramCount; }
  void guard(const std::string& name, float*& array) {
    if (array) array = arrays_.emplace_back(name, array, grid.padded).data();
  }
  void guard(const std::string& name, TmVec3& v) {
    guard(name, v.x);
    guard(name, v.y);
    guard(name, v.z);
  }
  /// Sets the array of an output that a Display wants, so that the shader writes to it.
  void guardOutput(const TmParamDecl& decl, TmValue& value) {
    if (!(decl.type & TM_OUTPUT)) return;
    const int width = TM_TYPE_OF(decl.type) == TM_FLOAT ? 1 : 3;
    for (int k = 0; k < width; ++k)
      value.c[k] = arrays_.emplace_back(fmt::format("output \"{}\"", decl.name), value.c[k], grid.padded).data();
    value.step = 1;
  }
  bool keepsOpacity() const {
    for (int i = 0; i < grid.count; ++i)
      if (active_[static_cast<size_t>(i)] &&
          (grid.Oi.x[i] != grid.Os.x[i] || grid.Oi.y[i] != grid.Os.y[i] || grid.Oi.z[i] != grid.Os.z[i]))
        return false;
    return true;
  }

  std::vector<uint8_t> active_;
  std::vector<TmValue> params_;
  std::deque<GuardedArray> arrays_;
};

void shadeGuarded(const TmGrid* g) {
  GuardedBatch batch(g);
  watched.real->shade(&batch.grid);
  batch.noteFaults();
  watched.real->shade(g);
}

}  // namespace

const TmShaderLibrary* guardedLibrary(const TmShader& shader) {
  watched.real = &shader;
  watched.guarded = shader;
  watched.guarded.shade = shadeGuarded;
  watched.list[0] = &watched.guarded;
  watched.library = {.abi = TM_SHADER_ABI,
                     .structBytes = sizeof(TmShaderLibrary),
                     .shaders = watched.list,
                     .fault = nullptr,
                     .count = 1};
  watched.faults.clear();
  return &watched.library;
}

const std::set<std::string>& guardedFaults() { return watched.faults; }

void noteFault(const std::string& fault) { watched.faults.insert(fault); }

}  // namespace tomales
