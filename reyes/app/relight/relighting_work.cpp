// The thread of Relighting: it chooses the next step, runs it and notes that it is done.
#include "reyes/app/relight/relighting.h"
#include "reyes/app/relight/relighting_layers.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

int64_t squaredDistance(const PixelRect& part, int x, int y) {
  const int64_t dx = (part.x0 + part.x1) / 2 - x, dy = (part.y0 + part.y1) / 2 - y;
  return dx * dx + dy * dy;
}

}  // namespace

// Returns the old part that is nearest to the pointer. Of several layers there it takes the earliest, because the light
// of what shines by itself is subtracted from the other layers.
std::optional<Relighting::Step> Relighting::nextPart(size_t from, size_t to) const {
  std::optional<std::pair<size_t, size_t>> best;
  int64_t least = std::numeric_limits<int64_t>::max();
  for (size_t layer = from; layer < to; ++layer)
    for (size_t part = 0; part < parts_.size(); ++part) {
      if (!list_[layer].parts.isOld(part) || (only_ && !only_->overlaps(parts_[part]))) continue;
      const int64_t distance = squaredDistance(parts_[part], pointerX_, pointerY_);
      if (distance >= least) continue;
      least = distance;
      best = {layer, part};
    }
  if (!best) return std::nullopt;
  return stepFor(Step::Part, best->first, best->second);
}

Relighting::Step Relighting::stepFor(Step::Kind kind, size_t layer, size_t part) const {
  const Layer& of = list_[layer];
  return {kind, layer, part, of.parts.wanted(), editFor(of), &of == &list_.back() ? variable_ : "", {}};
}

// First of all comes the whole picture, and after an edit when the page asks for it; then what is shown instead; then
// all layers coarse, if they were shaded before.
std::optional<Relighting::Step> Relighting::next() const {
  const size_t last = list_.size() - 1;
  if (toGather_) return Step{Step::Gather, 0, 0, 0, present_, "", *toGather_};
  if (wantsWhole_)
    if (auto step = nextPart(kWhole, kGlow)) return step;
  if (!variable_.empty())
    if (auto step = nextPart(last, last + 1)) return step;
  for (size_t layer = kGlow; layer < last && sketches_; ++layer)
    if (list_[layer].parts.areOld() && list_[layer].coarse != list_[layer].parts.wanted())
      return stepFor(Step::Coarse, layer);
  if (auto step = nextPart(kGlow, last)) return step;
  if (!checked_ && !only_) return Step{Step::Check, 0, 0, 0, editFor(list_[kGlow]), "", {}};
  if (!sketches_ && !only_) return Step{Step::Rehearse, 0, 0, 0, editFor(list_[kGlow]), "", {}};
  return std::nullopt;
}

// Pre: the mutex is locked.
bool Relighting::isWantedStill(const Step& step) const {
  if (step.kind == Step::Gather) return true;
  if (step.kind == Step::Check || step.kind == Step::Rehearse) return false;
  return list_[step.layer].parts.wanted() == step.number;
}

void Relighting::work() {
  std::unique_lock lock(mutex_);
  while (!ended_) {
    running_ = next();
    if (!running_) {
      doing_.clear();
      layers_->wake();
      changed_.wait(lock);
      continue;
    }
    const Step step = *running_;
    cancel_ = false;
    lock.unlock();
    try {
      run(step);
    } catch (const Stopped&) {
      return;
    } catch (const std::exception& e) {
      log_.report(Severity::Error, "relight-failed", {},
                  std::string(e.what()) + "; a part of the picture is not shaded");
    }
    lock.lock();
    if (!cancel_) finish(step);
    running_.reset();
  }
}

// Pre: the mutex is locked.
void Relighting::finish(const Step& step) {
  switch (step.kind) {
    case Step::Part:
      list_[step.layer].parts.take(step.part, step.number);
      if (!list_[step.layer].parts.areOld()) layers_->dropCoarse(step.layer);
      break;
    case Step::Coarse:
      list_[step.layer].coarse = step.number;
      break;
    case Step::Gather:
      toGather_.reset();
      break;
    case Step::Check:
      checked_ = true;
      break;
    case Step::Rehearse:
      sketches_ = true;
      break;
  }
}

}  // namespace tomales
