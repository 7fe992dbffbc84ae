#include "raytrace/coarse_rate.h"

#include <fmt/format.h>

#include "reyes/dice.h"

namespace tomales {
namespace {

constexpr float kPolygon_px = 16;
constexpr float kMediumEdge = 3;  ///< Edge of medium polygons over that of micropolygons.
/// A turning normal alone does not make polygons smaller than this, because far objects need few polygons.
constexpr float kLeastPolygon_px = 1.5f;
constexpr float kTurn = 15 * kPi / 180;  ///< Greatest angle in radians between the normals at the ends of a polygon.
/// The limit on that angle for small polygons: half a circle as one polygon would be its diameter, without area.
constexpr float kMostTurn = 100 * kPi / 180;
constexpr float kEmitterTurn = 5 * kPi / 180;  ///< Brings the area of a sphere light within 0.5 %.
constexpr int kLineProbes = 5;                 ///< Odd, so that a symmetrical wave is not sampled at its zeros.
constexpr double kRateRounding = 1e-3;  ///< Half a circle is twelve polygons, whatever its sum of angles rounds to.
/// The share of its distance from the eye below which a chord's direction is all rounding error.
constexpr float kLeastChord = 1e-4f;
/// Limits for one patch; levels are diced only where rays come.
constexpr double kMostQuads = 1 << 20, kMostQuadsOfLevels = 1 << 22;
/// Number of polygons that a patch may have in any picture, and its greatest number in multiples of the polygons that
/// would cover the picture evenly. The multiple is large because a plane that reaches from the eye to the horizon needs
/// many more.
constexpr double kAlwaysQuads = 1 << 16, kMostOfPicture = 256;
constexpr double kMostSharing = 16;  ///< At most this many patches of an object share its limits.

float angleBetween(const vec3& a, const vec3& b) {
  return std::acos(std::clamp(dot(normalizeOr(a, vec3(0)), normalizeOr(b, vec3(0))), -1.0f, 1.0f));
}

/// The longest lattice line of a patch in pixels, and the greatest turn in radians along one: of the normal or of the
/// line itself, since the rim of a disk turns within its plane.
struct LineFigures {
  float length_px = 0, turn = 0;
};

LineFigures linesOf(const Grid& g, const Camera& camera, int alongStride, int acrossStride) {
  LineFigures out;
  for (int line = 0; line <= kLineProbes; ++line) {
    LineFigures sum;
    float bend = 0;
    vec3 chord(0);
    for (int k = 0; k < kLineProbes; ++k) {
      const int a = line * acrossStride + k * alongStride, b = a + alongStride;
      const vec3 p = g.position(0, a), q = g.position(0, b);
      // The pixel size by distance is defined all around the eye, unlike raster coordinates. A chord past the eye
      // counts as if it were half its length away: it fills the view whatever it is cut into.
      const float pixel = std::max(camera.pixelSize(0.5f * (p + q)), camera.pixelSize(0.5f * (q - p)));
      sum.length_px += glm::length(q - p) / std::max(pixel, 1e-20f);
      sum.turn += angleBetween(g.normal(a), g.normal(b));
      const bool clear = glm::length(q - p) > kLeastChord * glm::length(p);
      if (k > 0 && clear && chord != vec3(0)) bend += angleBetween(chord, q - p);
      chord = clear ? q - p : vec3(0);
    }
    out.length_px = std::max(out.length_px, sum.length_px);
    out.turn = std::max({out.turn, sum.turn, bend * kLineProbes / (kLineProbes - 1)});
  }
  return out;
}

bool mayBeSeen(const Object& o, uint32_t patch, const Camera& camera) {
  const Bound3 bound = transformBound(o.cameraFromObject.at(o.keyTimes.front()), o.shape().bound(patch, UvRect{}));
  return o.attributes->visibility.camera &&
         !camera.outside(bound.grown(o.displacementBound), {0, 0, camera.xResolution(), camera.yResolution()});
}

/// Returns the greatest number of polygons that a patch may have when their edges are `edge_px` long. A small picture
/// shows few polygons, however many a patch of enormous coordinates asks for.
double mostQuads(const Object& o, const Camera& camera, float edge_px) {
  const double most = o.attributes->trace.rate == TessellationMode::Fixed ? kMostQuads : kMostQuadsOfLevels;
  const double pixels = 1.0 * camera.xResolution() * camera.yResolution();
  const double covering = pixels / (double{edge_px} * edge_px);
  // The patches of an object share the picture, and seldom do more than a few of them lie close before the eye.
  const double sharing = std::min<double>(o.shape().patchCount(), kMostSharing);
  return std::clamp(kMostOfPicture * covering, kAlwaysQuads, most) / std::max(1.0, sharing);
}

/// Limits the number of polygons. log: null reports nothing.
CoarseRate limited(const Object& o, double nu, double nv, double most, const char* remedy, Log* log) {
  if (nu * nv <= most) return {static_cast<int>(nu), static_cast<int>(nv)};
  if (log)
    log->report(Severity::Warning, "trace-tessellation", o.where,
                fmt::format("{} asks for {:.0f} x {:.0f} polygons for rays in one patch: limited to {:.0f}; {}",
                            objectName(o), nu, nv, most, remedy),
                o.where.text());
  // Halving keeps the proportions until one side is a single polygon.
  while (nu * nv > most) (nu > nv ? nu : nv) = std::ceil(std::max(nu, nv) / 2);
  return {static_cast<int>(nu), static_cast<int>(nv)};
}

/// The fineness that polygons should have.
struct Fineness {
  float edge_px, turn;  ///< Upper limits of an edge's length and of the normal's turn along it in radians.
  float least_px;       ///< Least edge length for which `turn` counts. On shorter edges the normal may turn farther.
  const char* remedy;   ///< Advice that makes the polygons coarser, for the warning.
};

Fineness finenessOf(const Attributes& a, float fineness) {
  const float rate = std::sqrt(std::max(a.shadingRate, 1e-4f)) / fineness;
  return {kPolygon_px * rate, (a.areaLight >= 0 ? kEmitterTurn : kTurn) / fineness,
          a.areaLight >= 0 ? 0.0f : kLeastPolygon_px * rate, "lower Attribute \"trace\" \"tessellation\""};
}

/// Fineness of polygons with `edge` times the edge that ShadingRate asks for, and no smaller ones.
Fineness micropolygons(const Attributes& a, float edge) {
  Fineness out = finenessOf(a, kPolygon_px / edge);
  out.least_px = out.edge_px;
  out.remedy = "raise ShadingRate";
  return out;
}

/// Area lights keep their polygons, whose area decides how bright they are.
Fineness fixedFineness(const Object& o, float longer = 1) {
  const Attributes& a = *o.attributes;
  if (a.areaLight >= 0) return finenessOf(a, std::max(a.trace.tessellation, 1e-3f));
  if (a.trace.rate == TessellationMode::Full) return micropolygons(a, longer);
  return finenessOf(a, std::max(a.trace.tessellation, 1e-3f) / longer);
}

/// Lattice lines of a patch, diced coarsely.
class PatchLines {
 public:
  PatchLines(const Scene& scene, const Camera& camera, int object, uint32_t patch)
      : object_(scene.objects[static_cast<size_t>(object)]), camera_(camera) {
    const Grid probe = diceAtOpen(scene, object, patch, UvRect{}, kLineProbes, kLineProbes);
    u_ = linesOf(probe, camera, 1, kLineProbes + 1);
    v_ = linesOf(probe, camera, kLineProbes + 1, 1);
    // The turn of displaced normals is not known beforehand, so displaced surfaces keep the pixel rate out of view too.
    byPixels_ = displacesForRays(object_) || mayBeSeen(object_, patch, camera);
  }

  CoarseRate rate(const Fineness& fineness, Log* log) const {
    return limited(object_, count(u_, fineness), count(v_, fineness), mostQuads(object_, camera_, fineness.edge_px),
                   fineness.remedy, log);
  }

 private:
  double count(const LineFigures& f, const Fineness& fineness) const {
    double n = double{f.turn} / fineness.turn;
    if (fineness.least_px > 0) n = std::min(n, double{f.length_px} / fineness.least_px);
    n = std::max(n, double{f.turn} / kMostTurn);
    if (byPixels_) n = std::max(n, double{f.length_px} / fineness.edge_px);
    return std::isfinite(n) ? std::max(1.0, std::ceil(n - kRateRounding)) : 1.0;
  }

  const Object& object_;
  const Camera& camera_;
  LineFigures u_, v_;
  bool byPixels_;
};

}  // namespace

bool displacesForRays(const Object& o) { return o.attributes->trace.displacements && o.attributes->displacement; }

CoarseRate coarseRate(const Scene& scene, const Camera& camera, int object, uint32_t patch, float longer, Log* log) {
  const Object& o = scene.objects[static_cast<size_t>(object)];
  if (isExactQuad(o, patch)) return {1, 1};
  return PatchLines(scene, camera, object, patch).rate(fixedFineness(o, longer), log);
}

std::array<CoarseRate, kLevelsInChunks> levelRates(const Scene& scene, const Camera& camera, int object, uint32_t patch,
                                                   Log& log) {
  const Attributes& a = *scene.objects[static_cast<size_t>(object)].attributes;
  const PatchLines lines(scene, camera, object, patch);
  const auto atLeast = [](const CoarseRate& x, const CoarseRate& y) {
    return CoarseRate{std::max(x.nu, y.nu), std::max(x.nv, y.nv)};
  };
  const CoarseRate coarse = lines.rate(fixedFineness(scene.objects[static_cast<size_t>(object)]), nullptr);
  const CoarseRate medium = atLeast(lines.rate(micropolygons(a, kMediumEdge), &log), coarse);
  return {atLeast(lines.rate(micropolygons(a, 1), &log), medium), medium};
}

}  // namespace tomales
