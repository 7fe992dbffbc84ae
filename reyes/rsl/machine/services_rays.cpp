// Rays: trace(), transmission(), gather(), occlusion() and indirectdiffuse().
#include "reyes/base/stop.h"
#include "reyes/rsl/machine/lists.h"

namespace tomales::compiler {
namespace {

void trace(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const TmRayOptions options = listed(call, tmRayDefaults());
  call.services.trace(call.host, call.g, &options, call.triple(0), call.triple(1), call.giveTriple(), nullptr);
}

void traceDistance(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const TmRayOptions options = listed(call, tmRayDefaults());
  call.services.trace(call.host, call.g, &options, call.triple(0), call.triple(1), TmVec3{}, call.giveNumber());
}

void transmission(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const TmRayOptions options = listed(call, tmRayDefaults());
  const TmConstVec3 from = call.triple(0), to = call.triple(1);
  const auto n = static_cast<size_t>(run.padded);
  float* const toward = run.memory.floats(3 * n);
  for (size_t i = 0; i < n; ++i) {
    toward[i] = to.x[i] - from.x[i];
    toward[n + i] = to.y[i] - from.y[i];
    toward[2 * n + i] = to.z[i] - from.z[i];
  }
  call.services.transmission(call.host, call.g, &options, from, {toward, toward + n, toward + 2 * n},
                             call.giveTriple());
}

/// The rays of a hemisphere if a shader does not give their number; indirect lights have the same default.
constexpr int32_t kRaysOfHemisphere = 64;

/// occlusion() gives a number, indirectdiffuse() a color. Both take P, N and samples, and settings. Shaders give 0
/// samples if a map or a point cloud should answer, and "samples" among the settings for a map.
void hemisphere(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  rsl::HemisphereList list;
  list.rays.samples = 0;
  list = listed(call, list);
  if (const int32_t samples = call.has(2) ? call.whole(2, "numbers of samples") : 0; samples > 0)
    list.rays.samples = samples;
  if (list.rays.samples <= 0) list.rays.samples = kRaysOfHemisphere;
  list.options.pointCloud = list.pointBased ? list.file : nullptr;
  if (s.of->op == Op::Occlusion)
    list.options.covered = call.giveNumber();
  else
    list.options.radiance = call.giveTriple();
  call.services.occlusion(call.host, call.g, &list.rays, call.triple(0), call.triple(1), &list.options);
}

/// Sets the options that a category means; false if it is unknown. `category` must live as long as the options.
bool setCategory(const std::string& category, TmRayOptions& options) {
  constexpr std::string_view kEnvironment = "environment:";
  if (category == "samplepattern")
    options.maxDistance = 0;
  else if (category.starts_with(kEnvironment))
    options.environment = category.c_str() + kEnvironment.size();
  else
    return category.empty() || category == "illuminance";
  return true;
}

void runBody(Run& run, const PreparedInstruction& s, size_t block, uint8_t* on, bool any) {
  if (!any || !run.mask->any || block >= s.blocks.size()) return;
  const Narrowed inner(run, on);
  execute(run, s.blocks[block]);
}

/// Implements sl::gather(): rays are even over the cone unless "distribution" is "cosine"; entries to be filled are
/// outputs.
void gather(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const std::string category = call.has(0) ? call.text(0) : "";
  std::vector<TmChannel> outputs;
  TmRayOptions options = tmRayDefaults();
  options.uniform = 1;
  options = listed(call, options, [&](const std::string& name, const Setting&, const rsl::Setting& value) {
    if (value.fills.x) outputs.push_back({name.c_str(), value.fills});
    return value.fills.x != nullptr;
  });
  options.coneAngle = call.one(3, "angles of a cone");
  options.samples = call.whole(4, "numbers of samples");
  if (!setCategory(category, options)) return run.missing("gathers \"" + category + "\", which is unknown");
  const TmConstVec3 P = call.copied(1), direction = call.copied(2);
  const auto n = static_cast<size_t>(run.padded);
  uint8_t *const asked = run.memory.bytes(n), *const met = run.memory.bytes(n), *const hit = run.memory.bytes(n),
                 *const missed = run.memory.bytes(n);
  std::copy_n(run.mask->on, n, asked);
  for (int32_t ray = 0; run.mask->any && !stopRequested(); ++ray) {
    std::fill_n(met, n, uint8_t{0});
    run.grid.active = asked;
    if (!call.services.gather(call.host, &run.grid, &options, P, direction, ray, met, outputs.data(),
                              static_cast<int32_t>(outputs.size())))
      break;
    call.finish();
    const bool anyHit = both(run.padded, met, run.mask->on, hit);
    std::copy_n(run.mask->on, n, missed);
    const bool anyMissed = remove(run.padded, hit, missed);
    runBody(run, s, 0, hit, anyHit);
    runBody(run, s, 1, missed, anyMissed);
  }
}

constexpr Row kRayRows[] = {{Op::Trace, trace},
                            {Op::TraceDistance, traceDistance},
                            {Op::Transmission, transmission},
                            {Op::IndirectDiffuse, hemisphere},
                            {Op::Occlusion, hemisphere},
                            {Op::Gather, gather}};

}  // namespace

std::span<const Row> rayRows() { return kRayRows; }

}  // namespace tomales::compiler
