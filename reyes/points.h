// Noun: a batch of surface points to shade, visible micropolygons and ray hits alike: structure of arrays in current
// (camera) space. The code that fills it knows geometry; the code that shades it does not.
#pragma once
#include <array>

#include "reyes/base/math.h"
#include "reyes/base/simd.h"
#include "reyes/shader_api.h"

namespace tomales {

inline TmConstVec3 view(TmVec3 v) { return {v.x, v.y, v.z}; }
inline vec3 get(TmConstVec3 a, int i) { return {a.x[i], a.y[i], a.z[i]}; }
inline vec3 get(TmVec3 a, int i) { return {a.x[i], a.y[i], a.z[i]}; }
inline void set(TmVec3 a, int i, const vec3& v) {
  a.x[i] = v.x;
  a.y[i] = v.y;
  a.z[i] = v.z;
}

/// The fixed channels of a point; primitive variables follow them.
enum PointChannel : int {
  kPx,
  kPy,
  kPz,  ///< Position.
  kNx,
  kNy,
  kNz,  ///< Shading normal on RISpec's side, not flipped towards the viewer, unit length.
  kNgx,
  kNgy,
  kNgz,  ///< Geometric normal, unit length.
  kIx,
  kIy,
  kIz,  ///< Incident direction: from the eye or ray origin to P (orthographic: +z), not normalised.
  kDpduX,
  kDpduY,
  kDpduZ,
  kDpdvX,
  kDpdvY,
  kDpdvZ,  ///< Derivatives of P by the shader's u and v.
  kU,
  kV,
  kS,
  kT,
  kDu,
  kDv,
  kArea,  ///< Area of the micropolygon, or of the ray's footprint.
  /// Share of the shutter, 0..1, at which the point is seen (its P is that at shutter open); negative: it is seen over
  /// the whole shutter.
  kTime,
  kDriftX,
  kDriftY,
  kDriftZ,  ///< Motion by deformation over the shutter; ShadeGroup::currentFromOpen adds that of the transformation.
  kFixedChannels
};

/// Values that may change from one micropolygon to the next, in a batch with steps. Each has two arrays: the change
/// along the whole of a micropolygon's u edge, and along its v edge. Primitive variables follow.
enum PointStep : int { kStepN = 0, kStepS = 3, kStepT = 4, kStepU = 5, kStepV = 6, kStepPrimvars = 7 };

/// Names a point for random numbers: the same point must have the same name for any thread count, bucket size and crop.
/// Points that share a key and differ in `sequence` draw successive parts of one low-discrepancy sequence, so that a
/// mean over them (the rays of one irradiance record) is stratified as a whole.
struct SampleName {
  uint32_t key = 0, sequence = 0;
};

class ShadePoints {
 public:
  /// `group`: Scene::groups; `primvarFloats`: the sum of widths of the group's primvars; `steps`: for shaders that need
  /// derivatives over the surface.
  ShadePoints(int group, int primvarFloats, bool steps = false)
      : group_(group),
        primvarFloats_(primvarFloats),
        channels_(kFixedChannels + primvarFloats + (steps ? 2 * (kStepPrimvars + primvarFloats) : 0)) {}

  int group() const { return group_; }
  int count() const { return static_cast<int>(names_.size()); }
  int channelCount() const { return channels_; }
  int primvarFloats() const { return primvarFloats_; }
  bool hasSteps() const { return channels_ > kFixedChannels + primvarFloats_; }

  /// Appends a point and returns its index; channels are then set through `channel`.
  int add(SampleName name);
  int add(uint32_t key) { return add(SampleName{key, 0}); }
  void reserve(int count);
  /// Replaces all points by those from `begin` to `end` of another batch. Pre: both are of the same group, and both
  /// have steps or neither has.
  void assign(const ShadePoints& from, int begin, int end);
  void clear();
  void rename(int i, SampleName name) { names_[static_cast<size_t>(i)] = name; }
  /// Points of the air before a surface do not move with it, and rays leave them without an offset.
  void setInAir(bool inAir) { inAir_ = inAir; }
  bool inAir() const { return inAir_; }
  void shrink();  ///< Frees memory that growing reserved beyond need.

  float* channel(int c) { return block_.data() + static_cast<size_t>(c) * static_cast<size_t>(capacity_); }
  const float* channel(int c) const { return block_.data() + static_cast<size_t>(c) * static_cast<size_t>(capacity_); }
  float* primvar(int offset) { return channel(kFixedChannels + offset); }
  const float* primvar(int offset) const { return channel(kFixedChannels + offset); }
  /// Pre: hasSteps(). `value` is a PointStep; `v` asks for the change along v instead of u.
  float* step(int value, bool v) { return channel(stepChannel(value, v)); }
  const float* step(int value, bool v) const { return channel(stepChannel(value, v)); }
  uint32_t key(int i) const { return names_[static_cast<size_t>(i)].key; }
  SampleName name(int i) const { return names_[static_cast<size_t>(i)]; }

  vec3 get3(int c, int i) const { return {channel(c)[i], channel(c + 1)[i], channel(c + 2)[i]}; }
  void set3(int c, int i, const vec3& v) {
    channel(c)[i] = v.x;
    channel(c + 1)[i] = v.y;
    channel(c + 2)[i] = v.z;
  }
  TmConstVec3 vec(int c) const { return {channel(c), channel(c + 1), channel(c + 2)}; }

  vec3 position(int i) const { return get3(kPx, i); }
  /// Returns the shading normal turned to the side that the viewer sees (RSL faceforward(N, I)).
  vec3 facingNormal(int i) const {
    const vec3 n = get3(kNx, i);
    return dot(get3(kIx, i), get3(kNgx, i)) > 0 ? -n : n;
  }
  /// Returns the length of the longer edge of the micropolygon that the point stands for; 0 at ray hits.
  float edgeLength(int i) const {
    return std::max(glm::length(get3(kDpduX, i)) * std::abs(channel(kDu)[i]),
                    glm::length(get3(kDpdvX, i)) * std::abs(channel(kDv)[i]));
  }
  size_t bytes() const { return block_.capacity() * sizeof(float) + names_.capacity() * sizeof(SampleName); }

 private:
  void setCapacity(int points);
  int stepChannel(int value, bool v) const {
    return kFixedChannels + primvarFloats_ + (v ? kStepPrimvars + primvarFloats_ : 0) + value;
  }

  int group_, primvarFloats_, channels_;
  bool inAir_ = false;
  int capacity_ = 0;  ///< Points that fit into the block, a multiple of kLanes.
  /// One array of capacity_ floats for each channel; values between count() and padded(count()) are finite.
  UnsetVector<float> block_;
  std::vector<SampleName> names_;
};

/// Colour and opacity of a batch of shaded points, Ci premultiplied. Arrays are padded like those of ShadePoints.
struct ShadedPoints {
  AlignedVector<float> Ci[3], Oi[3];
  std::vector<AlignedVector<float>> variables;  ///< Values of FrameOutput::variables; empty if they are not stored.
  /// The part of Ci and Oi that comes from the air before a transparent point, where one sees past its surface. The air
  /// of a surface behind includes this air too, so compositing must not count it twice. Empty if there is none.
  AlignedVector<float> airCi[3], airOi[3];
  void resize(int count);
  vec3 color(int i) const {
    return {Ci[0][static_cast<size_t>(i)], Ci[1][static_cast<size_t>(i)], Ci[2][static_cast<size_t>(i)]};
  }
  void set(int i, const vec3& color, const vec3& opacity) {
    for (int k = 0; k < 3; ++k) {
      Ci[k][static_cast<size_t>(i)] = color[k];
      Oi[k][static_cast<size_t>(i)] = opacity[k];
    }
  }
  vec3 opacity(int i) const {
    return {Oi[0][static_cast<size_t>(i)], Oi[1][static_cast<size_t>(i)], Oi[2][static_cast<size_t>(i)]};
  }
};

}  // namespace tomales
