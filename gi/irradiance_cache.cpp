#include "gi/irradiance_cache.h"

#include <utility>

namespace tomales {
namespace {

constexpr float kMinPixels = 1.5f;              // R- of eq. 3
constexpr float kFinestPixels = 1;             // of a dispute, at kappa 1
constexpr float kMaxAngleTerm = 0.0151922470f;  // 1 - cos(alpha+), alpha+ = 10 degrees (eq. 4)
constexpr float kBehindTolerance = 0.1f;        // of the validity radius
constexpr float kDispute = 0.1f;              // relative difference of extrapolated values, at kappa 1, that is no longer smooth
constexpr float kTorn = 0.5f;                 // the same between points that see other things
constexpr float kNoiseMargin = 3;             // standard errors
constexpr float kDark = 0.1f;                 // of the mean E: what is darker is off by fractions of this, not of itself
constexpr int kMaxDepth = 24;
constexpr int kNone = -1;

// A record lives in the node whose size matches its validity radius, as in Ward et al. 1988. That radius
// depends on the pixel size at the lookup (eq. 3), so a lookup prunes with the largest record size below a
// node instead.
struct Node {
  float largest = 0;  // record size, of this node and all below
  int child[8] = {kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone};
  std::vector<uint32_t> records;
};

struct Box {
  vec3 center;
  float half;

  int childIndex(const vec3& p) const {
    return (p.x >= center.x ? 1 : 0) | (p.y >= center.y ? 2 : 0) | (p.z >= center.z ? 4 : 0);
  }
  Box child(int i) const {
    const float h = half * 0.5f;
    return {center + vec3(i & 1 ? h : -h, i & 2 ? h : -h, i & 4 ? h : -h), h};
  }
  bool contains(const vec3& p) const { return maxComponent(glm::abs(p - center)) <= half; }
  bool touches(const vec3& p, float radius) const {
    const vec3 outside = glm::max(glm::abs(p - center) - vec3(half), vec3(0.0f));
    return dot(outside, outside) <= radius * radius;
  }
};

struct Candidate {
  uint32_t record;
  float weight;
};

vec3 extrapolate(const IrradianceRecord& r, const vec3& x, const vec3& n) {
  const vec3 turn = cross(r.normal, n), step = x - r.position;
  vec3 E;
  for (int c = 0; c < 3; ++c)
    E[c] = std::max(0.0f, r.E[c] + dot(turn, r.rotationGradient[c]) + dot(step, r.translationGradient[c]));
  return E;
}

// A gradient holds near the record alone; over the validity radius it may at most double or extinguish E.
void limitTranslation(IrradianceRecord& r, float radius) {
  for (int c = 0; c < 3; ++c) {
    vec3& gradient = r.translationGradient[c];
    const float change = glm::length(gradient) * radius;
    if (!(change < kInfinity))
      gradient = vec3(0.0f);
    else if (change > r.E[c])
      gradient *= r.E[c] / change;
  }
}

}  // namespace

struct IrradianceCache::Impl {
  CacheSettings settings;
  Bound3 bound;
  Box root;
  std::vector<Node> nodes{Node{}};
  std::vector<uint32_t> outside;  // records beyond the root box
  std::vector<IrradianceRecord> records;
  double luminanceSum = 0;  // of their E

  float size(const IrradianceRecord& r) const {
    switch (settings.errorFunction) {
      case ErrorFunction::Ward:
        return r.harmonicMean;
      case ErrorFunction::Hessian:
        return std::min(r.smoothRadius, r.closest * settings.kappa);
      default:
        return r.closest * 0.5f;
    }
  }
  // Distance at which the error reaches 1: the denominator of eq. 3 over kappa. Ward's split sphere has the
  // same limits.
  float reach(float recordSize, float pixelSize) const {
    const float radius =
        std::max(std::min(recordSize, settings.maxPixels * pixelSize), kMinPixels * pixelSize);
    return radius / settings.kappa;
  }

  void insert(uint32_t index) {
    const IrradianceRecord& r = records[index];
    if (!root.contains(r.position)) return outside.push_back(index);
    const float recordSize = size(r), radius = reach(recordSize, r.pixelSize);
    Box box = root;
    int node = 0;
    for (int depth = 0;; ++depth) {
      Node& here = nodes[static_cast<size_t>(node)];
      here.largest = std::max(here.largest, recordSize);
      if (depth == kMaxDepth || box.half < 2 * radius) return here.records.push_back(index);
      const int i = box.childIndex(r.position);
      box = box.child(i);
      node = descend(node, i);
    }
  }

  enum class Dispute { None, Steep, Torn };

  Dispute disputeOf(const vec3& a, const vec3& b, float noise) const {
    const float tolerance = settings.errorFunction == ErrorFunction::Ward ? 4 * kDispute : kDispute;  // as kappa counts there
    const float larger = std::max(luminance(a), luminance(b)), off = std::abs(luminance(a) - luminance(b)) - kNoiseMargin * noise;
    const auto dark = static_cast<float>(kDark * luminanceSum / static_cast<double>(records.size()));
    if (!(off > tolerance / settings.kappa * std::max(larger, dark))) return Dispute::None;
    return off > kTorn * std::max(larger, dark) ? Dispute::Torn : Dispute::Steep;
  }

  // Steep light needs no record nearer than a pixel: they would be noise of single pixels, paid with a hemisphere each. What is torn lies on
  // both sides of something thinner than that.
  float least(float pixelSize) const { return kFinestPixels * pixelSize / settings.kappa; }
  float limitBy(Dispute dispute, float distance, float pixelSize) const {
    if (dispute == Dispute::None) return kInfinity;
    return dispute == Dispute::Torn ? distance : std::max(distance, least(pixelSize));
  }

  // Of an extrapolated value: gradients are as noisy as E over the mean distance of what is seen.
  static float noiseAt(const IrradianceRecord& r, float distance) { return r.noise * (1 + distance / r.harmonicMean); }

  // The new record knows E at its place, which older ones have been guessing, and they at theirs.
  void settleDisputes(uint32_t index) {
    IrradianceRecord& fresh = records[index];
    for (const Candidate& candidate : candidatesAt(fresh.position, fresh.normal, fresh.pixelSize)) {
      IrradianceRecord& old = records[candidate.record];
      const float distance = glm::length(fresh.position - old.position), fromOld = noiseAt(old, distance), fromFresh = noiseAt(fresh, distance);
      const Dispute ofOld = disputeOf(extrapolate(old, fresh.position, fresh.normal), fresh.E, fromOld + fresh.noise);
      const Dispute ofFresh = disputeOf(extrapolate(fresh, old.position, old.normal), old.E, fromFresh + old.noise);
      old.limit = std::min(old.limit, limitBy(ofOld, distance, old.pixelSize));
      fresh.limit = std::min(fresh.limit, limitBy(ofFresh, distance, fresh.pixelSize));
    }
  }

  int descend(int node, int i) {
    const int child = nodes[static_cast<size_t>(node)].child[i];
    if (child != kNone) return child;
    const int added = static_cast<int>(nodes.size());
    nodes[static_cast<size_t>(node)].child[i] = added;
    nodes.emplace_back();
    return added;
  }

  // Smooth down to 0 where the record stops being used, so that interpolation has no seams.
  float weight(const IrradianceRecord& r, const vec3& x, const vec3& n, float pixelSize) const {
    const float radius = std::min(reach(size(r), pixelSize), r.limit);
    const vec3 step = x - r.position;
    const float distance2 = dot(step, step);
    if (!(distance2 < radius * radius)) return 0;
    // A point behind the record sees other things than the record did (Ward et al. 1988, section 4).
    const float behind = -0.5f * dot(step, n + r.normal) / (kBehindTolerance * radius);
    if (behind >= 1) return 0;
    const float front = 1 - std::max(0.0f, behind);
    const float position = std::sqrt(distance2) / radius;
    const float angle = std::sqrt(std::max(0.0f, 1 - dot(n, r.normal)));
    if (settings.errorFunction != ErrorFunction::Ward) {
      const float error = std::max(position, settings.kappa * angle / std::sqrt(kMaxAngleTerm));  // eq. 2
      return front * std::max(0.0f, 1 - error);                                                      // eq. 5
    }
    const float error = position + settings.kappa * angle;
    return front * std::max(0.0f, 1 / std::max(error, 1e-4f) - 1);
  }

  void collect(const std::vector<uint32_t>& from, const vec3& x, const vec3& n, float pixelSize,
               std::vector<Candidate>& out) const {
    for (const uint32_t i : from) {
      const float w = weight(records[i], x, n, pixelSize);
      if (w > 0) out.push_back({i, w});
    }
  }

  void collect(int node, const Box& box, const vec3& x, const vec3& n, float pixelSize,
               std::vector<Candidate>& out) const {
    const Node& here = nodes[static_cast<size_t>(node)];
    if (!box.touches(x, reach(here.largest, pixelSize))) return;
    collect(here.records, x, n, pixelSize, out);
    for (int i = 0; i < 8; ++i)
      if (here.child[i] != kNone) collect(here.child[i], box.child(i), x, n, pixelSize, out);
  }

  // In the order of the records, so that the shape of the tree leaves no trace.
  std::vector<Candidate> candidatesAt(const vec3& x, const vec3& n, float pixelSize) const {
    std::vector<Candidate> out;
    collect(outside, x, n, pixelSize, out);
    collect(0, root, x, n, pixelSize, out);
    std::sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) { return a.record < b.record; });
    return out;
  }

  IrradianceEstimate blend(const std::vector<Candidate>& candidates, const vec3& x, const vec3& n, float pixelSize) const {
    IrradianceEstimate out{vec3(0.0f), {vec3(0.0f), vec3(0.0f), vec3(0.0f)}};
    float nearest = kInfinity;
    Dispute worst = Dispute::None;
    for (const Candidate& candidate : candidates) {
      const IrradianceRecord& r = records[candidate.record];
      const vec3 E = extrapolate(r, x, n);
      const float distance = glm::length(x - r.position);
      if (&candidate != &candidates.front()) worst = std::max(worst, disputeOf(E, out.E / out.weight, 2 * noiseAt(r, distance)));
      nearest = std::min(nearest, distance);
      out.E += candidate.weight * E;
      for (int c = 0; c < 3; ++c) out.dominant[c] += candidate.weight * r.dominant[c];  // eq. 7
      out.weight += candidate.weight;
    }
    if (out.weight > 0) out.E /= out.weight;
    out.disputed = limitBy(worst, nearest, pixelSize) <= nearest;
    for (vec3& d : out.dominant) d = normalizeOr(d, n);
    return out;
  }
};

IrradianceCache::IrradianceCache(const Bound3& bound, const CacheSettings& settings)
    : impl_(std::make_unique<Impl>()) {
  impl_->settings = settings;
  impl_->bound = bound;
  impl_->root =
      bound.empty() ? Box{vec3(0.0f), 0.0f} : Box{bound.center(), 0.5001f * maxComponent(bound.size())};
}

IrradianceCache::IrradianceCache(IrradianceCache&&) noexcept = default;
IrradianceCache& IrradianceCache::operator=(IrradianceCache&&) noexcept = default;
IrradianceCache::~IrradianceCache() = default;

void IrradianceCache::insert(const IrradianceRecord& record) {
  Impl& impl = *impl_;
  impl.records.push_back(record);
  impl.luminanceSum += luminance(record.E);
  if (!(impl.settings.kappa < kInfinity)) return;
  limitTranslation(impl.records.back(), impl.reach(impl.size(record), record.pixelSize));
  impl.settleDisputes(static_cast<uint32_t>(impl.records.size() - 1));
  impl.insert(static_cast<uint32_t>(impl.records.size() - 1));
}

void IrradianceCache::restore(const IrradianceRecord& record) {
  impl_->records.push_back(record);
  impl_->luminanceSum += luminance(record.E);
  if (impl_->settings.kappa < kInfinity) impl_->insert(static_cast<uint32_t>(impl_->records.size() - 1));
}

IrradianceEstimate IrradianceCache::lookup(const vec3& x, const vec3& normal, const vec3& shadingNormal, float pixelSize) const {
  if (!(impl_->settings.kappa < kInfinity)) return impl_->blend({}, x, shadingNormal, pixelSize);
  return impl_->blend(impl_->candidatesAt(x, normal, pixelSize), x, shadingNormal, pixelSize);
}

const std::vector<IrradianceRecord>& IrradianceCache::records() const { return impl_->records; }
const Bound3& IrradianceCache::bound() const { return impl_->bound; }

}  // namespace tomales
