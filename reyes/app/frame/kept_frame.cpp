#include "reyes/app/frame/kept_frame.h"

#include <fmt/format.h>

#include "reyes/app/frame/provenance.h"

namespace tomales {

// Found by the structure's namespace. The structured binding stops the compiler at a member that the list lacks.
template <class A>
void fields(A& a, ShadedPoints& x) {
  auto& [Ci, Oi, variables, airCi, airOi] = x;
  each(a, Ci, Oi, variables, airCi, airOi);
}

namespace {

bool fits(const ShadedPoints& shaded, const ShadePoints& points) {
  const auto count = static_cast<size_t>(padded(points.count()));  // as ShadedPoints::resize() has it
  const auto holds = [&](const AlignedVector<float>& v) { return v.size() == count; };
  const auto holdsOrNone = [&](const AlignedVector<float>& v) { return v.empty() || v.size() == count; };
  return std::ranges::all_of(shaded.Ci, holds) && std::ranges::all_of(shaded.Oi, holds) &&
         std::ranges::all_of(shaded.variables, holds) && std::ranges::all_of(shaded.airCi, holdsOrNone) &&
         std::ranges::all_of(shaded.airOi, holdsOrNone);
}

}  // namespace

std::unique_ptr<Checkpoint> checkpointOf(const Scene& scene, ShaderRegistry& shaders, const DeepFrame& layout,
                                         const RenderSettings& settings, Log& log) {
  if (!settings.picture.resume) return nullptr;
  if (settings.quality.chooses()) {
    log.report(
        Severity::Note, "resume", {},
        "--resume keeps hidden buckets alone: light is gathered several times, with settings that the program finds");
    return nullptr;
  }
  const std::string contents = contentsOf(scene, shaders, settings);
  if (contents.empty()) {
    log.report(
        Severity::Note, "resume", {},
        "--resume keeps hidden buckets alone: procedurals, files of light, or files whose names shaders compute are "
        "read while the frame is rendered and might change between runs");
    return nullptr;
  }
  const PixelRect& crop = layout.crop;  // records lie where it shows something
  const std::string identity = fmt::format("{} {} {} {} {} {} {}", contents, layout.bucketWidth, layout.bucketHeight,
                                           crop.x0, crop.y0, crop.x1, crop.y1);
  return Checkpoint::create(scene.options.displays.front().name + ".kept", identity, log);
}

bool takeShaded(const Checkpoint* kept, size_t index, DeepTile& tile) {
  std::vector<ShadedPoints> shaded;
  if (!kept || !kept->take(KeptKind::ShadedTile, index, shaded) || shaded.size() != tile.batches.size()) return false;
  for (size_t b = 0; b < shaded.size(); ++b)
    if (!fits(shaded[b], tile.batches[b])) return false;
  tile.shaded = std::move(shaded);
  return true;
}

void keepShaded(Checkpoint* kept, size_t index, const DeepTile& tile) {
  if (kept && !kept->has(KeptKind::ShadedTile, index)) kept->keep(KeptKind::ShadedTile, index, tile.shaded);
}

}  // namespace tomales
