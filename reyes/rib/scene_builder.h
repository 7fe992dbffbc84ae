// The RiSink that builds Scenes. It keeps blocks, motion, retained objects and the world; the effects of single
// requests on the state are in handlers.h.
#pragma once
#include "reyes/rib/handlers.h"

namespace tomales::rib {

/// Tells whether the positional arguments have no NaN, and no infinity where it has no meaning.
bool usableArguments(const Request& request);

class SceneBuilder : public RiSink {
 public:
  SceneBuilder(const RibSettings& settings, Log& log) : settings_(settings), state_(log) {}

  /// The state that stays the same inside of a world. A LocalState is the state that changes there.
  struct StreamState {
    Globals globals;
    World world;
  };
  struct LocalState {
    Scope scope;
    Motion identity;
  };
  /// Builds the contents of a procedural: a world of its own, with the state around the procedural.
  SceneBuilder(const RibSettings& settings, Log& log, const StreamState& around, const LocalState& place);

  void request(const Request& request) override;
  /// Ends the stream: a world whose WorldEnd is missing is passed to RibSettings::onScene.
  void finish(const SourceLoc& where);

  /// Returns true where geometry may be left for later.
  bool takesProcedurals() const;
  /// Pre: takesProcedurals(), and the bound is a box.
  void addProcedural(const std::vector<float>& bound, std::function<Expansion()> open, const SourceLoc& where);
  /// Pre: inside a world.
  StreamState streamState() const;
  LocalState place() const { return {state_.scope, state_.identity}; }
  /// Returns the contents of the procedural. The builder must not be used after it.
  Expansion takeExpansion();

  const Options& options() const { return state_.globals.options; }
  const Attributes& attributes() const { return *state_.scope.attributes; }
  const DirMap& dirMap() const { return state_.globals.dirMap; }
  /// Returns the number of pixels that a box in object space (xmin xmax ymin ymax zmin zmax) may cover; all, if the box
  /// is not finite.
  float rasterArea(const std::vector<float>& bound) const;

 private:
  using Keys = std::vector<const Request*>;
  struct MotionBlock {
    Request begin;
    std::vector<Request> keys;
    size_t masterRequest;
    bool surplus = false;     ///< There were more requests than times.
    bool firstAlone = false;  ///< The times do not increase, which has been reported.
  };
  struct ObjectRecording {
    Request begin;
    std::shared_ptr<Master> master = std::make_shared<Master>();
  };

  /// Returns true, and reports it once, if the request belongs to an edit of re-rendering.
  bool isEdit(const Request& request);
  void record(const Request& request);
  void step(const Request& request);
  void perform(const Request& request);
  /// Returns true, and reports it, if the request is not allowed in a procedural.
  bool refuse(const Request& request);
  /// Performs a request that changes more than the graphics state. Returns false if it is none of those.
  bool performBlock(const Request& request);
  bool performHandler(const Request& request);
  void performTranslation(const Translation& translation);

  void declare(const Request& request);
  void errorHandler(const Request& request);
  void warnOfEnd(const Request& request);
  void beginSolidBlock(const Request& request);
  void endSolidBlock(const Request& request);
  void beginFrame(const Request& request);
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
  /// Takes the shapes from the master if it has them.
  Master::Shapes shapesOf(const Keys& keys, const std::vector<float>& times);
  Master::Shapes buildShapes(const Keys& keys, const std::vector<float>& times);
  PrimPtr buildShape(const Request& request, const MotionKeys& motion);
  std::optional<GroundPicture> groundOf(const Request& blobby, int string) const;
  std::string description(const Request& request) const;

  const RibSettings settings_;
  GraphicsState state_;
  std::optional<MotionBlock> motion_;
  std::optional<ObjectRecording> recording_;
  Master* master_ = nullptr;  ///< Master of the instance that is being replayed.
  size_t masterRequest_ = 0;  ///< Index of its current request.
  int instanceDepth_ = 0;
  const bool inProcedural_ = false;
  int openEdits_ = 0;
  size_t instanceBudget_ = 0;  ///< Requests that the outermost instance may still replay.
};

}  // namespace tomales::rib
