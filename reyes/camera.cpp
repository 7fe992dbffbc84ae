#include "reyes/camera.h"

namespace tomales {

Camera::Camera(const Options& o)
    : xResolution_(o.xResolution),
      yResolution_(o.yResolution),
      perspective_(o.projection == ProjectionKind::Perspective),
      near_(o.nearClip),
      far_(o.farClip),
      planes_(o.clippingPlanes) {
  // The picture takes the upper left part of the display, whatever the shape of its pixels (RISpec 3.2 section 4.1.1,
  // FrameAspectRatio).
  const vec2 display(xResolution_, yResolution_);
  const float displayAspect = display.x * o.pixelAspect / display.y, aspect = o.frameAspect.value_or(displayAspect);
  frameAspect_ = aspect;
  const float x = display.x * std::min(aspect / displayAspect, 1.0f),
              y = display.y * std::min(displayAspect / aspect, 1.0f);
  // fov spans the smaller image dimension: screen space is +-1 along it (RISpec 3.2 section 4.1.2).
  std::array<float, 4> w =
      aspect >= 1 ? std::array<float, 4>{-aspect, aspect, -1, 1} : std::array<float, 4>{-1, 1, -1 / aspect, 1 / aspect};
  if (o.screenWindow) w = *o.screenWindow;
  const float focal = perspective_ ? 1.0f / std::tan(o.fov_degrees * (kPi / 360.0f)) : 1.0f;
  scale_ = {x / (w[1] - w[0]) * focal, -y / (w[3] - w[2]) * focal};
  offset_ = {-w[0] * x / (w[1] - w[0]), w[3] * y / (w[3] - w[2])};
  pixelSizeAtUnit_ = 1.0f / std::sqrt(std::abs(scale_.x * scale_.y));
  if (perspective_ && o.fStop < kInfinity) {
    const float stretch = std::sqrt(o.dofAspect);
    lens_ = scale_ * (0.5f * o.focalLength / o.fStop) * vec2(stretch, 1 / stretch);
    focusKey_ = depthKey(o.focalDistance);
  }

  const auto edge = [](float fraction, float shift, int resolution) {
    const float e = std::ceil(static_cast<float>(resolution) * fraction + shift);
    return std::clamp(static_cast<int>(e), 0, resolution - 1);
  };
  columns_ = std::max(1, static_cast<int>(std::lround(x)));
  rows_ = std::max(1, static_cast<int>(std::lround(y)));
  crop_ = {edge(o.cropWindow[0], 0, columns_), edge(o.cropWindow[2], 0, rows_), edge(o.cropWindow[1], -1, columns_) + 1,
           edge(o.cropWindow[3], -1, rows_) + 1};
}

bool Camera::rasterBound(const Bound3& b, Bound2& out) const {
  if (perspective_ && b.lo.z < eyePlane()) return false;
  out = {};
  // For fixed x the bound of either side is convex in 1/z, so its extremes are at corners; two corners at either depth
  // have all x and y.
  for (const float z : {b.lo.z, b.hi.z}) {
    const vec2 blur = glm::abs(defocus(depthKey(z)));
    for (const vec2 corner : {vec2(b.lo), vec2(b.hi)}) {
      const vec2 at = raster({corner, z});
      out.extend(at - blur);
      out.extend(at + blur);
    }
  }
  return true;
}

bool Camera::clips(const vec3& p) const {
  return p.z < near_ || p.z > far_ ||
         std::any_of(planes_.begin(), planes_.end(), [&](const vec4& plane) { return dot(plane, vec4(p, 1)) > 0; });
}

bool Camera::clips(const vec2& at, const vec2& lens, float key) const {
  const float z = zFromDepthKey(key);
  const vec2 p = (at - lens * (key - focusKey_) - offset_) / scale_;
  return clips(vec3(perspective_ ? p * z : p, z));
}

bool Camera::outside(const Bound3& b, const PixelRect& window) const {
  const auto beyond = [&](const vec4& plane) {
    // The corner of the box that is least far on the side that the plane cuts off.
    const vec3 least(plane.x > 0 ? b.lo.x : b.hi.x, plane.y > 0 ? b.lo.y : b.hi.y, plane.z > 0 ? b.lo.z : b.hi.z);
    return dot(plane, vec4(least, 1)) > 0;
  };
  return b.lo.z > far_ || std::any_of(planes_.begin(), planes_.end(), beyond) || outsideWindow(b, window);
}

bool Camera::outsideWindow(const Bound3& b, const PixelRect& window) const {
  if (b.empty() || b.hi.z < near_) return true;
  // raster_x >= x0  <=>  scale * x + (offset - x0) * z >= 0 for z > 0: a half space through the eye. The frustum is the
  // intersection of four of them, so a box wholly outside one of them is wholly outside. Defocus adds up to lens * |z *
  // focusKey + 1| on either side, which is convex in z, so its extremes are at corners.
  const auto allNegative = [&](float scale, float constant, int axis, float sign) {
    for (int i = 0; i < 8; ++i) {
      const vec3 c = b.corner(i);
      const float blur = std::abs(lens_[axis] * (c.z * focusKey_ + 1.0f));
      if (sign * (scale * c[axis] + constant * (perspective_ ? c.z : 1.0f)) + blur >= 0) return false;
    }
    return true;
  };
  return allNegative(scale_.x, offset_.x - static_cast<float>(window.x0), 0, 1.0f) ||
         allNegative(scale_.x, offset_.x - static_cast<float>(window.x1), 0, -1.0f) ||
         allNegative(scale_.y, offset_.y - static_cast<float>(window.y0), 1, 1.0f) ||
         allNegative(scale_.y, offset_.y - static_cast<float>(window.y1), 1, -1.0f);
}

void Camera::ray(const vec2& r, vec3& origin, vec3& direction) const {
  const vec2 p = (r - offset_) / scale_;
  if (perspective_) {
    origin = vec3(0.0f);
    direction = glm::normalize(vec3(p, 1.0f));
  } else {
    origin = vec3(p, 0.0f);
    direction = vec3(0, 0, 1);
  }
}

}  // namespace tomales
