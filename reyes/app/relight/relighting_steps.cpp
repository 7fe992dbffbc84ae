// The steps of Relighting's thread: shading a part, a coarse layer, and gathering light anew.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "reyes/app/relight/relighting.h"
#include "reyes/app/relight/relighting_layers.h"

namespace tomales {

void Relighting::run(const Step& step) {
  switch (step.kind) {
    case Step::Part:
      return shadePart(step);
    case Step::Coarse:
      return shadeCoarse(step);
    case Step::Gather:
      return gather(step);
    case Step::Check:
      return checkLinearity(step);
    case Step::Rehearse:
      return rehearse(step);
  }
}

std::string Relighting::writeEdit(const EditState& edit) const {
  const std::string file = (folder_.path() / "edit.rib").string();
  std::ofstream(file) << ribOf(edit, *editable_);
  return file;
}

ShotJob& Relighting::jobFor(const EditState& edit, const std::string& variable) {
  const std::string text = ribOf(edit, *editable_) + variable;
  if (job_ && text == textOfJob_) return *job_;
  job_.reset();  // it gives the records back
  RenderSettings settings = settings_;
  settings.input.edits.push_back(writeEdit(edit));
  job_ = ShotJob::open(files_, settings, stats_, log_);
  if (!job_) throw std::runtime_error("the edit cannot be applied");
  job_->prepareToShow(variable);
  textOfJob_ = text;
  const std::lock_guard lock(mutex_);
  stale_ = job_->staleLight();
  return *job_;
}

ShownTiles Relighting::plainTiles() {
  const auto load = [this](size_t index, DeepTile& tile) {
    const auto hidden = tiles_->read(index);
    if (hidden) tile = *hidden;
    return hidden != nullptr;
  };
  return {load, [](size_t, const DeepTile&) {}};
}

void Relighting::shadePart(const Step& step) {
  ShotJob& job = jobFor(step.edit, step.variable);
  const Layer layer = [&] {
    const std::lock_guard lock(mutex_);
    const size_t old = list_[step.layer].parts.old(), all = parts_.size();
    doing_ = list_[step.layer].name;
    done_ = 1 - static_cast<float>(old) / static_cast<float>(all);
    return list_[step.layer];
  }();
  const PixelRect& part = parts_[step.part];
  if (part.width() <= 0 || part.height() <= 0) return;
  const std::string lights = layer.lights.value_or("");
  job.choose(layer.lights ? &lights : nullptr, layer.indirect);
  // Neighbouring parts need the same buckets at their border.
  SharedTiles& shared = shared_[step.layer];
  if (shared.number != step.number) shared = {step.number, {}};
  const ShownTiles tiles{[&](size_t index, DeepTile& tile) {
                           {
                             const std::lock_guard lock(sharing_);
                             if (const auto known = shared.tiles.find(index); known != shared.tiles.end()) {
                               tile = *known->second.outline;
                               tile.shaded = known->second.shaded;
                               return true;
                             }
                           }
                           if (!plainTiles().load(index, tile)) return false;
                           if (!sketches_) sketch_->add(index, tile, partOfBucket(index));
                           return true;
                         },
                         [&](size_t index, const DeepTile& tile) {
                           const bool isNeeded = isNeededBesides(layer, index, step.part);
                           const std::lock_guard lock(sharing_);
                           if (!isNeeded)
                             shared.tiles.erase(index);
                           else if (!shared.tiles.contains(index))
                             shared.tiles.emplace(index, SharedTile{outlineOf(index, tile), tile.shaded});
                         }};
  job.show(
      part, tiles, [&](const Image& rows) { take(step, rows); }, cancel_);
}

// Pre: sharing_ is locked.
std::shared_ptr<const DeepTile> Relighting::outlineOf(size_t bucket, const DeepTile& tile) {
  std::weak_ptr<const DeepTile>& known = outlines_[bucket];
  auto outline = known.lock();
  if (!outline) {
    DeepTile made = withoutPoints(tile);
    made.shaded.clear();
    outline = std::make_shared<const DeepTile>(std::move(made));
    known = outline;
  }
  return outline;
}

size_t Relighting::placeOf(int x, int y) const {
  return static_cast<size_t>(y - window_.y0) * static_cast<size_t>(window_.width()) +
         static_cast<size_t>(x - window_.x0);
}

void Relighting::take(const Step& step, const Image& rows) {
  const PixelRect part{rows.originX, rows.originY, rows.originX + rows.width, rows.originY + rows.height};
  const bool isVariable = step.layer == list_.size() - 1;
  Image finished = rows;
  if (step.layer == kWhole) {
    expose(finished, job_->shot().scene.options);
    runImager(finished, job_->job().shading());
  }
  // An imager's picture is shown as it is.
  const Image& shown = step.layer == kWhole && job_->job().shading().hasImager() ? finished : rows;
  glow_.resize(static_cast<size_t>(window_.width()) * static_cast<size_t>(window_.height()));
  std::vector<vec3> rgb;
  for (int y = 0; y < rows.height; ++y)
    for (int x = 0; x < rows.width; ++x) {
      vec3& glow = glow_[placeOf(part.x0 + x, part.y0 + y)];
      vec3 color = isVariable ? variableAt(rows, x, y, step.variable) : colorAt(shown, x, y);
      if (step.layer == kGlow) glow = color;
      if (step.layer >= kFirstLight && !isVariable) color -= glow;
      rgb.push_back(color);
    }
  layers_->put(step.layer, part, rgb, step.number);
  if (step.layer != kWhole) return;
  const std::lock_guard lock(mutex_);
  if (finished_.pixels.empty()) {
    finished_ = {window_.width(), window_.height(), {"R", "G", "B"}, {}, 0, 0, 0, 0};
    finished_.pixels.resize(3 * glow_.size());
  }
  for (int y = 0; y < rows.height; ++y)
    for (int x = 0; x < rows.width; ++x)
      std::copy_n(finished.at(x, y), 3, finished_.pixels.data() + 3 * placeOf(part.x0 + x, part.y0 + y));
}

void Relighting::shadeCoarse(const Step& step) {
  ShotJob& job = jobFor(step.edit);
  const Layer layer = [&] {
    const std::lock_guard lock(mutex_);
    doing_ = list_[step.layer].name + ", coarse";
    return list_[step.layer];
  }();
  job.choose(&*layer.lights, layer.indirect);
  std::vector<vec3> colors = sketch_->shade(job);
  if (step.layer == kGlow) {
    coarseGlow_ = colors;
  } else {
    for (size_t i = 0; i < colors.size(); ++i) colors[i] -= coarseGlow_[i];
  }
  const std::lock_guard lock(mutex_);
  if (cancel_) return;
  list_[step.layer].parts.forgetAll();
  layers_->putCoarse(step.layer, colors, step.number);
}

// Rays of the coarse picture are traced once while nobody waits for it, and what they may meet is read.
void Relighting::rehearse(const Step& step) {
  ShotJob& job = jobFor(step.edit);
  tell("preparing for edits", 0);
  for (size_t layer = kGlow; layer + 1 < list_.size() && !cancel_; ++layer) {
    job.choose(&*list_[layer].lights, list_[layer].indirect);
    std::vector<vec3> colors = sketch_->shade(job);
    if (layer == kGlow) coarseGlow_ = std::move(colors);
  }
}

// The records of these pixels are made anew, as by `tomales gather --crop`.
void Relighting::gather(const Step& step) {
  const auto width = static_cast<float>(files_->dfb().shot().scene.options.xResolution),
             height = static_cast<float>(files_->dfb().shot().scene.options.yResolution);
  const PixelRect& p = step.pixels;
  RenderSettings settings = settings_;
  settings.input.edits.push_back(writeEdit(step.edit));
  settings.picture.crop = {static_cast<float>(p.x0) / width, static_cast<float>(p.x1) / width,
                           static_cast<float>(p.y0) / height, static_cast<float>(p.y1) / height};
  settings.picture.output = (folder_.path() / fmt::format("gathered-{}.icf", gathered_.size())).string();
  job_.reset();
  if (auto job = ShotJob::open(files_, settings, stats_, log_)) {
    job->gatherIrradiance();
  }
  const std::string before = settings_.stored.irradiance;
  const bool isGathered = std::filesystem::exists(settings.picture.output);
  if (isGathered) settings_.stored.irradiance = settings.picture.output;
  if (!openFiles()) throw std::runtime_error("what was gathered cannot be read");
  sketch_->forgetRays();
  if (before.starts_with(folder_.path().string()) && before != settings_.stored.irradiance)
    std::filesystem::remove(before);
  const std::lock_guard lock(mutex_);
  if (!isGathered) return;
  gatheredFile_ = settings_.stored.irradiance;
  gathered_.push_back({p.x0 - window_.x0, p.y0 - window_.y0, p.x1 - window_.x0, p.y1 - window_.y0});
  for (Layer& layer : list_) layer.parts.forgetAll();
  for (SharedTiles& shared : shared_) shared = {};
}

}  // namespace tomales
