#include "reyes/app/relight/work_order.h"

namespace tomales {
namespace {

int64_t squaredDistance(const PixelRect& part, const ivec2& from) {
  const int64_t dx = (part.x0 + part.x1) / 2 - from.x, dy = (part.y0 + part.y1) / 2 - from.y;
  return dx * dx + dy * dy;
}

WorkStep stepFor(WorkStep::Kind kind, const EditedLayers& layers, size_t layer, size_t part = 0) {
  return {kind,
          layer,
          part,
          layers[layer].parts.wanted(),
          layers.editFor(layer),
          layer == layers.variableLayer() ? layers.variable() : "",
          {}};
}

}  // namespace

// Returns the outdated part that is nearest to the pointer. If several layers are outdated there, it takes the first,
// because the glow layer is subtracted from the later ones.
std::optional<WorkStep> WorkOrder::nextPart(size_t from, size_t to, const EditedLayers& layers,
                                            const PictureParts& parts) const {
  std::optional<std::pair<size_t, size_t>> best;
  int64_t least = std::numeric_limits<int64_t>::max();
  for (size_t layer = from; layer < to; ++layer)
    for (size_t part = 0; part < parts.count(); ++part) {
      if (!layers[layer].parts.isOld(part) || (only && !only->overlaps(parts[part]))) continue;
      const int64_t distance = squaredDistance(parts[part], pointedAt);
      if (distance >= least) continue;
      least = distance;
      best = {layer, part};
    }
  if (!best) return std::nullopt;
  return stepFor(WorkStep::Part, layers, best->first, best->second);
}

// The order is: the whole picture, at first and when the page asks for it after an edit; then the variable that is
// shown instead; then all layers coarsely, if they were shaded before.
std::optional<WorkStep> WorkOrder::next(const EditedLayers& layers, const PictureParts& parts) const {
  const size_t last = layers.variableLayer();
  if (toGather) return WorkStep{WorkStep::Gather, 0, 0, 0, layers.present(), "", *toGather};
  if (wantsWhole)
    if (auto step = nextPart(kWhole, kGlow, layers, parts)) return step;
  if (!layers.variable().empty())
    if (auto step = nextPart(last, last + 1, layers, parts)) return step;
  for (size_t layer = kGlow; layer < last && isRehearsed; ++layer)
    if (layers[layer].parts.areOld() && layers[layer].coarse != layers[layer].parts.wanted())
      return stepFor(WorkStep::Coarse, layers, layer);
  if (auto step = nextPart(kGlow, last, layers, parts)) return step;
  if (!isChecked && !only) return WorkStep{WorkStep::Check, 0, 0, 0, layers.editFor(kGlow), "", {}};
  if (!isRehearsed && !only) return WorkStep{WorkStep::Rehearse, 0, 0, 0, layers.editFor(kGlow), "", {}};
  return std::nullopt;
}

bool WorkOrder::isWanted(const WorkStep& step, const EditedLayers& layers) const {
  if (step.kind == WorkStep::Gather) return true;
  if (step.kind == WorkStep::Check || step.kind == WorkStep::Rehearse) return false;
  return layers[step.layer].parts.wanted() == step.number;
}

void WorkOrder::finish(const WorkStep& step, EditedLayers& layers) {
  switch (step.kind) {
    case WorkStep::Part:
      layers[step.layer].parts.take(step.part, step.number);
      break;
    case WorkStep::Coarse:
      layers[step.layer].coarse = step.number;
      break;
    case WorkStep::Gather:
      toGather.reset();
      break;
    case WorkStep::Check:
      isChecked = true;
      break;
    case WorkStep::Rehearse:
      isRehearsed = true;
      break;
  }
}

}  // namespace tomales
