#include "reyes/rib/scene_builder.h"

#include <fmt/format.h>

#include <filesystem>

#include "reyes/base/search_path.h"
#include "reyes/base/standard_folders.h"
#include "reyes/rib/refusals.h"
#include "reyes/rib/request_table.h"
#include "reyes/rib/ris.h"

namespace tomales::rib {
namespace {

bool isBlockRequest(std::string_view name) { return name.ends_with("Begin") || name.ends_with("End"); }

bool allowsInfinity(std::string_view name) {
  static constexpr std::string_view kNames[] = {"Clipping", "DepthOfField", "Bound",
                                                "Detail",   "DetailRange",  "ShadingRate"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

bool usable(const std::vector<float>& numbers, bool infinityToo) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [&](float f) { return std::isfinite(f) || (infinityToo && !std::isnan(f)); });
}

/// Adds the folder of the scene, which may have pictures, after the working folder, where frames write maps.
void addStandardPath(Scene& scene) {
  std::string& path = scene.options.searchPaths["texture"];
  const std::string own = scene.where.folder().string();
  std::vector<std::string> folders = foldersOf(standardPath("texture"));
  if (!own.empty() && own != ".") folders.insert(folders.begin(), own);
  if (!folders.empty()) folders.insert(folders.begin(), ".");
  for (const std::string& folder : folders) path += (path.empty() ? "" : ":") + folder;
}

}  // namespace

bool usableArguments(const Request& r) {
  return std::all_of(r.args.begin(), r.args.end(),
                     [&](const RibArg& a) { return usable(a.numbers, allowsInfinity(r.name)); });
}

SceneBuilder::SceneBuilder(const RibSettings& settings, Log& log, const StreamState& around, const LocalState& place)
    : settings_(settings), state_(log), inProcedural_(true) {
  state_.scope = place.scope;
  state_.identity = place.identity;
  state_.globals = around.globals;
  state_.world = around.world;
}

void SceneBuilder::request(const Request& r) {
  if (isEdit(r)) return;
  if (recording_)
    record(r);
  else
    step(r);
}

bool SceneBuilder::isEdit(const Request& r) {
  const bool begins = r.name.starts_with("Edit") && r.name.ends_with("Begin"),
             ends = r.name.starts_with("Edit") && !begins;
  if (openEdits_ == 0 && !begins && !ends) return false;
  if (openEdits_ == 0)
    state_.warnOnce(r.name, r, "rib-unsupported", r.name + " is not supported, ignored" + reasonFor(r.name));
  openEdits_ = std::max(0, openEdits_ + begins - ends);
  return true;
}

void SceneBuilder::record(const Request& r) {
  if (r.name == "ObjectEnd") return endObject();
  const bool leaves = r.name == "WorldEnd" || r.name == "FrameEnd" || r.name == "WorldBegin" || r.name == "FrameBegin";
  if (r.name == "ObjectBegin") return state_.warn(r, "rib-unbalanced", "inside another ObjectBegin, ignored");
  if (!leaves) {
    recording_->master->requests.push_back(r);
    return;
  }
  state_.warn(recording_->begin, "rib-unbalanced", "ObjectEnd is missing");
  endObject();
  step(r);
}

// Performs a request, or sets it aside if it belongs to a motion block.
void SceneBuilder::step(const Request& r) {
  if (motion_ && r.name == "MotionEnd") return endMotion();
  const bool leaves = isBlockRequest(r.name) || (motion_ && !motion_->keys.empty() && motion_->keys[0].name != r.name);
  if (motion_ && !leaves) return collectKey(r);
  if (motion_) {
    state_.warn(motion_->begin, "rib-motion", r.name + " at " + r.where.text() + " ends the block early");
    endMotion();
  }
  perform(r);
}

void SceneBuilder::perform(const Request& r) {
  if (isGeometry(r.name) && !isRis(r)) return addGeometry({&r}, {0.0f});
  if (!usableArguments(r)) return state_.warn(r, "rib-not-finite", "an argument is not a finite number; ignored");
  if (isTransformation(r.name)) return applyTransformation(state_, {&r}, {0.0f});
  if (inProcedural_ && refuse(r)) return;
  if (isRis(r)) return performTranslation(translateRis(r, state_.globals.ris));
  if (performBlock(r) || performHandler(r)) return;
  state_.warnOnce(r.name, r, "rib-unsupported", r.name + " is not supported, ignored" + reasonFor(r.name));
}

// Lights are refused, because other objects would have to know them before the first bucket.
bool SceneBuilder::refuse(const Request& r) {
  static constexpr std::string_view kFrame[] = {"FrameBegin", "FrameEnd", "WorldBegin", "WorldEnd"};
  static constexpr std::string_view kLights[] = {"LightSource", "AreaLightSource", "Light"};
  const auto among = [&](const auto& names) {
    return std::find(std::begin(names), std::end(names), r.name) != std::end(names);
  };
  if (among(kFrame)) {
    state_.warn(r, "rib-unbalanced", "inside a procedural, ignored");
    return true;
  }
  if (!among(kLights)) return false;
  state_.warnOnce("procedural " + r.name, r, "rib-procedural-light",
                  r.name + " inside a procedural is ignored: lights are read with the world", Severity::Missing);
  return true;
}

void SceneBuilder::performTranslation(const Translation& translation) {
  for (const Note& note : translation.notes) state_.warnOnce(note.key, note.where, note.code, note.text, note.severity);
  const size_t lights = state_.globals.lights.size();
  for (const Request& request : translation.requests) perform(request);
  for (size_t i = lights; i < state_.globals.lights.size(); ++i)
    state_.switchOnEverywhere(state_.globals.lights[i]->index);
}

float SceneBuilder::rasterArea(const std::vector<float>& b) const {
  const Camera camera(options());
  const float frame = static_cast<float>(camera.xResolution()) * static_cast<float>(camera.yResolution());
  const Bound3 box =
      transformBound(state_.cameraFromObject().at(options().shutterOpen), {{b[0], b[2], b[4]}, {b[1], b[3], b[5]}});
  Bound2 raster;
  if (!tomales::isFinite(box.lo) || !tomales::isFinite(box.hi) || !camera.rasterBound(box, raster) || raster.empty())
    return frame;
  return std::min(frame, (raster.hi.x - raster.lo.x) * (raster.hi.y - raster.lo.y));
}

void SceneBuilder::beginFrame(const Request& r) {
  if (state_.isOpen(Block::Frame))
    endFrame(r.where);
  else if (state_.world)
    endUnclosedWorld(r.where);
  state_.begin(Block::Frame, r.where);
  state_.globals.options.frame = r.args[0].integer();
}

void SceneBuilder::beginSolidBlock(const Request& r) {
  state_.begin(Block::Solid, r.where);
  beginSolid(state_, r);
}

void SceneBuilder::endSolidBlock(const Request& r) {
  endSolid(state_, r);
  state_.end(Block::Solid, r.where);
}

void SceneBuilder::declare(const Request& r) {
  if (!inProcedural_) state_.declared[r.args[0].strings[0]] = r.args[1].strings[0];
}

void SceneBuilder::errorHandler(const Request& r) {
  if (r.args[0].strings[0] != "print")
    state_.warnOnce(r.name, r, "rib-unsupported", "ErrorHandler: problems are always reported, and never abort");
}

void SceneBuilder::warnOfEnd(const Request& r) { state_.warn(r, "rib-unbalanced", "without its Begin, ignored"); }

bool SceneBuilder::performBlock(const Request& r) {
  using Builder = SceneBuilder;
  const auto ofReader = [](Builder&, const Request&) {};  // the reader performs these
  static const std::unordered_map<std::string_view, void (*)(Builder&, const Request&)> table = {
      {"version", ofReader},
      {"ColorSamples", ofReader},
      {"ReadArchive", ofReader},
      {"Declare", [](Builder& b, const Request& q) { b.declare(q); }},
      {"ErrorHandler", [](Builder& b, const Request& q) { b.errorHandler(q); }},
      {"FrameBegin", [](Builder& b, const Request& q) { b.beginFrame(q); }},
      {"FrameEnd", [](Builder& b, const Request& q) { b.endFrame(q.where); }},
      {"WorldBegin", [](Builder& b, const Request& q) { b.beginWorld(q); }},
      {"WorldEnd", [](Builder& b, const Request& q) { b.endWorld(q.where); }},
      {"MotionBegin", [](Builder& b, const Request& q) { b.beginMotion(q); }},
      {"MotionEnd", [](Builder& b, const Request& q) { b.warnOfEnd(q); }},
      {"ObjectBegin", [](Builder& b, const Request& q) { b.recording_ = ObjectRecording{.begin = q}; }},
      {"ObjectEnd", [](Builder& b, const Request& q) { b.warnOfEnd(q); }},
      {"ObjectInstance", [](Builder& b, const Request& q) { b.instance(q); }},
      {"AttributeBegin", [](Builder& b, const Request& q) { b.state_.begin(Block::Attribute, q.where); }},
      {"AttributeEnd", [](Builder& b, const Request& q) { b.state_.end(Block::Attribute, q.where); }},
      {"TransformBegin", [](Builder& b, const Request& q) { b.state_.begin(Block::Transform, q.where); }},
      {"TransformEnd", [](Builder& b, const Request& q) { b.state_.end(Block::Transform, q.where); }},
      {"SolidBegin", [](Builder& b, const Request& q) { b.beginSolidBlock(q); }},
      {"SolidEnd", [](Builder& b, const Request& q) { b.endSolidBlock(q); }}};
  if (const auto it = table.find(r.name); it != table.end()) {
    it->second(*this, r);
    return true;
  }
  const bool makes = r.name.starts_with("Make") && findSignature(r.name)->support == Support::Works;
  if (makes && settings_.onMake) settings_.onMake(r);
  return makes;
}

bool SceneBuilder::performHandler(const Request& r) {
  for (const HandlerTable* table : {&attributeHandlers(), &shaderHandlers(), &detailHandlers(), &transformHandlers(),
                                    &resourceHandlers(), &optionHandlers(), &displayHandlers()}) {
    const auto it = table->find(r.name);
    if (it == table->end()) continue;
    const bool option = table == &optionHandlers() || table == &displayHandlers();
    if (option && state_.world && r.name != "Option" && r.name != "Imager")
      state_.warn(r, "rib-late-option", "options belong before WorldBegin; it counts for this world only");
    const auto good = [](const Param& p) { return usable(p.floats, true); };
    if (std::all_of(r.params.begin(), r.params.end(), good)) {
      it->second(state_, r);
    } else {
      state_.warn(r, "rib-not-finite", "parameters that hold NaN are ignored");
      Request cleaned = r;
      std::erase_if(cleaned.params, [&](const Param& p) { return !good(p); });
      it->second(state_, cleaned);
    }
    return true;
  }
  return false;
}

void SceneBuilder::beginWorld(const Request& r) {
  if (state_.world) return state_.warn(r, "rib-unbalanced", "inside another world, ignored");
  state_.begin(Block::World, r.where);
  state_.enterWorld(r.where);
}

void SceneBuilder::endWorld(const SourceLoc& where) {
  if (!state_.world) {
    state_.log.report(Severity::Warning, "rib-unbalanced", where, "WorldEnd without WorldBegin, ignored");
    return;
  }
  if (state_.globals.lights.empty()) performTranslation(headLamp(state_.globals.ris));
  state_.lightEarlierObjects();
  Scene scene;
  scene.options = state_.globals.options;
  scene.cameraFromWorld = state_.world->cameraFromWorld;
  for (Object& o : state_.world->objects) scene.objects.push_back(std::move(o));
  for (Solid& s : state_.world->solids) scene.solids.push_back(std::move(s));
  scene.procedurals = std::move(state_.world->procedurals);
  scene.lights = std::move(state_.globals.lights);
  for (const auto& [name, system] : state_.globals.coordinateSystems)
    scene.worldFromNamed[name] = system.at(scene.options.shutterOpen);
  scene.where = state_.world->where;
  state_.world.reset();
  state_.identity = Motion();
  state_.end(Block::World, where);
  addStandardPath(scene);
  scene.freeze();
  if (settings_.onScene) settings_.onScene(std::move(scene));
}

void SceneBuilder::endFrame(const SourceLoc& where) {
  if (state_.world && state_.isOpen(Block::Frame)) endUnclosedWorld(where);
  state_.end(Block::Frame, where);
}

void SceneBuilder::finish(const SourceLoc& where) {
  if (recording_) {
    state_.warn(recording_->begin, "rib-unbalanced", "ObjectEnd is missing");
    endObject();
  }
  if (motion_) {
    state_.warn(motion_->begin, "rib-unbalanced", "MotionEnd is missing");
    endMotion();
  }
  if (state_.world) endUnclosedWorld(where);
}

void SceneBuilder::endUnclosedWorld(const SourceLoc& where) {
  state_.log.report(
      Severity::Missing, "rib-unbalanced", where,
      "WorldEnd is missing for the world that begins at " + state_.world->where.text() + "; what there is is rendered");
  endWorld(where);
}

}  // namespace tomales::rib
