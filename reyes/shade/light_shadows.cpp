// Shadow rays of light samples, which are traced, answered from recorded rays, or skipped as unnecessary.
#include "reyes/base/checksum.h"
#include "reyes/shade/batch.h"
#include "reyes/shade/lights.h"

namespace tomales {
namespace {

// The variance of visibility, estimated from shadow rays, is never quite 0: half a ray of each outcome is added, so
// that a few equal answers do not seem certain.
bool settled(const ShadowTally& tally, int i, float maxVariance) {
  const float n = tally.traced[i];
  if (n < 4) return false;
  const vec3 p = (get(tally.passed, i) + 0.5f) / (n + 1);
  return maxComponent(p * (1.0f - p)) <= maxVariance * n;
}

uint64_t sumOf(TmConstVec3 toward, int n, const ShadowRays& rays) {
  uint64_t sum = 2 * static_cast<uint64_t>(rays.samples) + rays.solar;
  for (const float* axis : {toward.x, toward.y, toward.z})
    sum = 31 * sum + checksum(std::as_bytes(std::span(axis, static_cast<size_t>(n))));
  return sum;
}

/// Fills `passed` where the answer is known and clears `unknown` there.
void recall(const ShadowAnswer& answer, int n, uint8_t* unknown, TmVec3 passed) {
  if (answer.passed.size() != static_cast<size_t>(n)) return;
  auto part = answer.parts.begin();
  for (int i = 0; i < n; ++i) {
    const uint8_t p = answer.passed[static_cast<size_t>(i)];
    if (p == ShadowAnswer::Unknown || (p == ShadowAnswer::Part && part == answer.parts.end())) continue;
    set(passed, i, p == ShadowAnswer::Everything ? vec3(1.0f) : p == ShadowAnswer::Part ? *part++ : vec3(0.0f));
    unknown[i] = 0;
  }
}

ShadowAnswer answerOf(TmVec3 passed, const uint8_t* traced, int n, uint64_t asked) {
  ShadowAnswer answer{asked, {}, {}};
  for (int i = 0; i < n; ++i) {
    const vec3 p = get(passed, i);
    const bool part = p != vec3(0.0f) && p != vec3(1.0f);
    answer.passed.push_back(!traced[i]        ? ShadowAnswer::Unknown
                            : part            ? ShadowAnswer::Part
                            : p == vec3(1.0f) ? ShadowAnswer::Everything
                                              : ShadowAnswer::Nothing);
    if (traced[i] && part) answer.parts.push_back(p);
  }
  return answer;
}

}  // namespace

void Lights::shadow(Batch& batch, LightSample& sample, const uint8_t* want) const {
  if (!sample.pending) return;
  const int n = batch.points->count();
  uint8_t* trace = batch.arena.bytes(n);
  bool any = false;
  for (int i = 0; i < n; ++i) {
    if (!want[i] || !sample.pending[i] || get(sample.Cl, i) == vec3(0.0f)) continue;
    sample.pending[i] = 0;
    if (sample.tally && settled(*sample.tally, i, sample.light->shadowVariance))
      set(sample.Cl, i, get(sample.Cl, i) * get(sample.tally->passed, i) / sample.tally->traced[i]);
    else {
      trace[i] = 1;
      any = true;
    }
  }
  if (!any) return;
  const TmVec3 passed = batch.arena.vec3(n);
  for (int i = 0; i < n; ++i) set(passed, i, vec3(1.0f));
  if (batch.context.answers)
    transmitFromAnswers(batch, sample, trace, passed);
  else
    transmit(batch, sample, trace, passed);
  for (int i = 0; i < n; ++i) {
    if (!trace[i]) continue;
    set(sample.Cl, i, get(sample.Cl, i) * get(passed, i));
    if (!sample.tally) continue;
    sample.tally->traced[i] += 1;
    set(sample.tally->passed, i, get(sample.tally->passed, i) + get(passed, i));
  }
}

void Lights::transmit(Batch& batch, const LightSample& sample, const uint8_t* want, TmVec3 passed) const {
  batch.scene.services->transmission(*batch.points, want, view(sample.toward), sample.rays, batch.context, passed);
}

// Traces rays for points without a known answer. While answers are recorded these are all points, also where the shader
// does not ask and the light is dark, so that intensities, cones and surfaces may change later without new rays.
void Lights::transmitFromAnswers(Batch& batch, const LightSample& sample, const uint8_t* want, TmVec3 passed) const {
  RayAnswers& answers = *batch.context.answers;
  const int n = batch.points->count();
  const uint64_t asked = sumOf(view(sample.toward), n, sample.rays);
  const ShadowQuestion question{batch.context.subBatch, sample.light->index, sample.question};
  uint8_t* unknown = batch.arena.bytes(n);
  std::copy_n(answers.recording ? batch.tm.active : want, n, unknown);
  const auto known = answers.shadows.find(question);
  if (known != answers.shadows.end() && known->second.asked == asked) recall(known->second, n, unknown, passed);
  if (std::none_of(unknown, unknown + n, [](uint8_t u) { return u != 0; })) return;
  transmit(batch, sample, unknown, passed);
  if (answers.recording) answers.shadows[question] = answerOf(passed, unknown, n, asked);
}

}  // namespace tomales
