// The parts of the scene builder for requests in blocks: motion blocks, retained objects and their instances, and
// procedurals with their contents.
#include <fmt/format.h>

#include <utility>

#include "reyes/rib/collapsed.h"
#include "reyes/rib/geometry_builders.h"
#include "reyes/rib/request_table.h"
#include "reyes/rib/scene_builder.h"

namespace tomales::rib {
namespace {

// Limits that no scene needs to exceed: masters that name each other must not run forever.
constexpr int kDeepestInstance = 16;
constexpr size_t kLongestInstance = 1'000'000;

bool increasing(const std::vector<float>& times) {
  const auto finite = [](float t) { return std::isfinite(t); };
  return !times.empty() && std::all_of(times.begin(), times.end(), finite) &&
         std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
}

}  // namespace

bool SceneBuilder::takesProcedurals() const {
  return state_.world && !recording_ && !master_ && !motion_ && !state_.isOpen(Block::Solid);
}

void SceneBuilder::addProcedural(const std::vector<float>& b, std::function<Expansion()> expand,
                                 const SourceLoc& where) {
  if (state_.scope.attributes->detail.empty()) return;  // another level of detail is drawn
  Procedural p;
  p.bound = {{b[0], b[2], b[4]}, {b[1], b[3], b[5]}};
  p.worldFromObject = state_.scope.ctm;
  p.attributes = state_.scope.attributes = state_.attributesInterner(state_.scope.attributes);
  p.where = where;
  p.expand = std::move(expand);
  state_.world->procedurals.push_back(std::move(p));
}

SceneBuilder::StreamState SceneBuilder::streamState() const {
  return {state_.globals, {state_.world->cameraFromWorld, {}, {}, {}, state_.world->where}};
}

Expansion SceneBuilder::takeExpansion() {
  if (recording_ || motion_) finish(recording_ ? recording_->begin.where : motion_->begin.where);
  return {std::move(state_.world->objects), std::move(state_.world->procedurals), std::move(state_.world->solids)};
}

void SceneBuilder::beginMotion(const Request& r) {
  motion_ = MotionBlock{r, {}, masterRequest_};
  for (float& time : motion_->begin.args[0].numbers) time += state_.globals.options.shutterOffset;
  if (increasing(r.args[0].numbers)) return;
  state_.warn(r, "rib-motion", "times must be finite and increase; only the first key is used");
  motion_->begin.args[0].numbers.resize(1, 0.0f);
  motion_->firstAlone = true;
}

void SceneBuilder::collectKey(const Request& r) {
  motion_->keys.push_back(r);
  if (motion_->keys.size() > motion_->begin.args[0].numbers.size()) {
    motion_->keys.pop_back();
    motion_->surplus = true;
  }
}

void SceneBuilder::endMotion() {
  const MotionBlock block = std::move(*motion_);
  motion_.reset();
  std::vector<float> times = block.begin.args[0].numbers;
  if (!block.firstAlone && (block.surplus || block.keys.size() != times.size()))
    state_.warn(block.begin, "rib-motion",
                fmt::format("{} {}, but {} requests; those that match are used", times.size(),
                            times.size() == 1 ? "time" : "times", block.surplus ? "more" : "fewer"));
  if (block.keys.empty()) return;
  times.resize(block.keys.size());
  const bool moves = block.keys.size() > 1 && std::all_of(block.keys.begin(), block.keys.end(), usableArguments);
  std::vector<Request> requests = moves ? grown(block.keys) : block.keys;
  if (moves) addKeysOfBlobby(requests, times);
  const Request& first = requests[0];
  Keys keys;
  for (const Request& key : requests) keys.push_back(&key);
  const size_t resume = std::exchange(masterRequest_, block.masterRequest);
  if (moves && isTransformation(first.name)) {
    applyTransformation(state_, keys, times);
  } else if (moves && isGeometry(first.name)) {
    addGeometry(keys, times);
  } else {
    const Signature* signature = findSignature(first.name);
    if (moves && signature && signature->support != Support::Ignored)
      state_.warn(first, "rib-motion", "does not move; its first value is used");
    perform(first);
  }
  masterRequest_ = resume;
}

void SceneBuilder::endObject() {
  const ObjectRecording done = std::move(*recording_);
  recording_.reset();
  state_.globals.masters[done.begin.args[0].strings[0]] = done.master;
}

// The instance's attributes apply, unless the master sets its own; changes by the master end with the instance.
void SceneBuilder::instance(const Request& r) {
  const auto it = state_.globals.masters.find(r.args[0].strings[0]);
  if (it == state_.globals.masters.end()) {
    state_.log.report(Severity::Missing, "rib-unknown-object", r.where,
                      "ObjectInstance: no object has the handle \"" + r.args[0].strings[0] + "\"; nothing is drawn");
    return;
  }
  if (instanceDepth_ >= kDeepestInstance)
    return state_.log.report(
        Severity::Missing, "rib-nesting", r.where,
        fmt::format("ObjectInstance: more than {} objects within objects; ignored", kDeepestInstance));
  if (instanceDepth_ == 0) instanceBudget_ = kLongestInstance;

  const std::shared_ptr<Master> master = it->second;
  state_.begin(Block::Instance, r.where);
  const Motion outerIdentity = std::exchange(state_.identity, state_.scope.ctm);
  Master* const outer = std::exchange(master_, master.get());
  const size_t outerRequest = masterRequest_;
  ++instanceDepth_;
  for (masterRequest_ = 0; masterRequest_ < master->requests.size() && instanceBudget_ > 0; ++masterRequest_) {
    --instanceBudget_;
    step(master->requests[masterRequest_]);
  }
  if (motion_) {
    state_.warn(motion_->begin, "rib-unbalanced", "MotionEnd is missing");
    endMotion();
  }
  --instanceDepth_;
  masterRequest_ = outerRequest;
  master_ = outer;
  state_.identity = outerIdentity;
  state_.end(Block::Instance, r.where);
  if (instanceDepth_ == 0 && instanceBudget_ == 0)
    state_.log.report(
        Severity::Missing, "rib-nesting", r.where,
        fmt::format("ObjectInstance: stands for more than {} requests; the rest is ignored", kLongestInstance));
}

}  // namespace tomales::rib
