#include "gi/photons/emissive_photons.h"

#include <fmt/format.h>

#include "gi/gather.h"
#include "raytrace/chunks.h"
#include "raytrace/hit_list.h"
#include "reyes/base/parallel.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

/// Numbers of places that are probed for their brightness: in all, and at least and at most on one side of an object.
constexpr size_t kGlowProbes = 1 << 17, kFewestOfSide = 16, kMostOfSide = 8192;
constexpr int kMostColumns = 32;
/// Every cell counts as at least this share of the mean brightness, so that what the probes have missed still glows.
constexpr double kUnseenGlow = 0.1;
constexpr size_t kProbesPerTask = 1024;

/// Tells whether rays of every width see the coarse polygons of the object.
bool hasStarts(const Object& o) {
  for (uint32_t patch = 0; patch < o.shape().patchCount(); ++patch)
    if (hasLevels(o, patch, false)) return false;
  return o.solid < 0 && o.attributes->detail.whole();
}

vec3 towards(const vec3& normal, const vec3& local) {
  vec3 tangent, bitangent;
  orthonormalBasis(normal, tangent, bitangent);
  return local.x * tangent + local.y * bitangent + local.z * normal;
}

}  // namespace

std::vector<vec3> emittedRadiance(const RayScene& rays, const ShadingSystem& shading, const std::vector<Ray>& from,
                                  const std::vector<Hit>& hits, const std::vector<SampleName>& names, uint32_t seed) {
  ShadeContext context{.kind = RayKind::Diffuse, .diffuseDepth = 1, .seed = seed, .lightSamples = 1, .indirect = false};
  context.illumination = Illumination::None;
  std::vector<vec3> out;
  rays.shadeHits(from, hits, names, shading, context, out);
  return out;
}

EmissivePhotons::EmissivePhotons(const RayScene& rays, const ShadingSystem& shading, uint32_t seed, Log& log)
    : rays_(rays), shading_(shading), seed_(seed) {
  const Scene& scene = rays.scene();
  const Camera camera(scene.options);
  std::vector<int> glowing;
  std::vector<const Object*> leftOut;
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& o = scene.objects[i];
    if (!shading.group(o.group).emits() || !o.attributes->visibility.diffuse) continue;
    if (hasStarts(o))
      glowing.push_back(static_cast<int>(i));
    else
      leftOut.push_back(&o);
  }
  const size_t mostProbes =
      std::clamp(kGlowProbes / (2 * std::max<size_t>(glowing.size(), 1)), kFewestOfSide, kMostOfSide);
  for (const int i : glowing) {
    const auto mesh = std::make_shared<const CoarseGroup>(tessellateObject(scene, camera, shading, i, log));
    for (const bool back : {false, true}) {
      Surface surface{mesh, back, 1, {}};
      survey(surface, mostProbes);
      if (!(surface.cells.total() > 0)) continue;
      choice_.add(surface.cells.total());
      surfaces_.push_back(std::move(surface));
    }
  }
  if (leftOut.empty()) return;
  const Object& one = *leftOut.front();
  log.report(Severity::Warning, "photons-glow", one.where,
             fmt::format("{}: its shader may add light of its own, but no photons start on it, because it is part of "
                         "a solid, fades into another level of detail, or is seen by rays in several tessellations or "
                         "in micropolygons{}. After the first bounce its light is missing; an area light in its place "
                         "would have it",
                         objectName(one),
                         leftOut.size() > 1 ? fmt::format(" (likewise {} other objects)", leftOut.size() - 1) : ""));
}

void EmissivePhotons::survey(Surface& out, size_t mostProbes) const {
  const size_t polygons = out.mesh->quads.size();
  if (polygons == 0) return;
  out.columns = std::clamp(static_cast<int>(std::sqrt(mostProbes / polygons)), 1, kMostColumns);
  // Neighbouring cells share a probe if there are more cells than probes.
  const size_t perPolygon = static_cast<size_t>(out.columns * out.columns), cells = polygons * perPolygon,
               run = (cells + mostProbes - 1) / mostProbes, asked = (cells + run - 1) / run;
  std::vector<double> brightness(asked, 0.0), areas(cells, 0.0);
  parallelFor(asked, kProbesPerTask, [&](size_t begin, size_t end) {
    std::vector<Start> starts;
    std::vector<vec3> directions;
    std::vector<SampleName> names;
    for (size_t k = begin; k < end; ++k) {
      const size_t first = k * run, last = std::min(cells, first + run);
      for (size_t c = first; c < last; ++c)
        areas[c] =
            double{areaOf(out.mesh->corners(static_cast<uint32_t>(c / perPolygon)))} / static_cast<double>(perPolygon);
      const uint32_t name = hashCombine(randomStream("phot"), static_cast<uint32_t>(k));
      const size_t one =
          first +
          std::min(last - first - 1, static_cast<size_t>(unitFloat(hash32(name)) * static_cast<float>(last - first)));
      starts.push_back(startIn(out, one, sobol2(static_cast<uint32_t>(k), randomStream("phot"))));
      directions.push_back(towards(starts.back().normal, cosineHemisphere(sobol2(static_cast<uint32_t>(k), name))));
      names.push_back({name, 0});
    }
    const std::vector<vec3> radiance = radianceAlong(starts, directions, names);
    for (size_t k = begin; k < end; ++k) brightness[k] = double{luminance(radiance[k - begin])};
  });
  double sum = 0, area = 0;
  for (size_t c = 0; c < cells; ++c) {
    sum += areas[c] * brightness[c / run];
    area += areas[c];
  }
  if (!(sum > 0)) return;
  for (size_t c = 0; c < cells; ++c)
    out.cells.add(double{kPi} * areas[c] * (brightness[c / run] + kUnseenGlow * sum / area));
}

EmissivePhotons::Start EmissivePhotons::startIn(const Surface& surface, size_t cell, vec2 at) {
  const auto n = static_cast<size_t>(surface.columns);
  const vec2 corner(static_cast<float>(cell % n), static_cast<float>(cell / n % n)),
      uv = glm::min((corner + at) / static_cast<float>(n), vec2(1));
  const CoarseGroup& mesh = *surface.mesh;
  const auto quad = static_cast<uint32_t>(cell / (n * n));
  const std::array<vec3, 4> p = mesh.corners(quad);
  const bool first = uv.x + uv.y <= 1;  // tells which of the two triangles that rays meet, cut from corner 1 to 3
  const vec3 spanned = first ? cross(p[1] - p[0], p[3] - p[0]) : cross(p[3] - p[2], p[1] - p[2]),
             geometric = normalizeOr(mesh.flipsNormal ? -spanned : spanned, vec3(0, 0, -1));
  const Lattice& lattice = mesh.latticeOf(quad);
  const vec2 ofPatch = mesh.patchParameters(quad, uv.x, uv.y);
  const Quad& q = mesh.quads[quad];
  const vec3 normal =
      glm::mix(glm::mix(mesh.N[q[0]], mesh.N[q[1]], uv.x), glm::mix(mesh.N[q[3]], mesh.N[q[2]], uv.x), uv.y);
  Start out;
  out.P = mesh.pointOn(quad, uv.x, uv.y);
  out.hit = hitOn(lattice.object, lattice.patch, ofPatch, out.P, normalizeOr(normal, geometric), geometric);
  out.normal = surface.back ? -geometric : geometric;
  out.area = mesh.keeps(quad, uv.x, uv.y) ? glm::length(spanned) / static_cast<float>(n * n) : 0.0f;
  return out;
}

std::vector<vec3> EmissivePhotons::radianceAlong(const std::vector<Start>& starts, const std::vector<vec3>& directions,
                                                 const std::vector<SampleName>& names) const {
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  for (size_t i = 0; i < starts.size(); ++i) {
    // The ray's radius filters what is seen from here over the cell.
    const vec3& P = starts[i].P;
    const float radius = std::max(0.5f * std::sqrt(starts[i].area), roundingAt(P) + 1e-20f);
    Ray ray{P + radius * directions[i], -directions[i]};
    ray.radius = radius;
    rays.push_back(ray);
    hits.push_back(starts[i].hit);
    hits.back().t = radius;
  }
  std::vector<vec3> out = emittedRadiance(rays_, shading_, rays, hits, names, seed_);
  for (vec3& L : out) L = isFinite(L) ? glm::max(L, 0.0f) : vec3(0);
  return out;
}

void EmissivePhotons::emit(uint32_t first, uint32_t seed, std::vector<EmittedPhoton>& out) const {
  const StartNumbers xi = startNumbers(first, hashCombine(seed, randomStream("phot")), out.size());
  std::vector<vec3> directions(out.size());
  cosineHemispheres(xi.b, directions);
  std::vector<Start> starts;
  std::vector<SampleName> names;
  std::vector<double> pdf;  // density over the numbers that choose the place in a cell
  for (size_t i = 0; i < out.size(); ++i) {
    double x{xi.a[i].x};
    const Surface& surface = surfaces_[choice_.pick(x)];
    const size_t cell = surface.cells.pick(x);
    starts.push_back(startIn(surface, cell, {static_cast<float>(x), xi.a[i].y}));
    pdf.push_back(surface.cells.weight(cell) / choice_.total());
    const float cosine = directions[i].z;
    directions[i] = towards(starts[i].normal, directions[i]);
    names.push_back({hashCombine(seed, randomStream("phot"), first + static_cast<uint32_t>(i)), 0});
    Ray& ray = out[i].ray;
    ray = {starts[i].P, directions[i]};
    rays_.prepareOrigin(rays_.groupOf(starts[i].hit), ray.origin, 0, ray);
    ray.offset = slantedOffset(ray.offset, cosine);
    out[i].normal = starts[i].normal;
  }
  const std::vector<vec3> radiance = radianceAlong(starts, directions, names);
  for (size_t i = 0; i < out.size(); ++i)
    out[i].power = radiance[i] * static_cast<float>(double{kPi} * double{starts[i].area} / pdf[i]);
}

}  // namespace tomales
