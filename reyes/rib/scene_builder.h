// The RiSink that builds Scenes: blocks, motion, retained objects and the world are kept here; what single
// requests do to the state is in handlers.h.
#pragma once
#include "reyes/rib/handlers.h"

namespace tomales::rib {

/// No NaN among the positional arguments, and no infinity where it has no meaning.
bool usableArguments(const Request& request);

class SceneBuilder : public RiSink {
 public:
  SceneBuilder(const RibSettings& settings, Log& log) : settings_(settings), state_(log) {}

  /// What all that is inside a world has in common; what is being drawn where, besides.
  struct Surroundings {
    Globals globals;
    World world;
  };
  struct Place {
    Scope scope;
    Motion identity;
  };
  /// For what a procedural stands for: a world of its own, with the state of another.
  SceneBuilder(const RibSettings& settings, Log& log, const Surroundings& around, const Place& place);

  void request(const Request& request) override;
  /// The stream is over: renders a world whose WorldEnd is missing.
  void finish(const SourceLoc& where);

  /// Here geometry may be left for later.
  bool takesProcedurals() const;
  /// Pre: takesProcedurals(), and the bound is a box.
  void addProcedural(const std::vector<float>& bound, std::function<Expansion()> open, const SourceLoc& where);
  /// Pre: inside a world.
  Surroundings surroundings() const;
  Place place() const { return {state_.scope, state_.identity}; }
  /// What a procedural stands for. The builder is spent.
  Expansion takeExpansion();

  const Options& options() const { return state_.globals.options; }
  const Attributes& attributes() const { return *state_.scope.attributes; }
  const DirMap& dirMap() const { return state_.globals.dirMap; }
  /// Pixels that a box in object space (xmin xmax ymin ymax zmin zmax) may cover; the frame, if it is no finite one.
  float rasterArea(const std::vector<float>& bound) const;

 private:
  using Keys = std::vector<const Request*>;
  struct MotionBlock {
    Request begin;
    std::vector<Request> keys;
    size_t masterRequest;
    bool surplus = false;  ///< There were more requests than times.
  };
  struct Recording {
    Request begin;
    std::shared_ptr<Master> master = std::make_shared<Master>();
  };

  /// True, and once reported: it belongs to the edits of re-rendering.
  bool isEdit(const Request& request);
  void record(const Request& request);
  void step(const Request& request);
  void perform(const Request& request);
  /// True, and reported: it has no place in a procedural.
  bool refuse(const Request& request);
  bool performBlock(const Request& request);
  bool performHandler(const Request& request);
  void performRis(const Request& request);

  void beginWorld(const Request& request);
  void endWorld(const SourceLoc& where);
  void endUnclosedWorld(const SourceLoc& where);
  void endFrame(const SourceLoc& where);

  void beginMotion(const Request& request);
  void collectKey(const Request& request);
  void endMotion();

  void endObject();
  void instance(const Request& request);

  void addGeometry(const Keys& keys, const std::vector<float>& times);
  /// From the master if it has them.
  Master::Shapes shapesOf(const Keys& keys, const std::vector<float>& times);
  Master::Shapes buildShapes(const Keys& keys, const std::vector<float>& times);
  PrimPtr buildShape(const Request& request, const MotionKeys& motion);
  std::optional<GroundPicture> groundOf(const Request& blobby, int string) const;
  std::string description(const Request& request) const;

  const RibSettings settings_;
  GraphicsState state_;
  std::optional<MotionBlock> motion_;
  std::optional<Recording> recording_;
  Master* master_ = nullptr;  ///< Of the instance that is being replayed,
  size_t masterRequest_ = 0;  ///< and where in it.
  int instanceDepth_ = 0;
  const bool inProcedural_ = false;
  int openEdits_ = 0;
  size_t instanceBudget_ = 0;  ///< Requests that the outermost instance may still replay.
};

}  // namespace tomales::rib
