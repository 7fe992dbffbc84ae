// Three kinds of borders are closed in three ways (docs/decisions/0003). A border that joins a piece of the same
// surface reaches over that piece. A straight open border ends at the line between the ends of its whole edge, which
// any neighbour shares. A curved open border reaches beyond its own chords.
#include "reyes/hide/borders.h"

namespace tomales {
namespace {

constexpr float kLeastSlant = 0.05f;  // Least slant, for faces seen edge on.
// A neighbour with edges twice as long has four times the sagitta of ours.
constexpr float kReach = 4;
// An open border reaches its own curve if that bulges; if not, the curve of a neighbour bulges, and the neighbour
// reaches over.
constexpr float kReachOpen = 1.5f;
/// Greatest share of a cell by which an open border reaches out, so that small shapes do not grow.
constexpr float kShareOfCell = 1 / 128.0f;
// A neighbour displaces other points of the border than we do, so its chords may lie farther from ours than on a smooth
// surface: by kReachDisplaced sagittas if the border is smooth, and by kReachRough times its roughness.
constexpr float kReachDisplaced = 8, kReachRough = 24;
/// Number of lines of a piece, from the border inward, whose roughness counts: the border itself may look smooth by
/// chance.
constexpr int kRoughLines = 3;
// Displaced borders that turn away from the eye reach out by this share of the usual reach, or of a pixel if that is
// more. Beyond the horizon, more would show as a dark line around the body.
constexpr float kShareAway = 0.1f;
// Displaced borders reach out by at most this many times the width of their cell. A cell is narrow where it turns away
// from the eye, at the outline. There the neighbour lies behind, and closing a crack must not make the body larger.
constexpr float kMostOfCell = 4;
/// Raster coordinates up to this are on the lattice.
constexpr float kFarthest_px = 4096;
constexpr PatchEdge kEdges[] = {kEdgeU0, kEdgeU1, kEdgeV0, kEdgeV1};

/// One border of a piece as vertex indices: first + k * step for k in 0..count; the inner neighbour is `inward` away.
struct Border {
  PatchEdge edge;
  int first, step, inward, count;
};

std::array<Border, 4> bordersOf(const Grid& g, int first) {
  const int row = g.nu + 1;
  return {{{kEdgeU0, first, row, 1, g.nv},
           {kEdgeU1, first + g.nu, row, -1, g.nv},
           {kEdgeV0, first, 1, row, g.nu},
           {kEdgeV1, first + g.nv * row, 1, -row, g.nu}}};
}

/// Returns how far the border's curve may lie from its chord at vertex k, in pixels. On a curve of curvature c, the
/// second difference of points h apart is h^2 c, and the sagitta is h^2 c / 8.
float sagitta_px(const Grid& g, const float* x, const float* y, const Border& b, int k) {
  const int v = b.first + std::clamp(k, 1, std::max(1, b.count - 1)) * b.step;
  if (b.count > 1) {
    const vec2 before{x[v] - x[v - b.step], y[v] - y[v - b.step]}, after{x[v + b.step] - x[v], y[v + b.step] - y[v]};
    const float one = glm::length(before), other = glm::length(after), longer = std::max(one, other);
    if (!(dot(before, after) > 0)) return glm::length(after - before) / 8;
    // Only the turn counts: unevenly spaced points of a straight border, as near the tip of a paraboloid, open no
    // crack.
    const float turn = std::abs(before.x * after.y - before.y * after.x) / (one * other);
    return turn * 2 / (one + other) * longer * longer / 8;
  }
  // A single chord does not show curvature, but the normals turn as the tangents do.
  const int w = b.first;
  const vec3 turn = normalizeOr(g.normal(v), vec3(0)) - normalizeOr(g.normal(w), vec3(0));
  return glm::length(vec2(x[v] - x[w], y[v] - y[w])) * glm::length(turn) / 8;
}

float deviationAlong(const Grid& g, const float* x, const float* y, const Border& line) {
  float most = 0;
  for (int k = 0; k <= line.count; ++k) most = std::max(most, sagitta_px(g, x, y, line, k));
  return most;
}

/// Returns the sine of the angle between a direction and the border at vertex k.
float slantOf(const vec2& direction, const float* x, const float* y, const Border& b, int k) {
  const int before = b.first + std::max(k - 1, 0) * b.step, after = b.first + std::min(k + 1, b.count) * b.step;
  const vec2 along{x[after] - x[before], y[after] - y[before]};
  const float length = glm::length(along);
  return length > 0 ? std::abs(along.x * direction.y - along.y * direction.x) / length : 1.0f;
}

float longestEdge_px(const float* x, const float* y, const Border& b) {
  float longest = 0;
  for (int k = 0; k < b.count; ++k) {
    const int v = b.first + k * b.step, w = v + b.step;
    longest = std::max(longest, glm::length(vec2(x[w] - x[v], y[w] - y[v])));
  }
  return longest;
}

/// Returns how irregularly the border bends, as a sagitta: from the change between successive second differences, which
/// is tiny on a smooth curve.
float roughness_px(const float* x, const float* y, const Border& b) {
  float most = 0;
  vec2 before{0};
  for (int k = 1; k < b.count; ++k) {
    const int v = b.first + k * b.step;
    const vec2 bend{x[v - b.step] - 2 * x[v] + x[v + b.step], y[v - b.step] - 2 * y[v] + y[v + b.step]};
    const vec2 change = bend - before;
    if (k > 1) most = std::max(most, dot(change, change));
    before = bend;
  }
  return std::sqrt(most) / 8;
}

/// Returns how far a displaced border may lie from its neighbour's: up to a micropolygon.
float apart_px(const Grid& g, const float* x, const float* y, const Border& b) {
  const float edge = longestEdge_px(x, y, b);
  if (b.count < 3) return edge;  // Too few points show no roughness.
  float rough = 0;
  Border line = b;
  const int lines = std::min(kRoughLines, (std::abs(b.inward) == 1 ? g.nu : g.nv) + 1);
  for (int i = 0; i < lines && kReachRough * rough < edge; ++i, line.first += b.inward)
    rough = std::max(rough, roughness_px(x, y, line));
  if (kReachRough * rough >= edge) return edge;
  return std::min(edge, std::max(kReachRough * rough, kReachDisplaced * deviationAlong(g, x, y, b)));
}

/// Returns the sign of the raster area of the cell at vertex k of a border, u before v.
float areaSign(const float* x, const float* y, const Border& b, int k) {
  const int v = b.first + k * b.step, before = k < b.count ? v : v - b.step, after = before + b.step, in = v + b.inward;
  const vec2 along{x[after] - x[before], y[after] - y[before]}, inward{x[in] - x[v], y[in] - y[v]};
  const float turn = inward.x * along.y - inward.y * along.x;
  return b.edge == kEdgeU0 || b.edge == kEdgeV1 ? turn : -turn;
}

/// Tells whether the surface may end at a curve that bulges out at vertex k. A single chord does not show it, and
/// counts as bulging.
bool mayBulge(const float* x, const float* y, const Border& b, int k) {
  if (b.count < 2) return true;
  const int v = b.first + std::clamp(k, 1, b.count - 1) * b.step, before = v - b.step, after = v + b.step;
  const vec2 bend{x[before] - 2 * x[v] + x[after], y[before] - 2 * y[v] + y[after]};
  return dot(bend, vec2{x[v + b.inward] - x[v], y[v + b.inward] - y[v]}) > 0;
}

/// The facts that decide how far a border reaches out.
struct Reach {
  bool open;  ///< True if it ends the surface.
  bool cut;   ///< True if a line cuts off what is beyond.
  /// Reach where the border looks straight; more than kLeastReach_px if the border is displaced.
  float least_px;
};

float reachAt(const Grid& g, const Border& b, const float* x, const float* y, int k, const Reach& reach,
              float cell_px) {
  const float most_px = std::max(borderReach_px(0), reach.least_px);
  if (!reach.open) return std::clamp(kReach * sagitta_px(g, x, y, b, k), reach.least_px, most_px);
  if (reach.cut) return reach.least_px;
  const float bulge = mayBulge(x, y, b, k) ? kReachOpen * sagitta_px(g, x, y, b, k) : 0.0f;
  return std::min(bulge + std::min(reach.least_px, kShareOfCell * cell_px), most_px);
}

void pushBorder(const Grid& g, const Border& b, const float* x, const float* y, const Reach& reach, float facing,
                std::vector<vec2>& push) {
  const float most_px = std::max(borderReach_px(0), reach.least_px);
  const bool displaced = reach.least_px > kLeastReach_px;
  const float away_px = displaced ? kShareAway * std::max(1.0f, reach.least_px) : most_px;
  for (int k = 0; k <= b.count; ++k) {
    const int v = b.first + k * b.step;
    const vec2 outward{x[v] - x[v + b.inward], y[v] - y[v + b.inward]};
    const float length = glm::length(outward);
    if (!(length > 0)) continue;
    // Vertices move along the lattice, so that the other borders stay where they are, until the border itself has moved
    // by its reach.
    const float slant = std::max(slantOf(outward / length, x, y, b, k), kLeastSlant);
    const bool faces = facing * areaSign(x, y, b, k) > 0;
    const float along = reachAt(g, b, x, y, k, reach, length) / slant;
    const float limit = displaced ? std::max(away_px, std::min(most_px, kMostOfCell * length)) : most_px;
    push[static_cast<size_t>(v)] += outward * (std::min(along, faces ? limit : away_px) / length);
  }
}

vec2 onLattice(const vec2& at) { return {snapToSubpixel(at.x), snapToSubpixel(at.y)}; }

/// Returns the line of a straight edge; nothing if an end is too far away for exact coordinates.
std::optional<BorderLine> lineOf(const std::array<vec3, 2>& ends, const mat4& cameraFromObject, const Camera& camera) {
  vec2 at[2];
  for (int k = 0; k < 2; ++k) {
    const vec3 p = transformPoint(cameraFromObject, ends[static_cast<size_t>(k)]);
    if (!camera.seeable(p)) return std::nullopt;
    at[k] = camera.raster(p);
    if (!(std::max(std::abs(at[k].x), std::abs(at[k].y)) <= kFarthest_px)) return std::nullopt;
  }
  return BorderLine{onLattice(at[0]), onLattice(at[1])};
}

/// The measures that close the borders of one piece.
struct Plan {
  uint8_t reaching = 0;  ///< PatchEdge bits.
  std::array<BorderLine, 4> lines{};
};

Plan planOf(const Grid::Piece& piece, const Object& o, const Camera& camera, bool still) {
  Plan plan;
  plan.reaching = static_cast<uint8_t>(kAllEdges & ~piece.openEdges);
  for (size_t e = 0; e < 4; ++e) {
    if (!(piece.openEdges & kEdges[e])) continue;
    const auto ends = o.shape().straightEdge(piece.patch, kEdges[e]);
    if (ends && (*ends)[0] == (*ends)[1]) continue;
    const auto line = ends && still ? lineOf(*ends, o.cameraFromObject.at(o.keyTimes.front()), camera) : std::nullopt;
    if (line)
      plan.lines[e] = *line;
    else
      plan.reaching |= kEdges[e];
  }
  return plan;
}

/// Returns the borders that end at lines. They are pushed out too, because snapping to the lattice may leave nothing of
/// a narrow cell beside the line.
int edgesAtLines(const RasterGrid& r, size_t piece) {
  int edges = 0;
  for (size_t e = 0; e < 4 && !r.lines.empty(); ++e)
    if (!r.lines[4 * piece + e].none()) edges |= kEdges[e];
  return edges;
}

}  // namespace

void planBorders(RasterGrid& r, const Object& object, const Camera& camera) {
  const Grid& g = *r.grid;
  const bool lone = object.shape().isLone();
  const bool still = g.keyCount == 1 && object.shapes.size() == 1 && !g.displaced && !camera.defocuses();
  for (size_t p = 0; p < g.pieces.size(); ++p) {
    const Grid::Piece& piece = g.pieces[p];
    const auto joined = static_cast<uint8_t>(kAllEdges & ~piece.openEdges);
    const Plan plan = lone ? Plan{joined} : planOf(piece, object, camera, still);
    if (plan.reaching && r.reaching.empty()) r.reaching.resize(g.pieces.size());
    if (plan.reaching) r.reaching[p] = plan.reaching;
    // The edges of a lone cell that nothing moves are its lines.
    const bool itself = g.nu == 1 && g.nv == 1 && plan.reaching == 0;
    if (itself || std::all_of(plan.lines.begin(), plan.lines.end(), [](const BorderLine& l) { return l.none(); }))
      continue;
    r.lines.resize(4 * g.pieces.size());
    std::copy(plan.lines.begin(), plan.lines.end(), r.lines.begin() + static_cast<ptrdiff_t>(4 * p));
  }
}

void pushBorders(const RasterGrid& r, float mostOfDisplaced_px, float facing, float* x, float* y) {
  if (r.reaching.empty() && r.lines.empty()) return;
  const Grid& g = *r.grid;
  static thread_local std::vector<vec2> push;
  push.assign(static_cast<size_t>(g.vertexCount()), vec2(0));
  for (size_t p = 0; p < g.pieces.size(); ++p) {
    const int cut = edgesAtLines(r, p), pushed = cut | (r.reaching.empty() ? 0 : r.reaching[p]);
    for (const Border& b : bordersOf(g, static_cast<int>(p) * g.verticesOfPiece())) {
      if (!(pushed & b.edge)) continue;
      const bool open = g.pieces[p].openEdges & b.edge;
      const float displaced_px = open ? 0.0f : std::min(mostOfDisplaced_px, apart_px(g, x, y, b));
      pushBorder(g, b, x, y, {open, (cut & b.edge) != 0, std::max(kLeastReach_px, displaced_px)}, facing, push);
    }
  }
  for (size_t v = 0; v < push.size(); ++v) {
    x[v] += push[v].x;
    y[v] += push[v].y;
  }
}

float deviation_px(const Grid& g, const float* x, const float* y) {
  const int row = g.nu + 1;
  float most = 0;
  for (int j = 0; j <= g.nv; ++j) most = std::max(most, deviationAlong(g, x, y, {kEdgeV0, j * row, 1, row, g.nu}));
  for (int i = 0; i <= g.nu; ++i) most = std::max(most, deviationAlong(g, x, y, {kEdgeU0, i, row, 1, g.nv}));
  for (int j = 0; j < g.nv; ++j)
    for (int i = 0; i < g.nu; ++i) {
      const int a = j * row + i, b = a + 1, c = a + row, d = c + 1;
      most = std::max(most, glm::length(vec2(x[a] - x[b] - x[c] + x[d], y[a] - y[b] - y[c] + y[d])) / 4);
    }
  return most;
}

}  // namespace tomales
