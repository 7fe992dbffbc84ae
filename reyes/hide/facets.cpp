#include "reyes/hide/facets.h"

#include <bit>

#include "reyes/base/rng.h"
#include "reyes/hide/gathered.h"

namespace tomales {
namespace {

/// Sets the steps of point i, whose fixed channels are filled. Texture coordinates without primitive variables are
/// bilinear in u, v.
template <class Steps>
void stepsOf(const Scene& scene, const Grid& g, const Steps& steps, ShadePoints& points, int i) {
  const ShadeGroup& group = scene.groups[static_cast<size_t>(points.group())];
  const auto put = [&](int value, float u, float v) {
    points.step(value, false)[i] = u;
    points.step(value, true)[i] = v;
  };
  // The grid's N may be of any length; that of a shaded point is 1.
  vec3 n;
  for (int axis = 0; axis < 3; ++axis) n[axis] = steps.mean(g.N(axis));
  const float sign = group.subtracted ? -1.0f : 1.0f, scale = sign * reciprocalLength(dot(n, n));
  for (int axis = 0; axis < 3; ++axis)
    put(kStepN + axis, scale * steps.uStep(g.N(axis)), scale * steps.vStep(g.N(axis)));
  const auto& c = group.attributes->textureCoordinates;
  const float u = points.channel(kU)[i], v = points.channel(kV)[i];
  const vec2 alongU = glm::mix(c[1] - c[0], c[3] - c[2], v), alongV = glm::mix(c[2] - c[0], c[3] - c[1], u);
  const vec2 su = alongU * steps.uStep(g.u()) + alongV * steps.uStep(g.v());
  const vec2 sv = alongU * steps.vStep(g.u()) + alongV * steps.vStep(g.v());
  put(kStepS, su.x, sv.x), put(kStepT, su.y, sv.y);
  put(kStepU, steps.uStep(g.u()), steps.vStep(g.u())), put(kStepV, steps.uStep(g.v()), steps.vStep(g.v()));
  int offset = 0;
  for (const Primvar& p : group.primvars) {
    for (int k = 0; k < p.width; ++k) {
      const float* f = g.primvar(offset + k);
      const float uStep = steps.uStep(f), vStep = steps.vStep(f);
      put(kStepPrimvars + offset + k, uStep, vStep);
      if (p.name == "s") put(kStepS, uStep, vStep);
      if (p.name == "t") put(kStepT, uStep, vStep);
    }
    offset += p.width;
  }
}

/// Returns the motion from the first key of a grid to its last that remains when the motion of the transformation is
/// undone.
template <class Mean>
vec3 driftOf(const Scene& scene, const Grid& g, const Mean& mean) {
  const Object& o = scene.objects[static_cast<size_t>(g.object)];
  if (o.shapes.size() == 1) return vec3(0);
  const int last = g.keyCount - 1;
  const vec3 here(mean(g.P(0, 0)), mean(g.P(0, 1)), mean(g.P(0, 2)));
  const vec3 there(mean(g.P(last, 0)), mean(g.P(last, 1)), mean(g.P(last, 2)));
  const mat4 openFromLast =
      o.cameraFromObject.at(o.keyTimes.front()) * glm::inverse(o.cameraFromObject.at(o.keyTimes.back()));
  return transformPoint(openFromLast, there) - here;
}

/// Marks the cells, by their first vertices, whose normal may turn along u or v by more than the angle of the cosine.
/// It computes no roots, and may mark too many.
TOMALES_HOT void markTurning(const Grid& g, float cosine, int32_t* __restrict turning) {
  const float *x = g.N(0), *y = g.N(1), *z = g.N(2);
  for (int a = 0, row = g.nu + 1, end = g.vertexCount() - row - 1; a < end; ++a) {
    const auto turns = [&](int b) {
      const float d = x[a] * x[b] + y[a] * y[b] + z[a] * z[b];
      const float lengths2 = (x[a] * x[a] + y[a] * y[a] + z[a] * z[a]) * (x[b] * x[b] + y[b] * y[b] + z[b] * z[b]);
      return (d > 0) & (d * d > cosine * cosine * lengths2) ? 0 : 1;
    };
    turning[a] = turns(a + 1) | turns(a + row);
  }
}

constexpr auto kFront = static_cast<int>(Side::Front), kBack = static_cast<int>(Side::Back);

/// Sets s and t of points without primitive variables of that name.
void setTextureCoordinates(const ShadeGroup& group, ShadePoints& points) {
  const Attributes& a = *group.attributes;
  const float *u = points.channel(kU), *v = points.channel(kV);
  float *s = points.channel(kS), *t = points.channel(kT);
  for (int i = 0; i < points.count(); ++i) {
    const vec2 st = a.textureAt(u[i], v[i]);
    s[i] = st.x;
    t[i] = st.y;
  }
  int offset = 0;
  for (const Primvar& p : group.primvars) {
    if (p.name == "s") std::copy_n(points.primvar(offset), points.count(), s);
    if (p.name == "t") std::copy_n(points.primvar(offset), points.count(), t);
    offset += p.width;
  }
}

}  // namespace

FacetTable::FacetTable(const Scene& scene, const Camera& camera, const GridTable& grids, const SampleBuffer& samples,
                       DeepTile& tile)
    : scene_(scene),
      camera_(camera),
      facingSign_(facingSign(camera)),
      grids_(grids),
      samples_(samples),
      tile_(tile),
      seen_(grids.cellCount(), 0),
      facetOf_(grids.cellCount(), kNotMade) {}

void FacetTable::make(std::span<const uint32_t> unseen, HideDiagnostics* diagnostics) {
  std::vector<uint32_t> alsoUnseen;
  for (const uint32_t cell : unseen)
    if (!seen_[cell]) alsoUnseen.push_back(cell);
  for (const uint32_t cell : alsoUnseen) see(cell);
  tile_.facets.reserve(static_cast<size_t>(std::count(seen_.begin(), seen_.end(), 1)));
  std::vector<uint32_t> ofFolded;
  for (Fragment& f : tile_.fragments) {
    const uint32_t cell = f.facet;
    if (facetOf_[cell] == kNotMade) {
      makeFacets(grids_.of(cell));
      if (diagnostics) countTurns(grids_.of(cell), *diagnostics);
    }
    if (facetOf_[cell] == kFolded)
      ofFolded.push_back(static_cast<uint32_t>(&f - tile_.fragments.data()));
    else
      f.facet = facetOf_[cell];
  }
  for (const uint32_t i : ofFolded) tile_.fragments[i].facet = facetOfFolded(tile_.fragments[i].facet, sideOf(i));
  for (const uint32_t cell : alsoUnseen) {
    if (facetOf_[cell] == kNotMade) makeFacets(grids_.of(cell));
    if (facetOf_[cell] == kFolded) facetOfFolded(cell, Side::Front);
  }
  tile_.batches.reserve(requests_.size());
  for (const PointRequests& requests : requests_) {
    const ShadeGroup& group = scene_.groups[static_cast<size_t>(requests.group)];
    ShadePoints& points = tile_.batches.emplace_back(requests.group, floatsOfPoint(group.primvars), group.steps);
    points.reserve(static_cast<int>(requests.list.size()));
    fill(requests, points);
    setTextureCoordinates(group, points);
  }
}

void FacetTable::makeFacets(const GridTable::Entry& entry) {
  const Grid& g = entry.grid();
  const auto number = static_cast<uint32_t>(&entry - grids_.entries().data());
  const uint8_t* seen = seen_.data() + entry.firstCell;
  const int batch = batchOf(scene_.objects[static_cast<size_t>(g.object)].group), row = g.nu + 1;
  std::vector<PointRequest>& list = requests_[static_cast<size_t>(batch)].list;
  const auto requestPoint = [&](int index, Side side) {
    list.push_back({number, index, side});
    return static_cast<int>(list.size()) - 1;
  };
  const auto corner = [&](int vertex, Side side) {
    int& point = corners_[2 * static_cast<size_t>(vertex) + (side == Side::Back)];
    if (point < 0) point = requestPoint(vertex, side);
    return point;
  };
  const bool smooth = entry.raster->smooth;
  if (smooth) corners_.assign(2 * static_cast<size_t>(g.vertexCount()), -1);
  findSides(*entry.raster, facingSign_, sides_);
  for (int cell = 0, line = 0, end = g.cellNumbers(); cell < end; ++line)
    for (const int last = cell + g.nu; cell < last; ++cell) {
      if (!seen[cell]) continue;
      const int a = cell + line, sides = sides_[static_cast<size_t>(a)];
      uint32_t& made = facetOf_[entry.firstCell + static_cast<uint32_t>(cell)];
      made = sides == (kFront | kBack) ? kFolded : static_cast<uint32_t>(tile_.facets.size());
      if (made == kFolded) continue;
      const Side side = sides == kBack ? Side::Back : Side::Front;
      Facet& facet = tile_.facets.emplace_back();
      facet.batch = batch;
      facet.matte = entry.raster->matte;
      if (smooth) {
        const int vertices[4] = {a, a + 1, a + row, a + row + 1};
        for (int k = 0; k < 4; ++k) facet.point[k] = corner(vertices[k], side);
      } else {
        std::fill_n(facet.point, 4, requestPoint(cell, side));
      }
    }
}

Side FacetTable::sideOf(uint32_t number) const {
  const Fragment& fragment = tile_.fragments[number];
  const auto after = std::upper_bound(tile_.pixels.begin(), tile_.pixels.end(), number,
                                      [](uint32_t n, const DeepPixel& p) { return n < p.first; });
  const auto pixel = static_cast<size_t>(after - tile_.pixels.begin()) - 1;
  const GridTable::Entry& entry = grids_.of(fragment.facet);
  const size_t lane = pixel * static_cast<size_t>(samples_.lanes) + size_t{64} * fragment.word +
                      static_cast<size_t>(std::countr_zero(fragment.samples));
  return sideAt(entry, camera_, static_cast<int>(fragment.facet - entry.firstCell), samplePoint(samples_, lane));
}

uint32_t FacetTable::facetOfFolded(uint32_t number, Side side) {
  const GridTable::Entry& entry = grids_.of(number);
  const Grid& g = entry.grid();
  const int cell = static_cast<int>(number - entry.firstCell);
  const auto [at, isNew] = folded_.try_emplace({number, side}, static_cast<uint32_t>(tile_.facets.size()));
  if (!isNew) return at->second;
  Facet& facet = tile_.facets.emplace_back();
  facet.batch = batchOf(scene_.objects[static_cast<size_t>(g.object)].group);
  facet.matte = entry.raster->matte;
  std::vector<PointRequest>& list = requests_[static_cast<size_t>(facet.batch)].list;
  const int a = firstVertex(g, cell), row = g.nu + 1, points[] = {a, a + 1, a + row, a + row + 1};
  for (int k = 0; k < 4; ++k) {
    if (k == 0 || entry.raster->smooth)
      list.push_back(
          {static_cast<uint32_t>(&entry - grids_.entries().data()), entry.raster->smooth ? points[k] : cell, side});
    facet.point[k] = static_cast<int>(list.size()) - 1;
  }
  return at->second;
}

void FacetTable::countTurns(const GridTable::Entry& entry, HideDiagnostics& diagnostics) {
  const RasterGrid& r = *entry.raster;
  const Grid& g = *r.grid;
  constexpr float kCosine = 0.92f;  // 23 degrees
  // sagitta of the arc over an edge; a thinner one shows no corners in its outline
  constexpr float kSagitta_px = 0.05f;
  const auto turns = [&](int a, int b) {
    const vec3 n = normalizeOr(g.normal(a), vec3(0)), m = normalizeOr(g.normal(b), vec3(0));
    const float cosine = dot(n, m);
    if (cosine >= kCosine || n == vec3(0) || m == vec3(0)) return false;
    const auto i = static_cast<size_t>(a), j = static_cast<size_t>(b);
    return glm::length(vec2(r.x[i] - r.x[j], r.y[i] - r.y[j])) * std::acos(std::max(cosine, -1.0f)) > 8 * kSagitta_px;
  };
  const uint8_t* seen = seen_.data() + entry.firstCell;
  const int cells = g.cellNumbers();
  HideDiagnostics::Turns& out = diagnostics.turns[g.object];
  out.all += std::count(seen, seen + cells, 1);
  if (g.displaced || g.round || r.blur) return;  // a displaced surface may be rough by intention
  turning_.resize(static_cast<size_t>(g.stride()));
  markTurning(g, 1.01f * kCosine, turning_.data());
  for (int row = 0, cell = 0; cell < cells; ++row)
    for (const int end = cell + g.nu; cell < end; ++cell) {
      const int a = cell + row;
      if (seen[cell] & turning_[static_cast<size_t>(a)]) out.turned += turns(a, a + 1) || turns(a, a + g.nu + 1);
    }
}

int FacetTable::batchOf(int group) {
  // Groups may be added while the bucket is being hidden.
  const auto g = static_cast<size_t>(group);
  if (g >= batchOf_.size()) batchOf_.resize(g + 1, -1);
  int& batch = batchOf_[g];
  if (batch < 0) {
    batch = static_cast<int>(requests_.size());
    requests_.push_back({group, {}});
  }
  return batch;
}

void FacetTable::fill(const PointRequests& requests, ShadePoints& points) const {
  Gathered gathered{};
  const bool subtracted = scene_.groups[static_cast<size_t>(requests.group)].subtracted;
  const int count = static_cast<int>(requests.list.size()), floats = points.primvarFloats();
  for (int first = 0; first < count; first += kLanes) {
    const std::span<const PointRequest> block(requests.list.data() + first,
                                              static_cast<size_t>(std::min(kLanes, count - first)));
    for (size_t i = 0; i < block.size();) {
      const PointRequest& w = block[i];
      const GridTable::Entry& entry = grids_.entries()[w.entry];
      const Grid& g = entry.grid();
      const bool vertex = entry.raster->smooth;
      const int run = vertex ? 1 : runLength(g, block.subspan(i)), a = vertex ? w.index : firstVertex(g, w.index);
      if (vertex)
        gathered.readVertex(g, a, static_cast<int>(i));
      else
        gathered.readCells(g, a, run, static_cast<int>(i));
      const int ofPiece = vertex ? g.verticesOfPiece() : g.nu * (g.nv + 1), piece = w.index / ofPiece;
      const uint32_t key = g.pieces[static_cast<size_t>(piece)].sampleKey;
      for (int k = 0; k < run; ++k, ++i) {
        const int point = points.add(hashCombine(key, static_cast<uint32_t>(w.index - piece * ofPiece + k))),
                  c = a + k + g.nu + 1;
        gathered.side[i] = block[i].side == Side::Back ? 1.0f : -1.0f;
        const auto mean = [&](const float* f) {
          return vertex ? f[a] : 0.25f * (f[a + k] + f[a + k + 1] + f[c] + f[c + 1]);
        };
        for (int p = 0; p < floats; ++p) points.primvar(p)[point] = mean(g.primvar(p));
        if (g.keyCount > 1) points.set3(kDriftX, point, driftOf(scene_, g, mean));
      }
    }
    if (subtracted)
      for (auto& axis : gathered.N)
        for (float& n : axis) n = -n;
    derive(gathered, camera_.perspective(), PointBlock(points, first));
    for (size_t i = 0; i < block.size(); ++i)
      if (grids_.entries()[block[i].entry].grid().round) points.channel(kArea)[first + static_cast<int>(i)] *= kPi / 4;
    if (points.hasSteps()) addSteps(block, points, first);
  }
  std::fill_n(points.channel(kTime), count, -1.0f);
}

void FacetTable::addSteps(std::span<const PointRequest> requests, ShadePoints& points, int first) const {
  for (const PointRequest& w : requests) {
    const GridTable::Entry& entry = grids_.entries()[w.entry];
    if (entry.raster->smooth)
      stepsOf(scene_, entry.grid(), VertexSteps(entry.grid(), w.index), points, first++);
    else
      stepsOf(scene_, entry.grid(), CellSteps(entry.grid(), w.index), points, first++);
  }
}

int FacetTable::runLength(const Grid& g, std::span<const PointRequest> requests) {
  const PointRequest& w = requests[0];
  const auto most = std::min(requests.size(), static_cast<size_t>(g.nu - w.index % g.nu));
  size_t n = 1;
  while (n < most && requests[n].entry == w.entry && requests[n].index == w.index + static_cast<int>(n)) ++n;
  return static_cast<int>(n);
}

}  // namespace tomales
