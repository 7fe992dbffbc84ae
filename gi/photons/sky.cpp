#include "gi/photons/sky.h"

#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr int kCorners = SkyCells::kRows + 1;  ///< Rows of corners from pole to pole.
/// Share of photons that fall anywhere, so that light which no corner of a cell has seen is not lost.
constexpr float kEven = 1.0f / 64;
constexpr float kThroughPortals = 0.75f;  ///< Share of photons through portals, where there are portals.
constexpr uint32_t kRays = 256;           ///< Number of rays that find on which side of a portal the sky is.
/// Least share of the sky that counts as free on a side of a portal: glass may have been in the way of all those rays.
constexpr float kLeastFree = 1.0f / 32;

vec3 direction(double cosTheta, double phi) {
  const double r = std::sqrt(std::max(0.0, 1 - cosTheta * cosTheta));
  return {r * std::cos(phi), r * std::sin(phi), cosTheta};
}
double cosineAt(double row) { return std::cos(double{kPi} / SkyCells::kRows * row); }
double phiAt(double column) { return 2 * double{kPi} / SkyCells::kColumns * column; }
double solidAngle(size_t row) {
  return 2 * double{kPi} / SkyCells::kColumns *
         (cosineAt(static_cast<double>(row)) - cosineAt(static_cast<double>(row) + 1));
}

/// Evaluates the light; the sky shines from anywhere along the direction N that is asked for.
void ask(int light, const ShadingSystem& shading, LightProbe& probe) {
  probe.P.assign(probe.N.size(), vec3(0));
  probe.Pl = probe.Nl = probe.N;
  shading.probe(light, probe);
}

/// Returns the light's radiance at the corners of all cells, row by row.
std::vector<float> survey(int light, const ShadingSystem& shading) {
  std::vector<float> radiance;
  for (int row = 0; row < kCorners; ++row) {
    LightProbe probe;
    for (int column = 0; column < SkyCells::kColumns; ++column)
      probe.N.push_back(direction(cosineAt(row), phiAt(column)));
    ask(light, shading, probe);
    for (const vec3& L : probe.Cl) radiance.push_back(luminance(L));
  }
  return radiance;
}

/// Returns the share of the sky on the side of `normal` of a portal that nothing hides.
float freeSky(const RayScene& rays, const Portal& portal, const vec3& normal) {
  const vec3 axis = normalizeOr(normal, normal);
  vec3 tangent, bitangent;
  orthonormalBasis(axis, tangent, bitangent);
  float free = 0;
  for (uint32_t i = 0; i < kRays; ++i) {
    const vec2 at = sobol2(i, randomStream("port"));
    const vec3 local = cosineHemisphere(sobol2(i, randomStream("aspe")));
    const Ray ray{portal.corner + at.x * portal.u + at.y * portal.v,
                  local.x * tangent + local.y * bitangent + local.z * axis};
    free += rays.closest(ray, kMaskPhoton).object < 0 ? 1.0f / kRays : 0.0f;
  }
  return std::max(free, kLeastFree);
}

}  // namespace

template <class Share>
SkyCells::SkyCells(const std::vector<float>& radiance, const Share& share) {
  std::vector<double> weights;
  for (size_t row = 0; row < kRows; ++row)
    for (size_t column = 0; column < kColumns; ++column) {
      const size_t next = (column + 1) % kColumns;
      const double mean =
          0.25 * (double{radiance[row * kColumns + column]} + double{radiance[row * kColumns + next]} +
                  double{radiance[(row + 1) * kColumns + column]} + double{radiance[(row + 1) * kColumns + next]});
      const vec3 middle = direction(cosineAt(static_cast<double>(row) + 0.5), phiAt(static_cast<double>(column) + 0.5));
      weights.push_back(mean * double{share(middle)} * solidAngle(row));
      integral_ += weights.back();
    }
  for (size_t row = 0; row < kRows; ++row) {
    Distribution& cells = row_.emplace_back();
    const double even = double{kEven} * integral_ * solidAngle(row) / (4 * double{kPi});
    for (size_t column = 0; column < kColumns; ++column) cells.add(weights[row * kColumns + column] + even);
    rows_.add(cells.total());
  }
}

vec3 SkyCells::sample(vec2 xi, Cell& cell) const {
  double x{xi.x}, y{xi.y};
  cell.row = rows_.pick(y);
  cell.column = row_[cell.row].pick(x);
  const double top = cosineAt(static_cast<double>(cell.row)), bottom = cosineAt(static_cast<double>(cell.row) + 1);
  return direction(top + y * (bottom - top), phiAt(static_cast<double>(cell.column) + x));
}

float SkyCells::pdf(const Cell& cell) const {
  return static_cast<float>(row_[cell.row].weight(cell.column) / (rows_.total() * solidAngle(cell.row)));
}

SkyPhotons::SkyPhotons(int light, const ShadingSystem& shading, const RayScene& rays, const PhotonTarget& target)
    : LightPhotons(light, shading, target) {
  for (const Portal& p : shading.light(light).portals())
    portals_.push_back({p, {freeSky(rays, p, p.normal), freeSky(rays, p, -p.normal)}});
  const std::vector<float> radiance = survey(light, shading);
  open_ = SkyCells(radiance, [](const vec3&) { return 1.0f; });
  power_ = open_.integral() * double{kPi * radius_ * radius_};
  if (portals_.empty()) return;
  through_ = SkyCells(radiance, [&](const vec3& toSky) { return across(toSky); });
  if (!(through_.integral() > 0)) return;
  share_ = kThroughPortals;
  // Light that falls on the outside of the house does not count for the power, so few photons are spent on it.
  power_ = through_.integral() / double{share_};
}

float SkyPhotons::across(const vec3& toSky) const {
  float sum = 0;
  for (const Opening& p : portals_) sum += p.across(toSky);
  return sum;
}

/// Returns a point on the portals, evenly over their area seen from the direction.
vec3 SkyPhotons::onPortal(const vec3& toSky, vec2 xi) const {
  double x{xi.x};
  Distribution parts;
  for (const Opening& p : portals_) parts.add(double{p.across(toSky)});
  const Opening& p = portals_[parts.pick(x)];
  return p.corner + static_cast<float>(x) * p.u + xi.y * p.v;
}

/// Returns the density of onPortal() over area across the direction, summed over all portals on the line through P.
float SkyPhotons::portalPdf(const vec3& P, const vec3& toSky) const {
  float met = 0, sum = 0;
  for (const Opening& p : portals_) {
    const float along = dot(p.normal, toSky), part = p.across(toSky);
    sum += part;
    if (!(part > 0)) continue;
    const vec3 place = P + dot(p.normal, p.corner - P) / along * toSky - p.corner;
    const float square = dot(p.normal, p.normal);
    const float a = dot(cross(place, p.v), p.normal) / square, b = dot(cross(p.u, place), p.normal) / square;
    if (a >= 0 && a <= 1 && b >= 0 && b <= 1) met += p.free[along < 0];
  }
  return sum > 0 ? met / sum : 0.0f;
}

vec3 SkyPhotons::onDisk(const vec3& toSky, const vec2& xi) const {
  vec3 tangent, bitangent;
  orthonormalBasis(toSky, tangent, bitangent);
  const float r = radius_ * std::sqrt(xi.x), phi = 2 * kPi * xi.y;
  return center_ + r * std::cos(phi) * tangent + r * std::sin(phi) * bitangent;
}

/// Photons start on a disk before the scene or on a portal. Both kinds are weighted by the balance heuristic (Veach
/// 1997), over direction and the area across it.
void SkyPhotons::emitBy(const StartNumbers& xi, std::vector<EmittedPhoton>& out) const {
  const auto& [a, b] = xi;
  LightProbe probe;
  std::vector<float> pdf;
  for (size_t i = 0; i < out.size(); ++i) {
    const bool through = a[i].x < share_;
    const vec2 place(through ? a[i].x / share_ : (a[i].x - share_) / (1 - share_), a[i].y);
    SkyCells::Cell cell;
    const vec3 toSky = (through ? through_ : open_).sample(place, cell);
    const vec3 P = through ? onPortal(toSky, b[i]) : onDisk(toSky, b[i]);
    const float open = (1 - share_) * open_.pdf(cell) / (kPi * radius_ * radius_);
    pdf.push_back(share_ > 0 ? share_ * through_.pdf(cell) * portalPdf(P, toSky) + open : open);
    out[i].ray = {P + (dot(center_ - P, toSky) + kOutside * radius_) * toSky, -toSky};
    probe.N.push_back(toSky);
  }
  ask(light_, shading_, probe);
  for (size_t i = 0; i < out.size(); ++i) out[i].power = probe.Cl[i] / pdf[i];
}

}  // namespace tomales
