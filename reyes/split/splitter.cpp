#include "reyes/split/splitter.h"

#include <bit>

#include "reyes/split/placement.h"

namespace tomales {
namespace {

/// Greatest number of halvings of one patch; beyond, the piece is smaller than a float can represent.
constexpr int kMaxDepth = 48;
/// A bound that is larger than the lines on its piece by this factor does not shrink with the piece: it is rounding, or
/// the circle in which a ribbon may turn. From kSlackDepth on, points measured on the piece show its position;
/// otherwise nothing near the eye would ever be culled.
constexpr float kSlack = 8;
constexpr int kSlackDepth = 8;
constexpr float kLeastReach_px = 0.05f;  ///< Vertices are snapped by this, and it closes T-vertices.
constexpr int kRound_cells = 6;  ///< A disk of at most so many cells is shaded as one cell: only P varies over it.
/// Greatest width of the bound of a dot, in edges of a micropolygon. The bound is 1.5 times as wide as the disk. A disk
/// within it takes few cells however it is measured.
constexpr float kDot = 4;
/// Lazy splitting halves a patch up to so often, and leaves a coarse piece if it then has so many grids or more.
constexpr int kHalvingsAtOnce = 6;
constexpr int64_t kGridsOfCoarse = 64;
/// A piece that so many halvings have not made a quarter as long is one across which the surface jumps.
constexpr int kVainHalvings = 8;

std::pair<UvRect, UvRect> halves(const UvRect& r, bool alongU) {
  UvRect a = r, b = r;
  if (alongU)
    a.u1 = b.u0 = 0.5f * (r.u0 + r.u1);
  else
    a.v1 = b.v0 = 0.5f * (r.v0 + r.v1);
  return {a, b};
}

/// Tells whether an interval may be halved. If not, there is no float between its ends.
bool hasMiddle(float from, float to) {
  const float middle = 0.5f * (from + to);
  return from < middle && middle < to;
}

/// Tells whether a patch is flat, also in its shading. As a single cell it then reaches out only to close T-vertices,
/// and most small ones are missed by all samples.
bool isFlat(const Object& o, uint32_t patch) {
  const std::vector<Primvar>& primvars = o.shape().primvars();
  return o.displacementBound <= 0 && o.shape().info(patch).planar &&
         std::none_of(primvars.begin(), primvars.end(), [](const Primvar& p) { return p.name == "N"; });
}

/// Tells whether a whole patch, for instance a particle, joins no neighbour, or only along straight lines. Next to
/// nothing is added to its borders then.
bool isAlone(const Object& o, uint32_t patch) {
  const PatchInfo info = o.shape().info(patch);
  if (o.displacementBound > 0 || (info.openEdges & kAllEdges) != kAllEdges) return false;
  return info.planar || o.shape().isLone();
}

}  // namespace

Splitter::Splitter(const Scene& scene, int object, const Camera& camera, const PixelRect& window, Stats& stats,
                   Splitting splitting, StopFlag stop)
    : object_(scene.objects[static_cast<size_t>(object)]),
      index_(object),
      gridSize_(scene.options.gridSize),
      longest_(2 * static_cast<int>(std::ceil(std::sqrt(static_cast<double>(gridSize_))))),
      camera_(camera),
      stats_(stats),
      lazily_(splitting == Splitting::Lazily),
      stop_(stop),
      edge_px_(std::sqrt(std::max(object_.attributes->shadingRate, 1e-4f))),
      view_(object_, camera, window),
      visits_(window, gridSize_, edge_px_) {}

std::optional<Bound3> Splitter::takeDot(uint32_t patch, std::vector<SubPatch>& out) {
  if (stopped()) return std::nullopt;
  const Bound3 bare = undisplacedBound(object_, patch, UvRect{});
  const bool seen = !view_.cannotBeSeen(bare);
  if (seen && view_.crossesEye(bare)) return bare;
  const Bound2 raster = seen ? view_.rasterOf(bare, kLeastReach_px) : Bound2{};
  const vec2 size = raster.hi - raster.lo;
  if (seen && !(std::max(size.x, size.y) <= kDot * edge_px_)) return bare;
  ++stats_.geometry.piecesVisited;
  if (seen)
    out.push_back(roundPiece(patch, UvRect{}, raster, bare.lo.z));
  else
    ++stats_.geometry.culled;
  return std::nullopt;
}

void Splitter::splitWithin(int64_t visits, uint32_t patch, const UvRect& rect, int depth, const Known* known,
                           std::vector<SubPatch>& out) {
  const auto first = static_cast<ptrdiff_t>(out.size());
  start_ = depth;
  budget_ = visits;
  flat_ = isFlat(object_, patch);
  alone_ = isAlone(object_, patch);
  split(patch, rect, depth, {}, known, out);
  const auto share = [this](const SubPatch& p) { return p.coarse ? visits_.expected(p) : 0.0; };
  double shares = 0;
  for (auto p = out.begin() + first; p != out.end(); ++p) shares += share(*p);
  for (auto p = out.begin() + first; p != out.end(); ++p)
    if (p->coarse)
      p->visits = static_cast<int64_t>(share(*p) / shares * static_cast<double>(std::max<int64_t>(budget_, 0)));
}

void Splitter::split(uint32_t patch, const UvRect& rect, int depth, Shrunk from, const Known* known,
                     std::vector<SubPatch>& out) {
  if (stopped()) return;
  if (budget_ <= 0) {
    ++givenUp_.tooMany;
    return;
  }
  --budget_;
  ++stats_.geometry.piecesVisited;
  Bound3 bare = known && known->bare ? *known->bare : undisplacedBound(object_, patch, rect);
  if (view_.cannotBeSeen(bare) || object_.shape().kept(patch, rect) == Kept::None) {
    ++stats_.geometry.culled;
    return;
  }
  const PatchSize size = known ? known->size : measure(object_, camera_, patch, rect);
  const bool still = object_.keyTimes.size() == 1;
  const float edgeLengths = size.u.length + size.v.length;
  if (!(edgeLengths > 0.25f * from.edgeLengths)) from = {edgeLengths, depth};
  if (still && depth >= kSlackDepth && glm::length(bare.size()) > kSlack * edgeLengths) {
    bare = size.probes.grown(edgeLengths);
    if (view_.cannotBeSeen(bare)) return;
  }
  const Bound3 bound = bare.grown(object_.displacementBound);
  const bool crossesEye = view_.crossesEye(bare);
  const float blur = view_.coarsening(patch, rect, bound);
  const bool binary = object_.attributes->binaryDice;
  const bool joins = !alone_ || depth > 0;
  const auto [nu, nv] = cells(size, edge_px_, blur, binary, joins);
  const bool oneCell = flat_ && nu == 1 && nv == 1;
  const float reach_px = oneCell || !joins ? kLeastReach_px : borderReach_px(object_.displacementBound);
  const auto piece = [&, nu = nu, nv = nv](bool coarse) {
    return SubPatch{.object = index_,
                    .patch = patch,
                    .rect = rect,
                    .nu = nu,
                    .nv = nv,
                    .raster = view_.rasterOf(bound, reach_px),
                    .zMin = bound.lo.z,
                    .crossesEye = crossesEye,
                    .depth = depth,
                    .coarse = coarse};
  };
  if (static_cast<int64_t>(nu) * nv <= gridSize_) {
    // A piece that moves through the eye plane does so however small it is; it is seen while it stays in front.
    if (crossesEye && !still) ++givenUp_.atEye;
    if (!still || camera_.defocuses())
      budget_ -= visits_.ofBlur(view_.rasterOf(bare, reach_px), object_.keyTimes.size());
    if (std::max(nu, nv) > longest_ && !crossesEye)
      cutAcross(patch, rect, depth + 1, nu, nv, out);
    else if (depth == 0 && nu * nv <= kRound_cells && !crossesEye && view_.canBeRound(patch))
      out.push_back(roundPiece(patch, rect, view_.rasterOf(bound, reach_px), bound.lo.z));
    else
      out.push_back(piece(false));
  } else if (lazily_ && depth - start_ >= kHalvingsAtOnce && visits_.grids(nu, nv) >= kGridsOfCoarse && !crossesEye &&
             view_.isOfOneScale(bare) && visits_.isLargelySeen(view_.rasterOf(bound, reach_px)) &&
             glm::length(bare.size()) <= kSlack * edgeLengths) {
    // Halving shrinks such a piece and its bound as it should, so that the number of its grids can be estimated.
    out.push_back(piece(true));
  } else if (depth - from.depth >= kVainHalvings && !crossesEye) {
    out.push_back(piece(false));
    out.back().nu = out.back().nv = 1;
  } else if (depth == kMaxDepth || !(hasMiddle(rect.u0, rect.u1) || hasMiddle(rect.v0, rect.v1))) {
    takeSmallest(patch, rect, depth, bound, crossesEye, view_.rasterOf(bound, reach_px), out);
  } else {
    const bool longerInU = crossesEye ? size.u.length >= size.v.length : nu >= nv;
    const bool alongU = hasMiddle(rect.u0, rect.u1) && (longerInU || !hasMiddle(rect.v0, rect.v1));
    const auto [a, b] = halves(rect, alongU);
    split(patch, a, depth + 1, from, nullptr, out);
    split(patch, b, depth + 1, from, nullptr, out);
  }
}

void Splitter::takeSmallest(uint32_t patch, const UvRect& rect, int depth, const Bound3& bound, bool crossesEye,
                            const Bound2& raster, std::vector<SubPatch>& out) {
  if (object_.shape().info(patch).planar && !crossesEye)
    out.push_back({.object = index_,
                   .patch = patch,
                   .rect = rect,
                   .nu = 1,
                   .nv = 1,
                   .raster = raster,
                   .zMin = bound.lo.z,
                   .depth = depth});
  else
    ++(depth == kMaxDepth && bound.lo.z < glm::length(bound.size()) ? givenUp_.atEye : givenUp_.tooMany);
}

void Splitter::cutAcross(uint32_t patch, const UvRect& rect, int depth, int nu, int nv, std::vector<SubPatch>& out) {
  const bool alongU = nu >= nv;
  int& cellsAlong = alongU ? nu : nv;
  int parts = (cellsAlong + longest_ - 1) / longest_;
  if (object_.attributes->binaryDice) parts = static_cast<int>(std::bit_ceil(static_cast<unsigned>(parts)));
  cellsAlong = (cellsAlong + parts - 1) / parts;
  UvRect part = rect;
  float& begin = alongU ? part.u0 : part.v0;
  float& end = alongU ? part.u1 : part.v1;
  const float from = begin, to = end;
  end = begin;
  for (int k = 1; k <= parts; ++k) {
    begin = end;
    end = k == parts ? to : lerp(from, to, static_cast<float>(k) / static_cast<float>(parts));
    --budget_;
    ++stats_.geometry.piecesVisited;
    const Bound3 bare = undisplacedBound(object_, patch, part);
    if (view_.cannotBeSeen(bare) || object_.shape().kept(patch, part) == Kept::None) {
      ++stats_.geometry.culled;
      continue;
    }
    const Bound3 bound = bare.grown(object_.displacementBound);
    out.push_back({.object = index_,
                   .patch = patch,
                   .rect = part,
                   .nu = nu,
                   .nv = nv,
                   .raster = view_.rasterOf(bound, borderReach_px(object_.displacementBound)),
                   .zMin = bound.lo.z,
                   .depth = depth});
  }
}

SubPatch Splitter::roundPiece(uint32_t patch, const UvRect& rect, const Bound2& raster, float zMin) const {
  return {
      .object = index_, .patch = patch, .rect = rect, .nu = 1, .nv = 1, .raster = raster, .zMin = zMin, .round = true};
}

}  // namespace tomales
