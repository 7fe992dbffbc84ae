// The thread of Relighting and its steps: shading a part, a coarse layer, and gathering light anew.
#include "reyes/app/relight/layer_sum.h"
#include "reyes/app/relight/relighting.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

constexpr size_t kPartsPerCheck = 4;  ///< One part in this many is compared with the sum of the layers.

}  // namespace

void Relighting::work() {
  while (!session_->hasEnded()) {
    const std::optional<WorkStep> step = session_->begin();
    if (!step) {
      status_.tell("");
      layers().wake();
      session_->wait();
      continue;
    }
    try {
      run(*step);
    } catch (const Stopped&) {
      return;
    } catch (const std::exception& e) {
      log_.report(Severity::Error, "relight-failed", {},
                  std::string(e.what()) + "; a part of the picture is not shaded");
    }
    if (session_->finish()) pictures_->dropCoarse(step->layer);
  }
}

void Relighting::run(const WorkStep& step) {
  switch (step.kind) {
    case WorkStep::Part:
      return shadePart(step);
    case WorkStep::Coarse:
      return shadeCoarse(step);
    case WorkStep::Gather:
      return gather(step);
    case WorkStep::Check:
      return checkLinearity(step);
    case WorkStep::Rehearse:
      return rehearse(step);
  }
}

ShotJob& Relighting::jobFor(const EditState& edit, const std::string& variable) {
  ShotJob& job = shot_.jobFor(edit, variable);
  session_->setStale(shot_.staleLight());
  return job;
}

ShownTiles Relighting::plainTiles() {
  const auto load = [this](size_t bucket, DeepTile& tile) {
    const auto hidden = shot_.tile(bucket);
    if (hidden) tile = *hidden;
    return hidden != nullptr;
  };
  return {load, [](size_t, const DeepTile&) {}};
}

/// Tiles that other parts of the layer will need are shared. Those of the first picture leave points for coarse ones.
ShownTiles Relighting::tilesOf(const WorkStep& step, const RelitLayer& layer) {
  const bool leavesPoints = !session_->isRehearsed();
  const auto load = [this, &step, leavesPoints](size_t bucket, DeepTile& tile) {
    if (shared_->load(step.layer, bucket, tile)) return true;
    if (!plainTiles().load(bucket, tile)) return false;
    if (leavesPoints) sketch_->add(bucket, tile, parts_->ofBucket(bucket));
    return true;
  };
  const auto done = [this, &step, &layer](size_t bucket, const DeepTile& tile) {
    const auto isOther = [&](size_t part) { return part != step.part && layer.parts.isOld(part); };
    if (std::ranges::any_of(parts_->needing(bucket), isOther))
      shared_->keep(step.layer, bucket, tile);
    else
      shared_->drop(step.layer, bucket);
  };
  return {load, done};
}

void Relighting::shadePart(const WorkStep& step) {
  ShotJob& job = jobFor(step.edit, step.variable);
  const RelitLayer layer = session_->layer(step.layer);
  status_.tell(layer.name, static_cast<float>(1 - layer.parts.shareOld()));
  const PixelRect& part = (*parts_)[step.part];
  if (part.width() <= 0 || part.height() <= 0) return;
  const std::string lights = layer.lights.value_or("");
  job.choose(layer.lights ? &lights : nullptr, layer.indirect);
  shared_->begin(step.layer, step.number);
  const auto take = [&](const Image& rows) { pictures_->take(step, rows, job); };
  job.show(part, tilesOf(step, layer), take, session_->stop());
}

void Relighting::shadeCoarse(const WorkStep& step) {
  ShotJob& job = jobFor(step.edit);
  const RelitLayer layer = session_->layer(step.layer);
  status_.tell(layer.name + ", coarse");
  job.choose(&*layer.lights, layer.indirect);
  std::vector<vec3> colors = sketch_->shade(job);
  pictures_->subtractGlow(step.layer, colors);
  session_->takeCoarse(step.layer, [&] { pictures_->putCoarse(step.layer, colors, step.number); });
}

// Traces the rays of the coarse picture once, while nobody waits for it, which also reads the geometry that they may
// meet.
void Relighting::rehearse(const WorkStep& step) {
  ShotJob& job = jobFor(step.edit);
  status_.tell("preparing for edits", 0);
  for (size_t i = kGlow; i + 1 < session_->layerCount() && !session_->stop().requested(); ++i) {
    const RelitLayer layer = session_->layer(i);
    job.choose(&*layer.lights, layer.indirect);
    std::vector<vec3> colors = sketch_->shade(job);
    pictures_->subtractGlow(i, colors);
  }
  job.choose(nullptr, true);  // the name that it was given ends here
}

void Relighting::gather(const WorkStep& step) {
  const std::string file = shot_.gather(step.edit, step.pixels);
  sketch_->forgetRays();
  if (file.empty()) return;
  shared_->clear();
  session_->takeGathered(file, step.pixels);
}

// Shades some parts under other gains and compares them with the mixed layers.
void Relighting::checkLinearity(const WorkStep& step) {
  status_.tell("checking that light adds up", 0);
  LayerSum sum(step.edit, *session_, layers(), shot_);
  ShotJob& job = jobFor(sum.edit());
  job.choose(nullptr, true);
  const auto compare = [&](const Image& rows) { sum.compare(rows); };
  for (size_t i = 0; i < parts_->count() && !session_->stop().requested(); i += kPartsPerCheck) {
    const PixelRect& part = (*parts_)[i];
    if (part.width() > 0 && part.height() > 0) job.show(part, plainTiles(), compare, session_->stop());
    sum.forgetBuckets();
  }
  session_->setNotLinear(sum.objectsOff());
}

}  // namespace tomales
