#include "raytrace/emitters.h"

#include <algorithm>

#include "reyes/dice.h"

namespace tomales {
namespace {

using Corners = std::array<vec3, 4>;

/// Directions are tested against at most this many facets, which costs as much as a ray. Larger emitters are not met.
constexpr size_t kMostFacets = 256;

/// Position and d/du x d/dv of the bilinear quad.
void bilinear(const Corners& q, float u, float v, vec3& P, vec3& normal) {
  const auto& [a, b, c, d] = q;
  P = glm::mix(glm::mix(a, b, u), glm::mix(d, c, u), v);
  normal = cross(glm::mix(b - a, c - d, v), glm::mix(d - a, c - b, u));
}

/// Tells whether the polygons stand for a curved surface. Where rays see displacement, the polygons are the surface.
bool isCurved(const Scene& scene, const Lattice& lattice) {
  const Object& o = scene.objects[static_cast<size_t>(lattice.object)];
  return !displacesForRays(o) && !o.shape().info(lattice.patch).planar;
}

EmitterLattice latticeOf(const Scene& scene, const CoarseGroup& g, const Lattice& lattice) {
  const bool curved = isCurved(scene, lattice);
  EmitterLattice out{
      lattice.nu,        lattice.nv, g.flipsNormal, {}, {}, curved, curved || lattice.trim ? &g : nullptr,
      lattice.firstQuad, -1};
  for (uint32_t quad = lattice.firstQuad; quad < lattice.firstQuad + lattice.nu * lattice.nv; ++quad) {
    out.quads.push_back({g.corner(quad, 0), g.corner(quad, 1), g.corner(quad, 2), g.corner(quad, 3)});
    out.normals.push_back(g.geometricNormal(quad));
  }
  return out;
}

bool near(float a, float b) { return std::abs(a - b) <= 1e-5f * std::max(std::abs(a), std::abs(b)); }

/// Returns a sphere or disk that its object's transformation leaves round.
std::optional<EmitterShape> roundShape(const Scene& scene, int object) {
  const Object& o = scene.objects[static_cast<size_t>(object)];
  const std::optional<RoundShape> round = o.shape().round();
  if (!round || displacesForRays(o)) return std::nullopt;
  const mat4 m = o.cameraFromObject.at(o.keyTimes.front());
  const bool isSphere = round->axis == vec3(0);
  vec3 tangent, bitangent;
  orthonormalBasis(isSphere ? vec3(0, 0, 1) : round->axis, tangent, bitangent);
  EmitterShape out{isSphere ? EmitterShape::Kind::Sphere : EmitterShape::Kind::Disk, transformPoint(m, round->center),
                   transformVector(m, round->radius * tangent), transformVector(m, round->radius * bitangent)};
  const vec3 w = transformVector(m, round->radius * cross(tangent, bitangent));
  const float r = glm::length(out.u);
  const auto square = [r](const vec3& a, const vec3& b) { return std::abs(dot(a, b)) <= 1e-5f * r * r; };
  if (!(r > 0) || !near(r, glm::length(out.v)) || !square(out.u, out.v)) return std::nullopt;
  const TrueSurface s = surfaceAt(scene, object, 0, 0.5f, 0.5f);
  out.normal = normalizeOr(s.normal, vec3(0));
  if (!isSphere) return out;
  const bool even = near(r, glm::length(w)) && square(out.u, w) && square(out.v, w);
  return even && dot(s.normal, s.P - out.center) > 0 ? std::optional(out) : std::nullopt;
}

std::optional<EmitterShape> rectangle(const EmitterLattice& lattice) {
  if (lattice.surface || lattice.quads.size() != 1) return std::nullopt;
  const auto& [a, b, c, d] = lattice.quads[0];
  const EmitterShape out{
      EmitterShape::Kind::Rectangle, 0.5f * (a + c), 0.5f * (b - a), 0.5f * (d - a), lattice.normals[0], lattice.group};
  const float u = glm::length(out.u), v = glm::length(out.v);
  const bool straight = glm::length(a + c - b - d) <= 1e-5f * (u + v) && std::abs(dot(out.u, out.v)) <= 1e-5f * u * v;
  return u > 0 && v > 0 && straight ? std::optional(out) : std::nullopt;
}

void addEmitters(const Scene& scene, const CoarseGroup& group, int number, EmitterLight& out) {
  int round = -1;  // the last object that was round
  for (const Lattice& lattice : group.lattices) {
    if (lattice.object == round) continue;
    if (const auto shape = roundShape(scene, lattice.object)) {
      out.shapes.push_back(*shape);
      out.shapes.back().group = number;
      round = lattice.object;
      continue;
    }
    EmitterLattice quads = latticeOf(scene, group, lattice);
    quads.group = number;
    if (const auto shape = rectangle(quads))
      out.shapes.push_back(*shape);
    else
      out.lattices.push_back(std::move(quads));
  }
}

EmitterTable tableOf(const Scene& scene, const std::vector<CoarseGroup>& groups) {
  EmitterTable table(scene.lights.size());
  for (size_t g = 0; g < groups.size(); ++g) {
    const int light = scene.groups[g].attributes->areaLight;
    if (light < 0 || light >= static_cast<int>(table.size())) continue;
    EmitterLight& out = table[static_cast<size_t>(light)];
    out.reach = std::max(out.reach, kOffsetFactor * groups[g].deviation);
    addEmitters(scene, groups[g], static_cast<int>(g), out);
  }
  return table;
}

void put(const EmitterPoints& out, int i, const vec3& P, const vec3& N, double pdf, double meetPdf) {
  set(out.P, i, P);
  set(out.N, i, N);
  out.pdf[i] = static_cast<float>(pdf);
  if (out.meetPdf) out.meetPdf[i] = static_cast<float>(meetPdf);
}

/// Converts a density over area to one over solid angle, whichever side is seen.
double eitherSidePdf(const vec3& from, const vec3& P, const vec3& N, double areaPdf) {
  return solidAnglePdf(from, P, dot(N, P - from) > 0 ? -N : N, areaPdf);
}

vec3 at(TmConstVec3 v, int i) { return {v.x[i], v.y[i], v.z[i]}; }

}  // namespace

Emitters::Emitters(const Scene& scene, const std::vector<CoarseGroup>& groups) : Emitters(tableOf(scene, groups)) {
  scene_ = &scene;
}

Emitters::Emitters(EmitterTable table) : table_(std::move(table)), lights_(table_.size()) {
  for (size_t light = 0; light < table_.size(); ++light) {
    for (const EmitterShape& shape : table_[light].shapes) lights_[light].areas.add(double{shape.area()});
    for (uint32_t l = 0; l < table_[light].lattices.size(); ++l) {
      const EmitterLattice& lattice = table_[light].lattices[l];
      Source source{l, {}, std::vector<Distribution>(lattice.rows)};
      for (uint32_t j = 0; j < lattice.rows; ++j) {
        for (uint32_t i = 0; i < lattice.columns; ++i)
          source.row[j].add(double{areaOf(lattice.quads[j * lattice.columns + i])});
        source.rows.add(source.row[j].total());
      }
      if (!(source.rows.total() > 0)) continue;
      lights_[light].areas.add(source.rows.total());
      lights_[light].sources.push_back(std::move(source));
    }
    findFacets(table_[light], lights_[light]);
  }
}

void Emitters::findFacets(const EmitterLight& given, Light& light) {
  for (Source& source : light.sources) {
    const EmitterLattice& lattice = given.lattices[source.lattice];
    const size_t before = light.facets.size();
    for (size_t k = 0; !lattice.surface && k < lattice.quads.size(); ++k)
      if (const auto facet = facetOf(lattice.quads[k], lattice.normals[k])) light.facets.push_back(*facet);
    source.met = light.facets.size() == before + lattice.quads.size();
    if (!source.met) light.facets.resize(before);
  }
  if (light.facets.size() <= kMostFacets) return;
  light.facets.clear();
  for (Source& source : light.sources) source.met = false;
}

void Emitters::place(const EmitterLattice& from, size_t k, float u, float v, vec3& P, vec3& normal) const {
  if (!from.curved) return bilinear(from.quads[k], u, v, P, normal);
  const CoarseGroup& g = *from.surface;
  const auto quad = from.firstQuad + static_cast<uint32_t>(k);
  const Lattice& lattice = g.latticeOf(quad);
  const vec2 uv = g.patchParameters(quad, u, v);
  const TrueSurface s = surfaceAt(*scene_, lattice.object, lattice.patch, uv.x, uv.y);
  P = s.P;
  const vec2 size((lattice.rect.u1 - lattice.rect.u0) / static_cast<float>(lattice.nu),
                  (lattice.rect.v1 - lattice.rect.v0) / static_cast<float>(lattice.nv));
  const float area = glm::length(cross(s.dPdu, s.dPdv)) * size.x * size.y;
  normal = area * normalizeOr(g.flipsNormal ? -s.normal : s.normal, vec3(0));
  if (normal == vec3(0)) bilinear(from.quads[k], u, v, P, normal);
}

float Emitters::reach(int light) const { return known(light) ? given(light).reach : 0.0f; }

float Emitters::area(int light) const { return known(light) ? static_cast<float>(sources(light).areas.total()) : 0.0f; }

Bound3 Emitters::bound(int light) const {
  Bound3 out;
  if (!known(light)) return out;
  for (const EmitterShape& s : given(light).shapes) {
    const vec3 half = s.kind == EmitterShape::Kind::Sphere ? vec3(glm::length(s.u)) : glm::abs(s.u) + glm::abs(s.v);
    out.extend(s.center - half);
    out.extend(s.center + half);
  }
  for (const EmitterLattice& lattice : given(light).lattices)
    for (const auto& quad : lattice.quads)
      for (const vec3& corner : quad) out.extend(corner);
  return out;
}

Emitters::AreaPoint Emitters::onLattice(const EmitterLight& light, const Source& source, double u, double v) const {
  const EmitterLattice& lattice = light.lattices[source.lattice];
  const size_t row = source.rows.pick(v), column = source.row[row].pick(u);
  const size_t quad = row * lattice.columns + column;
  AreaPoint out;
  out.group = lattice.group;
  vec3 normal;
  place(lattice, quad, static_cast<float>(u), static_cast<float>(v), out.P, normal);
  const double quadArea = source.row[row].weight(column);
  const bool there = !lattice.surface || lattice.surface->keeps(lattice.firstQuad + static_cast<uint32_t>(quad),
                                                                static_cast<float>(u), static_cast<float>(v));
  if (quadArea > 0 && there) out.area = double{glm::length(normal)} * source.rows.total() / quadArea;
  out.N = normalizeOr(lattice.flipsNormal ? -normal : normal, lattice.normals[quad]);
  return out;
}

bool Emitters::sampleFrom(int light, int count, TmConstVec3 from, const float* xi0, const float* xi1,
                          const EmitterPoints& out) const {
  if (!shines(light)) return false;
  const EmitterLight& emitters = given(light);
  const Light& l = sources(light);
  for (int i = 0; i < count; ++i) {
    double u{xi0[i]};
    const size_t pick = l.areas.pick(u);
    const double share = l.areas.weight(pick) / l.areas.total();
    const vec3 eye = at(from, i);
    if (pick < emitters.shapes.size()) {
      const SeenPoint p = sampleSolidAngle(emitters.shapes[pick], eye, {static_cast<float>(u), xi1[i]});
      put(out, i, p.P, p.N, share * double{p.pdf}, share * double{p.pdf});
      continue;
    }
    const Source& source = l.sources[pick - emitters.shapes.size()];
    const AreaPoint p = onLattice(emitters, source, u, double{xi1[i]});
    const double pdf = p.area > 0 ? share * solidAnglePdf(eye, p.P, p.N, 1 / p.area) : 0;
    put(out, i, p.P, p.N, pdf, pdf > 0 && source.met ? l.facetPdf(eye, p.P, p.N) : 0);
  }
  return true;
}

void Emitters::meet(int light, int count, TmConstVec3 from, TmConstVec3 direction, const EmitterPoints& out) const {
  for (int i = 0; i < count; ++i) {
    const vec3 eye = at(from, i);
    float nearest = kInfinity;
    put(out, i, eye, vec3(0), 0, 0);
    for (size_t s = 0; known(light) && s < given(light).shapes.size(); ++s) {
      const SeenPoint p = tomales::meet(given(light).shapes[s], eye, at(direction, i));
      const float distance = p.pdf > 0 ? glm::length(p.P - eye) : kInfinity;
      if (!(distance < nearest)) continue;
      nearest = distance;
      const double pdf = sources(light).areas.weight(s) / sources(light).areas.total() * double{p.pdf};
      put(out, i, p.P, p.N, pdf, pdf);
    }
    if (!known(light)) continue;
    for (const EmitterFacet& facet : sources(light).facets) {
      const float distance = distanceTo(facet, eye, at(direction, i));
      if (!(distance < nearest)) continue;
      nearest = distance;
      const vec3 P = eye + distance * at(direction, i);
      const double pdf = sources(light).facetPdf(eye, P, facet.normal);
      put(out, i, P, facet.normal, pdf, pdf);
    }
  }
}

bool Emitters::sample(int light, int count, const float* xi0, const float* xi1, TmVec3 P, TmVec3 N, float* area,
                      int* group, uint8_t* met) const {
  if (!shines(light)) return false;
  const EmitterLight& emitters = given(light);
  const Light& l = sources(light);
  for (int i = 0; i < count; ++i) {
    double u{xi0[i]};
    const size_t pick = l.areas.pick(u);
    AreaPoint p;
    if (met) met[i] = pick < emitters.shapes.size() || l.sources[pick - emitters.shapes.size()].met;
    if (pick < emitters.shapes.size()) {
      const SeenPoint onShape = sampleArea(emitters.shapes[pick], {static_cast<float>(u), xi1[i]});
      p = {onShape.P, onShape.N, 1 / double{onShape.pdf}, emitters.shapes[pick].group};
    } else {
      p = onLattice(emitters, l.sources[pick - emitters.shapes.size()], u, double{xi1[i]});
    }
    area[i] = static_cast<float>(p.area * l.areas.total() / l.areas.weight(pick));
    if (group) group[i] = p.group;
    set(P, i, p.P);
    set(N, i, p.N);
  }
  return true;
}

bool Emitters::sampleWhole(int light, int count, TmConstVec3 from, const float* xi0, const float* xi1,
                           const EmitterPoints& out) const {
  std::vector<uint8_t> met(static_cast<size_t>(count));
  if (!sample(light, count, xi0, xi1, out.P, out.N, out.pdf, nullptr, met.data())) return false;
  for (int i = 0; i < count; ++i) {
    const double pdf = met[static_cast<size_t>(i)]
                           ? eitherSidePdf(at(from, i), get(out.P, i), get(out.N, i), 1 / double{area(light)})
                           : 0;
    out.meetPdf[i] = static_cast<float>(pdf);
    out.pdf[i] = out.pdf[i] > 0 ? area(light) / (kPi * out.pdf[i]) : 0.0f;
  }
  return true;
}

void Emitters::meetWhole(int light, int layer, int count, TmConstVec3 from, TmConstVec3 direction,
                         const EmitterPoints& out) const {
  std::vector<SeenPoint> found;
  for (int i = 0; i < count; ++i) {
    const vec3 eye = at(from, i), d = at(direction, i);
    put(out, i, eye, vec3(0), 0, 0);
    found.clear();
    for (size_t s = 0; known(light) && s < given(light).shapes.size(); ++s)
      crossings(given(light).shapes[s], eye, d, found);
    for (size_t f = 0; known(light) && f < sources(light).facets.size(); ++f) {
      const EmitterFacet& facet = sources(light).facets[f];
      const float distance = distanceToAnySide(facet, eye, d);
      if (distance < kInfinity) found.push_back({eye + distance * d, facet.normal, 0});
    }
    if (found.size() <= static_cast<size_t>(layer)) continue;
    const auto chosen = found.begin() + layer;
    std::nth_element(found.begin(), chosen, found.end(),
                     [&](const SeenPoint& a, const SeenPoint& b) { return dot(a.P - eye, d) < dot(b.P - eye, d); });
    const double pdf = eitherSidePdf(eye, chosen->P, chosen->N, 1 / double{area(light)});
    put(out, i, chosen->P, chosen->N, pdf, pdf);
  }
}

}  // namespace tomales
