// Pictures that multiply parameters of a surface, and normal maps. They are looked up at s, t, or at second
// coordinates.
#pragma once
#include <optional>
#include <string_view>

#include "reyes/shader.h"
#include "reyes/shader/shadeops.h"

/// Other texture coordinates, and which pictures are looked up there.
struct SecondSet {
  /// A primitive variable, or nothing.
  struct Coordinate : rsl::FloatParam {
    using FloatParam::FloatParam;
    const float* values(const TmGrid* g) const { return value(g).step == 1 ? value(g).c[0] : nullptr; }
  };
  Coordinate s{"s1", 0, "second texture coordinate across"}, t{"t1", 0, "second texture coordinate down"};
  rsl::StringParam maps{"secondset", "", "which pictures, as in \"normalmap roughnessmap\", are looked up at s1, t1"};
};

/// The texture coordinates of a batch.
class Coordinates {
 public:
  struct Pair {
    const float *s, *t;
  };

  Coordinates(const rsl::Batch& b, const SecondSet& of)
      : first_{b.g->s, b.g->t}, second_{of.s.values(b.g), of.t.values(b.g)}, maps_(of.maps(b.g)) {
    if (!second_.s || !second_.t) second_ = first_;
  }
  /// Returns the coordinates that the picture of the parameter `map` is looked up at.
  Pair of(std::string_view map) const {
    for (size_t at = maps_.find(map); at != maps_.npos; at = maps_.find(map, at + 1))
      if ((at == 0 || maps_[at - 1] == ' ') && (at + map.size() == maps_.size() || maps_[at + map.size()] == ' '))
        return second_;
    return first_;
  }

 private:
  const Pair first_;
  Pair second_;
  const std::string_view maps_;
};

/// A number that one channel of a picture multiplies.
struct MappedFloat {
  rsl::FloatParam value;
  const char* const mapName;
  rsl::StringParam map;
  rsl::UniformFloatParam channel;

  MappedFloat(const char* name, float fallback, const char* doc, const char* nameOfMap, const char* channelName)
      : value(name, fallback, doc),
        mapName(nameOfMap),
        map(nameOfMap, "", "picture that multiplies it"),
        channel(channelName, 0, "the channel of that picture, 0 the first") {}
  /// Tells whether the object has the same value everywhere, and at least this one.
  bool isEvenlyAbove(float least, const TmGrid* g) const {
    return value.isUniform(g) && *map(g) == 0 && value(g, 0) >= least;
  }
};

/// Its values at the points of a batch.
class MappedValues {
 public:
  MappedValues(const rsl::Batch& b, const Coordinates& coordinates, const MappedFloat& of) : g_(b.g), of_(of) {
    if (*of.map(g_) == 0) return;
    TmTextureOptions options = tmTextureDefaults();
    options.channel = static_cast<int>(rsl::clamp(of.channel(g_), 0, 63));
    const auto [s, t] = coordinates.of(of.mapName);
    picture_.emplace(g_);
    g_->call->texture(g_->host, g_, of.map(g_), &options, s, t, {picture_->data(), nullptr, nullptr});
  }
  float operator[](int i) const { return picture_ ? of_.value(g_, i) * (*picture_)[i] : of_.value(g_, i); }

 private:
  const TmGrid* const g_;
  const MappedFloat& of_;
  std::optional<rsl::Array> picture_;
};

/// Returns a colour of sRGB in linear light (IEC 61966-2-1).
inline rsl::Color linearOfSrgb(rsl::Color c) {
  const auto linear = [](float x) { return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f); };
  return {linear(c.x), linear(c.y), linear(c.z)};
}

/// The colours of a picture at the points of a batch; white where there is none. The renderer multiplies colours by the
/// picture's alpha as it reads them. For sRGB that is divided out again before the colours are made linear, because
/// such pictures keep colours and alpha apart.
class ColorPicture {
 public:
  ColorPicture(const rsl::Batch& b, Coordinates::Pair at, const char* map, bool isSrgb) {
    if (*map == 0) return;
    picture_.emplace(b.g);
    TmTextureOptions options = tmTextureDefaults();
    if (!b.g->call->texture(b.g->host, b.g, map, &options, at.s, at.t, *picture_) || !isSrgb) return;
    options.channel = 3;
    options.fill = 1;
    rsl::Array alpha(b.g);
    b.g->call->texture(b.g->host, b.g, map, &options, at.s, at.t, {alpha.data(), nullptr, nullptr});
    for (int i : b) picture_->set(i, linearOfSrgb((*picture_)[i] / std::max(alpha[i], 1e-3f)));
  }
  rsl::Color operator[](int i) const { return picture_ ? (*picture_)[i] : rsl::Color{1, 1, 1}; }

 private:
  std::optional<rsl::Vec3Array> picture_;
};

/// Normals in tangent space: red along s, green against t (up the picture), blue along the normal; 0.5 is 0.
struct NormalMap {
  rsl::StringParam map{"normalmap", "", "picture of normals in tangent space, its green upwards"};
  rsl::FloatParam scale{"normalscale", 1, "how far they turn; negative: against what the picture says"};

  /// Returns normals of unit length, towards the viewer, as rsl::Batch::facingNormals() gives them.
  rsl::Vec3Array facingNormals(const rsl::Batch& b, Coordinates::Pair at) const {
    rsl::Vec3Array N = b.facingNormals(), texel(b.g);
    const TmTextureOptions options = tmTextureDefaults();
    if (*map(b.g) == 0 || !b.g->call->texture(b.g->host, b.g, map(b.g), &options, at.s, at.t, texel)) return N;
    rsl::Array su(b.g), sv(b.g), tu(b.g), tv(b.g);
    const auto derive = [&](const float* value, int direction, rsl::Array& out) {
      b.g->call->derivative(b.g->host, b.g, direction, value, out.data());
    };
    derive(at.s, 0, su);
    derive(at.s, 1, sv);
    derive(at.t, 0, tu);
    derive(at.t, 1, tv);
    for (int i : b) {
      const rsl::Vec3 outward = rsl::normalize(b.N(i)), dPdu = rsl::get(b.g->dPdu, i), dPdv = rsl::get(b.g->dPdv, i);
      // P and (s, t) are functions of (u, v): dP/ds and dP/dt by the inverse of d(s, t)/d(u, v), but for its size.
      const float turn = su[i] * tv[i] - sv[i] * tu[i] < 0 ? -1.0f : 1.0f;
      const rsl::Vec3 alongS = turn * (tv[i] * dPdu - tu[i] * dPdv), alongT = turn * (su[i] * dPdv - sv[i] * dPdu);
      const rsl::Vec3 flat = alongS - rsl::dot(alongS, outward) * outward;
      if (!(rsl::dot(flat, flat) > 0)) continue;
      const rsl::Vec3 tangent = rsl::normalize(flat), side = rsl::cross(outward, tangent),
                      up = rsl::dot(side, alongT) > 0 ? -1.0f * side : side;
      const rsl::Vec3 n = 2.0f * texel[i] - rsl::Vec3{1, 1, 1};
      const float k = scale(b.g, i);
      const rsl::Vec3 turned = (k * n.x) * tangent + (k * n.y) * up + std::max(n.z, 1e-3f) * outward;
      N.set(i, rsl::normalize(rsl::dot(N[i], outward) < 0 ? -1.0f * turned : turned));
    }
    return N;
  }
};
