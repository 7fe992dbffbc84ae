#include "reyes/shade/sky.h"

#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr float kPictureShare = 0.5f;
constexpr float kLeastCosine = 1e-3f;  ///< Limits what one sample brings.

float center(int i, int count) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(count); }
/// Returns the solid angle of a unit of (s, t).
float solidAngleAt(float t) { return 2 * kPi * kPi * std::sin(kPi * t); }

bool inAir(const vec3& N) { return N == vec3(0.0f); }

float cosinePdf(const vec3& N, const vec3& L) {
  if (inAir(N)) return 1 / (4 * kPi);
  return dot(N, L) > 0 ? std::max(dot(N, L), kLeastCosine) / kPi : 0.0f;
}

vec3 cosineDirection(const vec3& N, const vec2& xi) {
  if (inAir(N)) return latLongDirection({xi.y, std::acos(1 - 2 * xi.x) / kPi});
  vec3 tangent, bitangent;
  orthonormalBasis(N, tangent, bitangent);
  const vec3 local = cosineHemisphere(xi);
  return normalizeOr(local.x * tangent + local.y * bitangent + std::max(local.z, kLeastCosine) * N, N);
}

}  // namespace

vec2 latLong(const vec3& d) {
  const float longitude = std::atan2(d.y, d.x) / (2 * kPi);
  return {longitude < 0 ? longitude + 1 : longitude, std::atan2(std::sqrt(d.x * d.x + d.y * d.y), d.z) / kPi};
}

vec3 latLongDirection(const vec2& st) {
  const float phi = 2 * kPi * st.x, theta = kPi * st.y;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

Sky::Sky(const Textures& textures, const std::string& picture, const SourceLoc& where, const std::string& user,
         const mat3& worldFromCurrent)
    : worldFromCurrent_(worldFromCurrent) {
  // Twice as wide as a cell, since a direction in the cell sees its neighbours too.
  const AlignedVector<float> width(kSkyColumns, 2.0f / kSkyColumns), height(kSkyColumns, 2.0f / kSkyRows);
  AlignedVector<float> s(kSkyColumns), t(kSkyColumns), rgb[3];
  for (auto& c : rgb) c.resize(kSkyColumns);
  const AlignedVector<uint8_t> active(kSkyColumns, uint8_t{1});
  for (int i = 0; i < kSkyColumns; ++i) s[static_cast<size_t>(i)] = center(i, kSkyColumns);
  bool read = true;
  for (int j = 0; j < kSkyRows && read; ++j) {
    std::fill(t.begin(), t.end(), center(j, kSkyRows));
    TextureQuery query{picture.c_str()};
    query.count = kSkyColumns;
    query.active = active.data();
    query.s = s.data();
    query.t = t.data();
    query.su = width.data();
    query.tv = height.data();
    query.latlong = true;
    read = textures.lookup(query, where, user, {rgb[0].data(), rgb[1].data(), rgb[2].data()});
    Distribution& row = row_.emplace_back();
    for (size_t i = 0; i < kSkyColumns; ++i) {
      const float light = luminance({rgb[0][i], rgb[1][i], rgb[2][i]}) * solidAngleAt(center(j, kSkyRows));
      row.add(light > 0 && std::isfinite(light) ? double{light} : 0.0);
    }
    rows_.add(row.total());
  }
  if (!read || !(rows_.total() > 0)) row_.clear();
}

vec3 Sky::sample(const vec3& P, const vec3& N, vec2 xi, float& pdf) const {
  const float share = portals_.share(P, N);
  const vec3 L =
      xi.x < share ? portals_.sample(P, N, {xi.x / share, xi.y}) : openSample(N, {(xi.x - share) / (1 - share), xi.y});
  pdf = this->pdf(P, N, L);
  return L;
}

float Sky::pdf(const vec3& P, const vec3& N, const vec3& L) const {
  const float share = portals_.share(P, N), open = (1 - share) * openPdf(N, L);
  return share > 0 ? share * portals_.pdf(P, N, L) + open : open;
}

vec3 Sky::openSample(const vec3& N, vec2 xi) const {
  const float share = row_.empty() ? 0 : kPictureShare;
  if (xi.x >= share) return cosineDirection(N, {(xi.x - share) / (1 - share), xi.y});
  double s{xi.x / share}, t{xi.y};
  const size_t j = rows_.pick(t), i = row_[j].pick(s);
  const vec3 L = latLongDirection({(static_cast<float>(i) + static_cast<float>(s)) / kSkyColumns,
                                   (static_cast<float>(j) + static_cast<float>(t)) / kSkyRows});
  return normalizeOr(glm::transpose(worldFromCurrent_) * L, vec3(0.0f, 0.0f, 1.0f));
}

float Sky::openPdf(const vec3& N, const vec3& L) const {
  const float byCosine = cosinePdf(N, L);
  return row_.empty() ? byCosine : kPictureShare * picturePdf(L) + (1 - kPictureShare) * byCosine;
}

float Sky::picturePdf(const vec3& L) const {
  const vec2 st = latLong(worldFromCurrent_ * L);
  const auto cell = [](float x, int count) {
    return static_cast<size_t>(std::clamp(static_cast<int>(x * static_cast<float>(count)), 0, count - 1));
  };
  const double share = row_[cell(st.y, kSkyRows)].weight(cell(st.x, kSkyColumns)) / rows_.total();
  return static_cast<float>(share * kSkyRows * kSkyColumns / std::max(double{solidAngleAt(st.y)}, 1e-9));
}

mat3 skyFromCurrent(const mat4& currentFromSpace) {
  mat3 axes(currentFromSpace);
  for (int k = 0; k < 3; ++k) axes[k] = normalizeOr(axes[k], axes[k]);
  return glm::transpose(axes);
}

const Sky& Skies::find(const std::string& picture, const SourceLoc& where, const std::string& user) const {
  const std::lock_guard lock(mutex_);
  const auto it = skies_.find(picture);
  return it != skies_.end()
             ? it->second
             : skies_.try_emplace(picture, textures_, picture, where, user, worldFromCurrent_).first->second;
}

}  // namespace tomales
