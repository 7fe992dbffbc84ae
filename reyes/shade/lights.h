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
struct BoundShader;

/// A parameter that the asking shader sends to lights; the arrays are others'.
struct LightMessage {
  std::string name;
  int32_t type;
  TmValue value;
  std::string text;  ///< Of TM_STRING.
};

/// Which lights are asked for, and what they are told.
struct LightRequest {
  std::string category;  ///< As inCategory().
  std::vector<LightMessage> sent;
};

/// What the shadow rays of one light have brought so far, at each point.
struct ShadowTally {
  float* traced;  ///< Number of them
  TmVec3 passed;  ///< Their sum
};

struct LightSample {
  const BoundLight* light;
  TmVec3 L;          ///< Unit, from P to the light.
  TmVec3 Cl;         ///< Divided by the number of samples; multiplied by transmission where `pending` is 0.
  TmVec3 toward;     ///< L at full length: what a shadow ray travels.
  ShadowRays rays;   ///< Which they are.
  uint8_t* pending;  ///< 1: a shadow ray is still to be traced. Null: the light casts no shadows.
  int question = 0;  ///< Name of its shadow rays among those of the light (ray_answers.h).
  const float* density = nullptr;   ///< Over solid angle, of all samples of the light together, where along() finds it
                                    ///< too; else 0, null: nowhere.
  ShadowTally* tally = nullptr;     ///< Null: every shadow ray is traced.
  TmVec3 far{};                     ///< L at full length, for points and their neighbours.
  const TmValue* params = nullptr;  ///< Of this run of its shader, outputs included.
  const float *nondiffuse = nullptr, *nonspecular = nullptr;  ///< Its outputs of that name.
};

/// Unit directions that a surface has drawn itself: one of `samples` for each point. density: over solid angle; 0:
/// none.
struct LobeDirections {
  TmConstVec3 L;
  const float* density;
  int sample, samples;
};

class Lights {
 public:
  /// From now on only lights of this group count; null: all.
  void restrictTo(const std::string* group);
  bool restricted() const { return group_ != nullptr; }
  const std::string* group() const { return group_; }
  /// Before the first question. `request` outlives this.
  void ask(const LightRequest& request) { request_ = &request; }
  /// Sum of the ambient lights at the active points of `asking`.
  void ambient(Batch& batch, const TmGrid& asking, TmVec3 out);
  /// All samples of all lights that have a direction, in the order of Attributes::lights. Unshadowed until
  /// `shadow`.
  std::vector<LightSample>& samples(Batch& batch);
  /// Has the shader asked what lights it?
  bool asked() const { return evaluated_ || ambientAsked_; }
  /// Those that have been asked for so far, of all groups.
  const std::vector<LightSample>& evaluated() const { return samples_; }
  /// Traces what is pending at the points of `want`, but for those whose light passes to an accuracy that the light is
  /// content with.
  void shadow(Batch& batch, LightSample& sample, const uint8_t* want) const;

  /// Adds what lights with an extent send along the given directions, shadowed, as samples by the power heuristic: with
  /// a the density of the light's own samples there and b that of those given, radiance / pi * b / (a^2 + b^2).
  void along(Batch& batch, const LobeDirections& lobe, TmVec3 Cl);
  /// Adds the radiance of lights that are all around, at infinity, to rays that have left the scene along unit
  /// directions, through what is opaque by `opacity`.
  void addSkies(Batch& batch, TmConstVec3 direction, const uint8_t* leaves, TmConstVec3 opacity, TmVec3 color) const;
  /// Of the lights that along() may find, the largest number of samples; 0: there are none.
  int mostSamples(Batch& batch) const;

 private:
  void transmit(Batch& batch, const LightSample& sample, const uint8_t* want, TmVec3 passed) const;
  void transmitFromAnswers(Batch& batch, const LightSample& sample, const uint8_t* want, TmVec3 passed) const;
  void evaluate(Batch& batch, const BoundLight& light);
  void alongOne(Batch& batch, const BoundLight& light, const LobeDirections& lobe, TmVec3 Cl);
  void substitute(Batch& batch);
  void tell(Batch& batch, const BoundShader& light, std::vector<TmValue>& params) const;
  template <class Body>
  void forEachWithExtent(Batch& batch, const Body& body) const;
  bool evaluated_ = false, ambientAsked_ = false;
  std::deque<std::vector<TmValue>> params_;
  int lobes_ = 0;  ///< That along() was given.
  std::deque<ShadowTally> tallies_;
  std::vector<LightSample> samples_, chosen_;  ///< All; those of group_.
  const std::string* group_ = nullptr;
  const LightRequest* request_ = nullptr;
};

}  // namespace tomales
