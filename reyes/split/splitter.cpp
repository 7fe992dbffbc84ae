#include "reyes/split/splitter.h"

#include <bit>

#include "reyes/split/placement.h"

namespace tomales {
namespace {

/// Greatest number of halvings of one patch; beyond, the piece is smaller than a float can represent.
constexpr int kMaxDepth = 48;
/// A bound that is larger than the lines on its piece by this factor does not shrink with the piece: it is rounding, or
/// the circle in which a ribbon may turn. From kSlackDepth on, the position is taken from points on the piece;
/// otherwise nothing near the eye would ever be culled.
constexpr float kSlack = 8;
constexpr int kSlackDepth = 8;
constexpr float kLeastReach_px = 0.05f;  ///< Vertices are snapped by this, and it closes T-vertices.
constexpr int kRound_cells = 6;  ///< A disk of at most this many cells is shaded as one cell: only P varies over it.
/// Greatest width of a dot's bound, in edges of a micropolygon. The bound is 1.5 times as wide as the disk. A disk of
/// this size needs few cells by any measure.
constexpr float kDot = 4;
/// Lazy splitting halves a patch at most this often, and leaves a coarse piece if it then has this many grids or more.
constexpr int kHalvingsAtOnce = 6;
constexpr int64_t kGridsOfCoarse = 64;
/// If this many halvings have not made a piece a quarter as long, the surface jumps across it.
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
/// and all samples miss most small ones.
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

Splitter::Splitter(const SplitContext& context, int object, Splitting splitting)
    : object_(context.scene.objects[static_cast<size_t>(object)]),
      index_(object),
      gridSize_(context.scene.options.gridSize),
      longest_(2 * static_cast<int>(std::ceil(std::sqrt(static_cast<double>(gridSize_))))),
      camera_(context.camera),
      stats_(context.stats),
      lazily_(splitting == Splitting::Lazily),
      stop_(context.stop),
      edge_px_(std::sqrt(std::max(object_.attributes->shadingRate, 1e-4f))),
      view_(object_, context.camera, context.window),
      visits_(context.window, gridSize_, edge_px_) {}

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

std::optional<Splitter::Measured> Splitter::measured(uint32_t patch, const UvRect& rect, int depth,
                                                     const Known* known) {
  Bound3 bare = known && known->bare ? *known->bare : undisplacedBound(object_, patch, rect);
  if (view_.cannotBeSeen(bare) || object_.shape().kept(patch, rect) == Kept::None) {
    ++stats_.geometry.culled;
    return std::nullopt;
  }
  const PatchSize size = known ? known->size : measure(object_, camera_, patch, rect);
  const float edgeLengths = size.u.length + size.v.length;
  if (isStill() && depth >= kSlackDepth && glm::length(bare.size()) > kSlack * edgeLengths) {
    bare = size.probes.grown(edgeLengths);
    if (view_.cannotBeSeen(bare)) return std::nullopt;
  }
  const Bound3 bound = bare.grown(object_.displacementBound);
  const bool joins = !alone_ || depth > 0;
  const auto [nu, nv] = cells(size, {.edge_px = edge_px_,
                                     .coarsening = view_.coarsening(patch, rect, bound),
                                     .binary = object_.attributes->binaryDice,
                                     .joins = joins});
  const bool oneCell = flat_ && nu == 1 && nv == 1;
  const float reach_px = oneCell || !joins ? kLeastReach_px : borderReach_px(object_.displacementBound);
  return Measured{size, edgeLengths, bare, bound, view_.crossesEye(bare), nu, nv, reach_px};
}

SubPatch Splitter::pieceOf(uint32_t patch, const UvRect& rect, int depth, const Measured& m) const {
  return {.object = index_,
          .patch = patch,
          .rect = rect,
          .nu = m.nu,
          .nv = m.nv,
          .raster = view_.rasterOf(m.bound, m.reach_px),
          .zMin = m.bound.lo.z,
          .crossesEye = m.crossesEye,
          .depth = depth};
}

SubPatch Splitter::oneCellOf(uint32_t patch, const UvRect& rect, int depth, const Measured& m) const {
  SubPatch out = pieceOf(patch, rect, depth, m);
  out.nu = out.nv = 1;
  return out;
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
  const std::optional<Measured> found = measured(patch, rect, depth, known);
  if (!found) return;
  const Measured& m = *found;
  if (!(m.edgeLengths > 0.25f * from.edgeLengths)) from = {m.edgeLengths, depth};
  if (static_cast<int64_t>(m.nu) * m.nv <= gridSize_) {
    takeGrid(patch, rect, depth, m, out);
  } else if (lazily_ && depth - start_ >= kHalvingsAtOnce && isEstimable(m)) {
    out.push_back(pieceOf(patch, rect, depth, m));
    out.back().coarse = true;
  } else if (depth - from.depth >= kVainHalvings && !m.crossesEye) {
    out.push_back(oneCellOf(patch, rect, depth, m));
  } else if (depth == kMaxDepth || !(hasMiddle(rect.u0, rect.u1) || hasMiddle(rect.v0, rect.v1))) {
    takeSmallest(patch, rect, depth, m, out);
  } else {
    const bool longerInU = m.crossesEye ? m.size.u.length >= m.size.v.length : m.nu >= m.nv;
    const bool alongU = hasMiddle(rect.u0, rect.u1) && (longerInU || !hasMiddle(rect.v0, rect.v1));
    const auto [a, b] = halves(rect, alongU);
    split(patch, a, depth + 1, from, nullptr, out);
    split(patch, b, depth + 1, from, nullptr, out);
  }
}

bool Splitter::isEstimable(const Measured& m) const {
  return visits_.grids(m.nu, m.nv) >= kGridsOfCoarse && !m.crossesEye && view_.isOfOneScale(m.bare) &&
         visits_.isLargelySeen(view_.rasterOf(m.bound, m.reach_px)) &&
         glm::length(m.bare.size()) <= kSlack * m.edgeLengths;
}

void Splitter::takeGrid(uint32_t patch, const UvRect& rect, int depth, const Measured& m, std::vector<SubPatch>& out) {
  // A piece that moves through the eye plane does so at any size; it is visible while it is in front.
  if (m.crossesEye && !isStill()) ++givenUp_.atEye;
  if (!isStill() || camera_.defocuses())
    budget_ -= visits_.ofBlur(view_.rasterOf(m.bare, m.reach_px), object_.keyTimes.size());
  if (std::max(m.nu, m.nv) > longest_ && !m.crossesEye)
    cutAcross(patch, rect, depth + 1, m.nu, m.nv, out);
  else if (depth == 0 && m.nu * m.nv <= kRound_cells && !m.crossesEye && view_.canBeRound(patch))
    out.push_back(roundPiece(patch, rect, view_.rasterOf(m.bound, m.reach_px), m.bound.lo.z));
  else
    out.push_back(pieceOf(patch, rect, depth, m));
}

void Splitter::takeSmallest(uint32_t patch, const UvRect& rect, int depth, const Measured& m,
                            std::vector<SubPatch>& out) {
  if (object_.shape().info(patch).planar && !m.crossesEye)
    out.push_back(oneCellOf(patch, rect, depth, m));
  else
    ++(depth == kMaxDepth && m.bound.lo.z < glm::length(m.bound.size()) ? givenUp_.atEye : givenUp_.tooMany);
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
