// The lights of one chunk of points: evaluated when a shader first asks, then kept for its other questions.
// Shadow rays are traced later still, sample by sample, for the points on whose side of the surface the
// sample turns out to be.
#pragma once
#include <deque>
#include <string>
#include <vector>

#include "reyes/shade.h"

namespace tomales {

class Batch;
struct BoundLight;

struct LightSample {
  const BoundLight* light;
  TmVec3 L;          ///< Unit, from P to the light.
  TmVec3 Cl;         ///< Divided by the number of samples; multiplied by transmission where `pending` is 0.
  TmVec3 toward;     ///< L at full length: what a shadow ray travels.
  ShadowRays rays;   ///< Which they are.
  uint8_t* pending;  ///< 1: a shadow ray is still to be traced. Null: the light casts no shadows.
  TmVec3 far{};      ///< L at full length, for points and their neighbours.
  const TmValue* params = nullptr;  ///< Of this run of its shader, outputs included.
  const float *nondiffuse = nullptr, *nonspecular = nullptr;  ///< Its outputs of that name.
};

class Lights {
 public:
  /// From now on only lights of this group count; null: all.
  void restrictTo(const std::string* group);
  /// Sum of the ambient lights at the active points of `asking`.
  void ambient(Batch& batch, const TmGrid& asking, TmVec3 out);
  /// All samples of all lights that have a direction, in the order of Attributes::lights. Unshadowed until
  /// `shadow`.
  std::vector<LightSample>& samples(Batch& batch);
  /// Traces what is pending at the points of `want`.
  void shadow(Batch& batch, LightSample& sample, const uint8_t* want) const;

 private:
  void shadowFromAnswers(Batch& batch, LightSample& sample, const uint8_t* want) const;
  void evaluate(Batch& batch, const BoundLight& light);
  void substitute(Batch& batch);
  bool evaluated_ = false;
  std::deque<std::vector<TmValue>> params_;
  std::vector<LightSample> samples_, chosen_;  ///< All; those of group_.
  const std::string* group_ = nullptr;
};

}  // namespace tomales
