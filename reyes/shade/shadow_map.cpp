#include "reyes/shade/shadow_map.h"

#include <fmt/format.h>
#include <filesystem>

#include <algorithm>

#include "reyes/base/file_guesses.h"
#include "reyes/base/missing_file.h"
#include "reyes/base/rng.h"
#include "reyes/base/search_path.h"
#include "reyes/pictures.h"

namespace tomales {
namespace {

int channelOf(const PictureShape& shape, const char* name) {
  const auto it = std::find(shape.channels.begin(), shape.channels.end(), name);
  return it == shape.channels.end() ? -1 : static_cast<int>(it - shape.channels.begin());
}

vec2 project(const mat4& ndcFromWorld, const vec3& p) {
  const vec4 h = ndcFromWorld * vec4(p, 1);
  return vec2(h) / h.w;
}

/// Returns the edges u and v, each reversed if needed, so that they widen a square instead of narrowing it.
std::pair<vec2, vec2> widening(const vec2& square, const vec2& u, const vec2& v) {
  const auto area = [&](const vec2& a, const vec2& b) { return (square.x + a.x) * (square.y + b.y) - a.y * b.x; };
  std::pair<vec2, vec2> best{u, v};
  for (const auto& [a, b] : {std::pair(u, -v), std::pair(-u, v), std::pair(-u, -v)})
    if (area(a, b) > area(best.first, best.second)) best = {a, b};
  return best;
}

}  // namespace

std::unique_ptr<const ShadowMap> ShadowMap::read(const std::string& path, std::string& error) {
  const auto in = openPicture(path, error);
  if (!in) return nullptr;
  const std::optional<DepthCamera> camera = depthCameraOf(*in);
  if (!camera) {
    error = "it is no shadow map: depth or the matrices of its camera are missing";
    return nullptr;
  }
  auto map = std::make_unique<ShadowMap>();
  map->readCamera(in->shape(), *camera);
  const bool good = in->deep() ? map->readDeep(*in, camera->depth) : map->readFlat(*in, camera->depth);
  if (good) return map;
  error = in->error();
  return nullptr;
}

void ShadowMap::readCamera(const PictureShape& shape, const DepthCamera& camera) {
  cameraFromWorld_ = camera.cameraFromWorld;
  ndcFromWorld_ = camera.ndcFromWorld;
  cameraNormalFromWorld_ = glm::transpose(glm::inverse(mat3(cameraFromWorld_)));
  width_ = shape.fullWidth;
  height_ = shape.fullHeight;
  x0_ = shape.x;
  y0_ = shape.y;
  columns_ = shape.width;
  rows_ = shape.height;
  const mat4 ndcFromCamera = ndcFromWorld_ * glm::inverse(cameraFromWorld_);
  perspective_ = std::abs(ndcFromCamera[2][3]) > 1e-6f * std::abs(ndcFromCamera[3][3]);
}

bool ShadowMap::readFlat(PictureReader& in, int z) {
  depth_.resize(static_cast<size_t>(columns_) * static_cast<size_t>(rows_));
  return in.read(z, z + 1, depth_.data());
}

bool ShadowMap::readDeep(PictureReader& in, int z) {
  in.pair(kSampleRegion, &spread_.x);
  std::vector<uint32_t> counts;
  std::vector<float> values;
  if (!in.readDeep(counts, values)) return false;
  const PictureShape& shape = in.shape();
  const auto channel = [&](const char* name) { return channelOf(shape, name); };
  const int back = channel("ZBack") < 0 ? z : channel("ZBack"), alpha = channel("A");
  const int opacity[3] = {channel("AR"), channel("AG"), channel("AB")};
  first_.push_back(0);
  const float* channels = values.data();
  for (const uint32_t count : counts) {
    vec3 clear(1.0f);
    for (uint32_t s = 0; s < count; ++s, channels += shape.channels.size()) {
      DeepSample sample{channels[z], channels[back], clear, clear};
      for (int k = 0; k < 3; ++k) {
        const int c = opacity[k] < 0 ? alpha : opacity[k];
        if (c >= 0) sample.after[k] *= 1 - channels[c];
      }
      clear = sample.after;
      samples_.push_back(sample);
    }
    first_.push_back(samples_.size());
  }
  return true;
}

vec3 ShadowMap::blocked(int x, int y, float z) const {
  const int column = x - x0_, row = y - y0_;
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return vec3(0.0f);
  const size_t texel = static_cast<size_t>(row) * static_cast<size_t>(columns_) + static_cast<size_t>(column);
  if (!depth_.empty()) return vec3(depth_[texel] < z ? 1.0f : 0.0f);
  const DeepSample *begin = samples_.data() + first_[texel], *end = samples_.data() + first_[texel + 1];
  const DeepSample* beyond = std::upper_bound(begin, end, z, [](float at, const DeepSample& s) { return at < s.z; });
  if (beyond == begin) return vec3(0.0f);
  const DeepSample& s = beyond[-1];
  const float t = z >= s.zBack ? 1.0f : (z - s.z) / (s.zBack - s.z);
  return vec3(1.0f) - glm::mix(s.before, s.after, t);
}

/// A receiver as the map's camera sees it.
struct ShadowMap::View {
  vec3 P, N;           ///< Camera space.
  vec2 at, u, v;       ///< Position and edges, in texels.
  float texel;         ///< The size of a texel at its depth.
  vec2 center, scale;  ///< texel = center + scale (x, y) [/ z]
  bool perspective;

  /// Returns the depth of the receiver's plane at a texel position, or the depth of P if the two differ by more than
  /// `reach`.
  float depth(const vec2& texelAt, float reach) const {
    const vec2 xy = (texelAt - center) / scale;
    float z = P.z;
    if (perspective) {
      const float along = dot(N, vec3(xy, 1));
      if (along != 0) z = dot(N, P) / along;
    } else if (N.z != 0) {
      z = P.z - (N.x * (xy.x - P.x) + N.y * (xy.y - P.y)) / N.z;
    }
    return std::clamp(std::isfinite(z) ? z : P.z, P.z - reach, P.z + reach);
  }
};

std::optional<ShadowMap::View> ShadowMap::viewOf(const ShadowReceiver& r, float width) const {
  const vec4 h = ndcFromWorld_ * vec4(r.P, 1);
  const auto texelOf = [this](const vec2& ndc) {
    return vec2(0.5f * (ndc.x + 1) * static_cast<float>(width_), 0.5f * (1 - ndc.y) * static_cast<float>(height_));
  };
  View view{transformPoint(cameraFromWorld_, r.P), cameraNormalFromWorld_ * r.N, {}, {}, {}, 0, {}, {}, perspective_};
  if (!(h.w > 0) || view.P.z <= 0 || std::abs(h.x) > h.w || std::abs(h.y) > h.w) return {};
  view.at = texelOf(vec2(h) / h.w);
  const auto edge = [&](const vec3& e) {
    const vec2 moved = texelOf(project(ndcFromWorld_, r.P + e)) - view.at;
    return std::isfinite(moved.x + moved.y) ? width * moved : vec2(0.0f);
  };
  view.u = edge(r.edgeU);
  view.v = edge(r.edgeV);
  const mat4 worldFromCamera = glm::inverse(cameraFromWorld_);
  const auto texelOfCamera = [&](const vec3& p) {
    return texelOf(project(ndcFromWorld_, transformPoint(worldFromCamera, p)));
  };
  view.center = texelOfCamera({0, 0, 1});
  view.scale = texelOfCamera({1, 1, 1}) - view.center;
  view.texel = (perspective_ ? view.P.z : 1) / std::min(std::abs(view.scale.x), std::abs(view.scale.y));
  return view;
}

vec3 ShadowMap::shadow(const ShadowReceiver& receiver, const ShadowLookup& lookup) const {
  const std::optional<View> found = viewOf(receiver, lookup.width);
  if (!found) return vec3(0.0f);
  const View& view = *found;
  // The square is at least a texel wide, so that texels do not show.
  const vec2 square = vec2(1.0f) + lookup.blur * vec2(width_, height_);
  const float steepest = 8;  // beyond that slope the plane says nothing about its surroundings
  const float extent = 1 + 0.5f * (glm::length(view.u) + glm::length(view.v) + glm::length(square));
  const float reach = steepest * view.texel * extent;
  const auto [u, v] = widening(square, view.u, view.v);
  vec3 sum(0.0f);
  const int n = lookup.samples;
  for (int k = 0; k < n; ++k) {
    const vec2 xi = sobol2(static_cast<uint32_t>(k), lookup.seed) - vec2(0.5f);
    const vec2 at = view.at + xi * square + xi.x * u + xi.y * v;
    const vec2 middle = glm::floor(at) + vec2(0.5f);
    const float z = view.depth(middle, reach);
    float bias = lookup.bias;
    if (bias < 0) {
      // A texel holds the nearest depth in it (a deep one all depths that its filter reaches), so the bias allows for
      // the plane's slope over that region, and for half a texel more on curved surfaces.
      const vec2 rise(view.depth(middle + vec2(0.5f, 0), reach) - z, view.depth(middle + vec2(0, 0.5f), reach) - z);
      bias = dot(spread_ + 0.5f, glm::abs(rise)) + 0.05f * view.texel + 1e-5f * view.P.z;
    }
    sum += blocked(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)), z - bias);
  }
  return sum / static_cast<float>(n);
}

const ShadowMap* ShadowMaps::find(const std::string& name, const SourceLoc& where, const std::string& user) const {
  const std::lock_guard lock(mutex_);
  const auto [it, isNew] = maps_.try_emplace(name);
  if (!isNew || name.empty()) return it->second.get();  // shaders that are given no map look up ""
  const std::vector<std::string> candidates = candidateFiles(name, searchPath_);
  const std::string path = candidates.empty() ? "" : candidates.front();
  std::string error;
  it->second = ShadowMap::read(path.empty() ? name : path, error);
  if (std::error_code none; !it->second && path.empty() && !std::filesystem::exists(name, none)) {
    std::vector<std::string> folders = foldersOf(searchPath_);
    folders.push_back(".");
    error = "not found in " + listOfFolders(folders) + hintOfMissing(name, pictureEndings(), folders);
  }
  if (it->second && path != findFile(name, searchPath_))
    log_.report(Severity::Warning, "texture-elsewhere", where,
                fmt::format("{}: shadow map \"{}\" is not there; {} is taken, which has its name", user, name, path),
                name);
  if (!it->second)
    log_.report(Severity::Missing, "shadow-map", where,
                fmt::format("{}: shadow map \"{}\" cannot be read ({}); shadows are traced instead", user, name, error),
                name);
  return it->second.get();
}

}  // namespace tomales
