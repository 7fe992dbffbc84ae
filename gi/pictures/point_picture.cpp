#include "gi/point_picture.h"

#include <fmt/format.h>

namespace tomales {
namespace {

constexpr float kMostRadius_px = 64;  ///< Disks close to the eye would otherwise be drawn over many times the picture.

/// Returns three floats of each point: the values of a channel, its normal or its radius.
std::vector<vec3> valuesOf(const PointCloud& cloud, const std::string& name) {
  std::vector<vec3> out;
  if (name == "normal") {
    for (const vec3& n : cloud.normal) out.push_back(0.5f * n + 0.5f);
    return out;
  }
  if (name == "radius") {
    for (const float r : cloud.radius) out.push_back(vec3(r));
    return out;
  }
  const std::string& wanted = name.empty() && !cloud.channels.empty() ? cloud.channels.front().name : name;
  const int offset = offsetOf(cloud.channels, wanted);
  if (offset < 0) throw FileError(fmt::format("there is no channel \"{}\"", wanted));
  const auto channel =
      std::find_if(cloud.channels.begin(), cloud.channels.end(), [&](const auto& c) { return c.name == wanted; });
  for (size_t i = 0; i < cloud.count(); ++i) {
    const float* v = cloud.at(i) + offset;
    out.push_back(channel->width >= 3 ? vec3(v[0], v[1], v[2]) : vec3(v[0]));
  }
  return out;
}

float automaticGain(const std::vector<vec3>& values) {
  std::vector<float> bright;
  for (const vec3& v : values)
    if (isFinite(v)) bright.push_back(maxComponent(glm::abs(v)));
  if (bright.empty()) return 1;
  const auto at = bright.begin() + static_cast<ptrdiff_t>(bright.size() * 98 / 100);
  std::nth_element(bright.begin(), at, bright.end());
  return *at > 0 ? 0.8f / *at : 1.0f;
}

/// A parallel view from above one corner of the box: x to the right, z up.
struct Overview {
  vec3 center, right, up, towards;
  float scale;
  vec2 middle;

  Overview(const Bound3& bound, int width, int height) : center(bound.center()), middle(vec2(width, height) * 0.5f) {
    towards = glm::normalize(vec3(-0.6f, -1.0f, 0.7f));
    right = glm::normalize(cross(vec3(0, 0, 1), towards));
    up = cross(towards, right);
    scale = 0.95f * static_cast<float>(std::min(width, height)) / std::max(glm::length(bound.size()), 1e-30f);
  }
  vec3 operator()(const vec3& p) const {
    const vec3 off = p - center;
    return {middle.x + scale * dot(off, right), middle.y - scale * dot(off, up), -dot(off, towards)};
  }
};

class Splatter {
 public:
  explicit Splatter(const PointPictureSettings& s)
      : depth_(static_cast<size_t>(s.width) * static_cast<size_t>(s.height), kInfinity) {
    image.width = image.displayWidth = s.width;
    image.height = image.displayHeight = s.height;
    image.channels = {"R", "G", "B", "A"};
    image.pixels.assign(depth_.size() * 4, 0.0f);
  }

  /// Draws the ellipse with two half axes around `center`.
  void disk(const vec3& center, const vec2& a, const vec2& b, const vec3& color) {
    const vec2 reach = glm::min(glm::sqrt(a * a + b * b) + 0.5f, vec2(kMostRadius_px));
    const vec2 end(image.width, image.height);
    const vec2 lo = glm::clamp(vec2(center) - reach, vec2(0), end),
               hi = glm::clamp(vec2(center) + reach, vec2(-1), end);
    const int x0 = static_cast<int>(lo.x), x1 = std::min(image.width - 1, static_cast<int>(hi.x));
    const int y0 = static_cast<int>(lo.y), y1 = std::min(image.height - 1, static_cast<int>(hi.y));
    const float det = a.x * b.y - a.y * b.x;
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const vec2 off = vec2(x, y) + 0.5f - vec2(center);
        const float s = (off.x * b.y - off.y * b.x) / det, t = (off.y * a.x - off.x * a.y) / det;
        const bool inside =
            std::abs(det) > 0.2f ? s * s + t * t <= 1 : std::max(std::abs(off.x), std::abs(off.y)) <= 0.5f;
        if (inside) put(x, y, center.z, color);
      }
  }

  Image image;

 private:
  void put(int x, int y, float z, const vec3& color) {
    float& nearest = depth_[static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x)];
    if (!(z < nearest)) return;
    nearest = z;
    float* to = image.at(x, y);
    to[0] = color.x;
    to[1] = color.y;
    to[2] = color.z;
    to[3] = 1;
  }

  std::vector<float> depth_;
};

}  // namespace

Image pictureOf(const PointCloud& cloud, const PointPictureSettings& settings) {
  const std::vector<vec3> values = valuesOf(cloud, settings.channel);
  const float gain = settings.gain > 0 ? settings.gain : automaticGain(values);
  const Overview overview(cloud.bound(), settings.width, settings.height);
  const auto project = [&](const vec3& p) {
    return settings.project ? settings.project(p) : std::optional(overview(p));
  };
  Splatter picture(settings);
  for (size_t i = 0; i < cloud.count(); ++i) {
    const std::optional<vec3> at = project(cloud.position[i]);
    if (!at || !isFinite(*at)) continue;
    vec3 tangent(1, 0, 0), bitangent(0, 1, 0);
    if (cloud.normal[i] != vec3(0)) orthonormalBasis(cloud.normal[i], tangent, bitangent);
    const auto a = project(cloud.position[i] + cloud.radius[i] * tangent),
               b = project(cloud.position[i] + cloud.radius[i] * bitangent);
    picture.disk(*at, a ? vec2(*a - *at) : vec2(0), b ? vec2(*b - *at) : vec2(0), gain * values[i]);
  }
  return std::move(picture.image);
}

}  // namespace tomales
