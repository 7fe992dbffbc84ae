#include "reyes/prim/blobby_mesh.h"

#include "reyes/base/stop.h"

namespace tomales {
namespace {

constexpr int kDeepest = 20;           ///< Greatest number of halvings of the root cell.
constexpr int kExtraLevels = 3;        ///< Further halvings of cells with more than one surface or a crease.
constexpr double kCellsOfFeature = 3;  ///< A single leaf has this many cells across.
constexpr double kLeastCosine = 0.5;   ///< Least cosine between the normals of a cell and their mean.
constexpr double kRounding = 1e-9;     ///< Rounding error of sums of leaves' values.
/// Limits on the number of cells. More would be needed if a leaf is elongated, or far smaller than another; then all
/// cells are larger by a factor between kLeastCoarsening and kMostCoarsening.
constexpr size_t kMostCells = 1 << 18, kMostCellsOfLeaf = 1 << 10;
constexpr double kLeastCoarsening = 4, kMostCoarsening = 64;

using Lattice = std::array<uint32_t, 3>;  ///< Coordinates in finest cells from the root's corner.

struct Cell {
  Lattice corner;
  uint32_t size;            ///< Edge in finest cells.
  uint32_t firstChild = 0;  ///< First of eight children; 0 if there are none.
  uint8_t inside = 0;       ///< Bit k is for corner (k & 1, k >> 1 & 1, k >> 2).
  int32_t vertex = -1;
};

/// Tells whether the corners in the set are connected along the cell's edges.
bool connected(uint8_t corners) {
  if (corners == 0) return true;
  uint8_t reached = static_cast<uint8_t>(corners & -corners);
  for (int step = 0; step < 8; ++step) {
    const uint8_t alongX = static_cast<uint8_t>((reached & 0x55) << 1 | (reached & 0xaa) >> 1),
                  alongY = static_cast<uint8_t>((reached & 0x33) << 2 | (reached & 0xcc) >> 2),
                  alongZ = static_cast<uint8_t>((reached & 0x0f) << 4 | (reached & 0xf0) >> 4);
    reached = static_cast<uint8_t>((reached | alongX | alongY | alongZ) & corners);
  }
  return reached == corners;
}

bool isOneSheet(uint8_t inside) { return connected(inside) && connected(static_cast<uint8_t>(~inside)); }

dvec3 outwardAt(const BlobField& field, const dvec3& p) {
  const dvec3 falls = -field.at(p).gradient;
  const double length = glm::length(falls);
  return length > 0 ? falls / length : dvec3(0, 0, 1);
}

/// Tells whether the surface turns by less than about two right angles in the cell. Then lines towards it meet it once.
bool isFlatEnough(const std::vector<dvec3>& crossings, const BlobField& field) {
  dvec3 mean(0);
  for (const dvec3& p : crossings) mean += outwardAt(field, p);
  for (const dvec3& p : crossings)
    if (glm::dot(outwardAt(field, p), mean) < kLeastCosine * glm::length(mean)) return false;
  return true;
}

class Contourer {
 public:
  /// `coarser` is a factor by which cells may be larger than the features require.
  Contourer(const BlobField& field, const Box& box, double coarser)
      : origin_(box.lo),
        cellsOfFeature_(kCellsOfFeature / coarser),
        mostCells_(kMostCells + kMostCellsOfLeaf * field.leavesUsed()) {
    const dvec3 size = box.hi - box.lo;
    const double side = std::max({size.x, size.y, size.z});
    const double levels = std::ceil(std::log2(std::max(1.0, side * cellsOfFeature_ / field.feature())));
    const uint32_t finest = 1u << static_cast<int>(std::min<double>(levels + kExtraLevels, kDeepest));
    unit_ = side / finest;
    cells_.push_back({{0, 0, 0}, finest});
    refine(0, field);
  }

  /// Returns the least factor on the size of cells at which the surface fits into the limits. It is estimated from the
  /// share of the box that was finished when the limit was reached: cells twice as large are a quarter as many.
  double wantedCoarsening() const {
    return std::clamp(std::sqrt(std::pow(unit_ * cells_[0].size, 3) / std::max(done_, 1e-300)), kLeastCoarsening,
                      kMostCoarsening);
  }

  /// Returns nothing if it takes too many cells.
  std::optional<BlobMesh> run() {
    if (cells_.size() > mostCells_) return {};
    for (uint32_t k = 0; k < cells_.size(); ++k)
      if (cells_[k].inside != 0 && cells_[k].inside != 0xff && cells_[k].firstChild == 0) addQuads(k);
    return std::move(out_);
  }

 private:
  dvec3 position(const Lattice& at) const { return origin_ + unit_ * dvec3(at[0], at[1], at[2]); }
  Lattice cornerOf(const Cell& cell, uint32_t k) const {
    return {cell.corner[0] + (k & 1) * cell.size, cell.corner[1] + (k >> 1 & 1) * cell.size,
            cell.corner[2] + (k >> 2) * cell.size};
  }
  Box boxOf(const Cell& cell) const { return {position(cell.corner), position(cornerOf(cell, 7))}; }

  uint8_t cornersInside(const Cell& cell, const BlobField& field) const {
    int inside = 0;
    for (uint32_t k = 0; k < 8; ++k) inside |= (field.at(position(cornerOf(cell, k))).value > kBlobSurface) << k;
    return static_cast<uint8_t>(inside);
  }

  void refine(uint32_t index, const BlobField& outer) {
    throwIfStopped();
    if (cells_.size() > mostCells_) return;
    const Box box = boxOf(cells_[index]);
    const BlobField field = outer.within(box);
    const FieldRange range = field.over(box);
    const double side = unit_ * cells_[index].size;
    if (range.lo > kBlobSurface + kRounding || range.hi < kBlobSurface - kRounding)
      return void(done_ += side * side * side);
    const double wanted = field.feature() / cellsOfFeature_;
    if (cells_[index].size == 1 || side <= wanted) {
      cells_[index].inside = cornersInside(cells_[index], field);
      const std::vector<dvec3> crossings = crossingsOf(cells_[index], field);
      const bool simple =
          isOneSheet(cells_[index].inside) && isFlatEnough(crossings, field) && !hidesGap(cells_[index], field);
      if (simple || side * (1 << kExtraLevels) <= wanted || cells_[index].size == 1) {
        done_ += side * side * side;
        return makeVertex(index, crossings, field);
      }
      cells_[index].inside = 0;
    }
    const uint32_t first = static_cast<uint32_t>(cells_.size());
    cells_[index].firstChild = first;
    for (uint32_t k = 0; k < 8; ++k) {
      const Cell& parent = cells_[index];
      Cell child{parent.corner, parent.size / 2};
      child.corner = cornerOf(child, k);
      cells_.push_back(child);
    }
    for (uint32_t k = 0; k < 8; ++k) refine(first + k, field);
  }

  /// Tells whether the surface crosses an edge twice, which happens where leaves nearly touch. All cells at an edge get
  /// the same answer.
  bool hidesGap(const Cell& cell, const BlobField& field) const {
    constexpr int kStretches = 4;
    if (field.leavesUsed() < 2) return false;
    for (uint32_t a = 0; a < 8; ++a)
      for (uint32_t axis = 0; axis < 3; ++axis) {
        const uint32_t b = a | 1u << axis;
        if (b == a || (cell.inside >> a ^ cell.inside >> b) & 1) continue;
        const dvec3 p = position(cornerOf(cell, a)), q = position(cornerOf(cell, b));
        for (int k = 1; k < kStretches; ++k)
          if ((field.at(p + (q - p) * (static_cast<double>(k) / kStretches)).value > kBlobSurface) !=
              (cell.inside >> a & 1))
            return true;
      }
    return false;
  }

  /// Returns approximate points where the surface meets the cell's edges.
  std::vector<dvec3> crossingsOf(const Cell& cell, const BlobField& field) const {
    std::vector<dvec3> out;
    for (uint32_t a = 0; a < 8; ++a)
      for (uint32_t axis = 0; axis < 3; ++axis) {
        const uint32_t b = a | 1u << axis;
        if (b == a || !((cell.inside >> a ^ cell.inside >> b) & 1)) continue;
        const dvec3 p = position(cornerOf(cell, a)), q = position(cornerOf(cell, b));
        const double f = field.at(p).value - kBlobSurface, g = field.at(q).value - kBlobSurface;
        out.push_back(p + (q - p) * (f / (f - g)));
      }
    return out;
  }

  /// Places the vertex in the middle of the crossings, and moves it onto the surface.
  void makeVertex(uint32_t index, const std::vector<dvec3>& crossings, const BlobField& field) {
    Cell& cell = cells_[index];
    dvec3 sum(0);
    for (const dvec3& p : crossings) sum += p;
    // A cell without a crossing of its own has a vertex too: a smaller neighbour may find a crossing on their common
    // edge.
    const Box box = boxOf(cell);
    const dvec3 start = crossings.empty() ? 0.5 * (box.lo + box.hi) : sum / static_cast<double>(crossings.size());
    const double reach = 2 * unit_ * cell.size;
    const dvec3 outward = outwardAt(field, start);
    const dvec3 p = start + meetSurface(field, start, outward, reach).value_or(0) * outward;
    cell.vertex = static_cast<int32_t>(out_.vertices.size());
    out_.vertices.push_back({vec3(p), vec3(outwardAt(field, p)), static_cast<float>(reach)});
  }

  /// Returns the smallest cell around a point, given in halves of finest cells so that no point lies on a face.
  uint32_t cellAround(const Lattice& halves) const {
    uint32_t index = 0;
    while (cells_[index].firstChild != 0) {
      const Cell& cell = cells_[index];
      uint32_t child = 0;
      for (uint32_t axis = 0; axis < 3; ++axis)
        child |= static_cast<uint32_t>(halves[axis] > 2 * cell.corner[axis] + cell.size) << axis;
      index = cell.firstChild + child;
    }
    return index;
  }

  void addQuads(uint32_t index) {
    const Cell& cell = cells_[index];
    for (uint32_t a = 0; a < 8; ++a)
      for (uint32_t axis = 0; axis < 3; ++axis) {
        const uint32_t b = a | 1u << axis;
        if (b != a && (cell.inside >> a ^ cell.inside >> b) & 1) addQuad(index, axis, a);
      }
  }

  /// Adds the quadrilateral across an edge of a cell, from corner `a` along `axis`, if no smaller cell has the edge;
  /// among cells of the same size the first adds it.
  void addQuad(uint32_t index, uint32_t axis, uint32_t a) {
    const Cell& cell = cells_[index];
    const uint32_t y = (axis + 1) % 3, z = (axis + 2) % 3;
    const Lattice from = cornerOf(cell, a);
    std::array<uint32_t, 4> around;
    for (uint32_t k = 0; k < 4; ++k) {
      Lattice halves{2 * from[0], 2 * from[1], 2 * from[2]};
      halves[axis] += cell.size;
      halves[y] += k & 1 ? 1 : ~0u;
      halves[z] += k & 2 ? 1 : ~0u;
      if (halves[y] > 2 * cells_[0].size || halves[z] > 2 * cells_[0].size) return;  // outside of the root
      around[k] = cellAround(halves);
      const Cell& other = cells_[around[k]];
      if (other.size < cell.size || (other.size == cell.size && around[k] < index) || other.vertex < 0) return;
    }
    BlobQuad quad;
    for (size_t k = 0; k < 4; ++k) quad.corners[k] = static_cast<uint32_t>(cells_[around[k]].vertex);
    // The corners run counter-clockwise about the axis, which leads outward if it begins inside.
    if (!(cell.inside >> a & 1)) std::swap(quad.corners[1], quad.corners[2]);
    const auto& c = quad.corners;
    if (c[0] != c[3] && c[1] != c[2]) out_.quads.push_back(quad);
  }

  const dvec3 origin_;
  const double cellsOfFeature_;
  const size_t mostCells_;
  double unit_;
  double done_ = 0;  ///< Volume of the part of the box that needs no more cells.
  std::vector<Cell> cells_;
  BlobMesh out_;
};

}  // namespace

std::optional<double> meetSurface(const BlobField& field, const dvec3& p, const dvec3& outward, double reach) {
  constexpr int kSteps = 4, kMostIterations = 60;
  const auto at = [&](double t, double& slope) {
    const FieldPoint f = field.at(p + t * outward);
    slope = glm::dot(f.gradient, outward);
    return f.value - kBlobSurface;
  };
  double slope;
  double value = at(0, slope);
  if (value == 0) return 0.0;
  const double step = std::copysign(reach / kSteps, value);
  double near = 0, far = 0;  // the surface lies between them
  const bool inside = value > 0;
  for (int k = 1; k <= kSteps && far == 0; ++k) {
    const double t = k * step;
    double slopeThere;
    if (const double there = at(t, slopeThere); (there > 0) != inside)
      far = t;
    else {
      near = t;
      value = there;
      slope = slopeThere;
    }
  }
  if (far == 0) return {};
  double t = near;
  for (int k = 0; k < kMostIterations; ++k) {
    double next = t - value / slope;
    const bool between = (next - near) * (next - far) < 0;
    if (!between) next = 0.5 * (near + far);
    const double moved = std::abs(next - t);
    t = next;
    if (moved < 1e-13 * reach) break;
    value = at(t, slope);
    if (value == 0) break;
    ((value > 0) == inside ? near : far) = t;
  }
  return t;
}

BlobMesh carriedMesh(const BlobMesh& mesh, const BlobField& field, const BlobField& moved) {
  BlobMesh out = mesh;
  for (BlobVertex& v : out.vertices) {
    throwIfStopped();
    const dvec3 start = field.carried(v.position, moved), gradient = moved.at(start).gradient;
    const double steepness = glm::length(gradient);
    const dvec3 outward = steepness > 0 ? -gradient / steepness : dvec3(v.outward);
    const std::optional<double> met = meetSurface(moved, start, outward, v.reach);
    const dvec3 p = start + met.value_or(0) * outward;
    v.position = vec3(p);
    v.outward = vec3(outwardAt(moved, p));
    if (!met) v.reach = 0;
  }
  return out;
}

BlobMesh contour(const BlobField& field, const Box& box) {
  for (double coarser = 1;;) {
    Contourer contourer(field, box, coarser);
    if (std::optional<BlobMesh> mesh = contourer.run()) {
      mesh->complete = coarser == 1;
      return std::move(*mesh);
    }
    coarser *= contourer.wantedCoarsening();
  }
}

}  // namespace tomales
