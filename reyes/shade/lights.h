// The lights of one sub-batch of points. They are evaluated when a shader first asks, and kept for its further queries.
// Shadow rays are traced later, sample by sample, and only for points that face the sample.
#pragma once
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "reyes/shade/extended_lights.h"
#include "reyes/shade/light_sets.h"

namespace tomales {

class Batch;
struct BoundShader;

/// A parameter that the asking shader sends to lights. It does not own the arrays.
struct LightMessage {
  std::string name;
  int32_t type;
  TmValue value;
  std::string text;  ///< The value if the type is TM_STRING.
};

/// The lights that a shader asks for, and the parameters that it sends them.
struct LightRequest {
  std::string category;  ///< An expression of inCategory().
  std::vector<LightMessage> sent;
};

/// Sums over the shadow rays of one light so far, at each point.
struct ShadowTally {
  float* traced;  ///< Number of rays that were traced.
  TmVec3 passed;  ///< The sum of the light that they let pass.
};

/// The clusters into which each point divides the lights of a set: those of point i are first[i] to first[i + 1].
struct LightCuts {
  std::vector<LightCluster> clusters;
  std::vector<uint32_t> first;
  std::span<const LightCluster> at(int i) const {
    const size_t k = static_cast<size_t>(i);
    return std::span(clusters).subspan(first[k], first[k + 1] - first[k]);
  }
};

struct LightSample {
  const BoundLight*
      light;          ///< For a sample drawn from a set, the set's first light; the others differ in numbers alone.
  TmVec3 L;           ///< Unit vectors from P to the light.
  TmVec3 Cl;          ///< Divided by the number of samples; multiplied by transmission where `pending` is 0.
  TmVec3 toward;      ///< L at full length: the path of a shadow ray.
  ShadowRays rays{};  ///< The sample's shadow rays.
  uint8_t* pending = nullptr;       ///< 1 where a shadow ray is still to be traced. Null if the light casts no shadows.
  int question = 0;                 ///< Index of its shadow rays among those of the light (ray_answers.h).
  const float* pdf = nullptr;       ///< The density over solid angle of all samples of the light together, as the
                                    ///< power heuristic counts them, where along() finds it too; else 0. Null if it is
                                    ///< 0 everywhere.
  ShadowTally* tally = nullptr;     ///< Null if every shadow ray is traced.
  TmVec3 far{};                     ///< L at full length, for points and their neighbours.
  const TmValue* params = nullptr;  ///< The parameters of this run of its shader, outputs included.
  const float *nondiffuse = nullptr, *nonspecular = nullptr;  ///< The light's outputs of these names.
  TmConstVec3 Pl{}, Nl{};   ///< The points on a light with geometry, as its shader saw them.
  bool fromBehind = false;  ///< An illuminance statement has seen its light at a point that faces away from it.
  bool drawn = false;       ///< Each point has drawn a light of its own; Cl is 0 at points that have drawn none.
};

class Lights {
 public:
  /// Lets only lights of this group count from now on; null for all.
  void restrictTo(const std::string* group);
  bool restricted() const { return group_ != nullptr; }
  const std::string* group() const { return group_; }
  /// Sets the request, before the first query. `request` must outlive this object.
  void ask(const LightRequest& request) { request_ = &request; }
  /// Multiplies the samples of area lights, before the first query; later it does nothing.
  void multiplySamples(int64_t times);
  int times() const { return times_; }
  /// Writes the sum of the ambient lights at the active points of `asking`.
  void ambient(Batch& batch, const TmGrid& asking, TmVec3 out);
  /// Returns all samples of all lights that have a direction, in the order of Attributes::lights. They are unshadowed
  /// until shadow() has been called. Without `indirect`, indirect lights, which may cost many rays, do not run unless
  /// they have run already. If they do later, their samples come last.
  std::vector<LightSample>& samples(Batch& batch, bool indirect = true);
  /// Tells whether the shader has asked for incident light.
  bool asked() const { return evaluated_ || ambientAsked_; }
  /// Returns the lights that run at every point of the batch: all, or those in no set.
  const LightList& alone(const Batch& batch) const;
  /// Returns the samples that have been asked for so far, of all groups.
  const std::vector<LightSample>& evaluated() const { return samples_; }
  /// Traces the pending shadow rays at the points of `want`, except those where the tally of a light with a shadow
  /// variance is already exact enough.
  void shadow(Batch& batch, LightSample& sample, const uint8_t* want) const;

  /// Adds the light that lights with an extent send along the given directions, shadowed. Each direction adds radiance
  /// / pi * b / (a^2 + b^2), which is its weight by the power heuristic: a is the density of the light's own samples
  /// there, and b that of the given directions.
  void along(Batch& batch, const LobeDirections& lobe, TmVec3 Cl);
  /// Adds the radiance of skies to rays that have left the scene along unit directions, reduced by the opacity of what
  /// they passed.
  void addSkies(Batch& batch, TmConstVec3 direction, const uint8_t* leaves, TmConstVec3 opacity, TmVec3 color) const;
  /// Returns the largest number of samples of the lights that along() may find; 0 if there are none.
  int mostSamples(Batch& batch) const;

 private:
  void transmit(Batch& batch, const LightSample& sample, const uint8_t* want, TmVec3 passed) const;
  void transmitFromAnswers(Batch& batch, const LightSample& sample, const uint8_t* want, TmVec3 passed) const;
  void evaluate(Batch& batch, const BoundLight& light);
  bool alongOne(Batch& batch, const BoundLight& light, const LobeDirections& lobe, int layer, TmVec3 Cl);
  /// Adds the light that arrives along a lobe's directions from where they have met lights. `pdf`: weighted density of
  /// the samples.
  void addMet(Batch& batch, const BoundLight& light, const TmGrid& g, TmVec3 toward, const float* pdf,
              const LobeDirections& lobe, int layer, TmVec3 Cl);
  // drawn_lights.cpp
  const LightSets* setsOf(const Batch& batch) const;  ///< Null if all lights run.
  const LightCuts& cutsOf(Batch& batch, const LightsOfSet& some);
  void evaluateDrawn(Batch& batch, const LightsOfSet& some);
  void alongDrawn(Batch& batch, const LightsOfSet& some, const LobeDirections& lobe, TmVec3 Cl);
  void substitute(Batch& batch);
  void tell(Batch& batch, const BoundShader& light, std::vector<TmValue>& params) const;
  template <class Body>
  void forEachWithExtent(Batch& batch, const Body& body) const;
  template <class Body>
  void forEachSetWithExtent(Batch& batch, const Body& body) const;
  bool evaluated_ = false, indirectEvaluated_ = false, ambientAsked_ = false;
  std::deque<std::vector<TmValue>> params_;
  int times_ = 1;
  int lobes_ = 0;  ///< Number of lobes that along() has been given.
  std::deque<ShadowTally> tallies_;
  std::map<const LightSet*, LightCuts> cuts_;
  std::vector<LightSample> samples_, chosen_;  ///< All samples; the samples of group_.
  const std::string* group_ = nullptr;
  const LightRequest* request_ = nullptr;
};

}  // namespace tomales
