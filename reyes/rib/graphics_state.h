// The graphics state of RISpec 3.2 section 4, with its stacks. Spaces: the CTM, shader calls and named
// coordinate systems are relative to camera space before WorldBegin, and to world space after it.
#pragma once
#include <map>
#include <mutex>
#include <set>
#include <vector>

#include "reyes/prim_factories.h"
#include "reyes/rib.h"
#include "reyes/rib/intern.h"
#include "reyes/rib/ris.h"
#include "reyes/rib/search_path.h"

namespace tomales::rib {

/// Detail and DetailRange (RISpec 3.2 section 4.2.8) as far as they are not yet in Attributes::detail.
struct DetailState {
  float ruler_px2 = kInfinity;                ///< Size of the Detail box in the picture.
  std::optional<std::array<float, 4>> range;  ///< DetailRange since the innermost block began.
  DetailShare divided;  ///< Share that the ranges divide among them, as it was when the ruler's block began.
  DetailShare left;     ///< The part of `divided` that was left when the innermost block began.
};

/// The state that AttributeBegin saves.
struct Scope {
  std::shared_ptr<Attributes> attributes = std::make_shared<Attributes>();
  Motion ctm;
  Basis uBasis = bezierBasis(), vBasis = bezierBasis();
  std::shared_ptr<const TrimLoops> trim = std::make_shared<TrimLoops>();  ///< Attribute "trimcurve" is part of it.
  float shadingRate = 1, relativeShadingRate = 1;                         ///< The attributes have their product.
  bool roundCurves = false;                                               ///< Attribute "dice" "roundcurve"
  bool lightsCastShadows = false;                   ///< Attribute "light" "shadows": for lights that are made here.
  std::map<std::string, Motion> coordinateSystems;  ///< ScopedCoordinateSystem
  DetailState detail;
  int solid = -1, solidBlock = -1;  ///< Indices in World::solids of the SolidBegin around, if there is one.

  /// Returns the attributes, after making a copy if they were shared.
  Attributes& edit();
};

/// The parameter of a Volume that names its file, then its grid.
inline constexpr std::string_view kVolumeStrings = "blobbydso:stringargs";

/// ObjectBegin ... ObjectEnd: its requests, and the geometry of those that have been built for some instance.
struct Master {
  struct Shapes {
    std::vector<PrimPtr> keys;
    std::vector<float> times;
    Basis uBasis, vBasis;
    bool roundCurves;
    /// The shape was built with `trim`, roundCurves and the bases; all else follows from the request. A shape that
    /// depends on its place (hasGround()) is built for each instance.
    std::shared_ptr<const TrimLoops> trim;
    float reach;        ///< The result of reachOf() for the requests.
    uint64_t contents;  ///< The result of contentsOf() for them.
  };
  std::vector<Request> requests;
  std::map<size_t, Shapes> shapes;  ///< Indexed by the request's index.
  std::mutex mutex;                 ///< Protects the shapes: procedurals are opened by several threads.
};

/// The further state that FrameBegin and WorldBegin save.
struct Globals {
  Options options;
  std::vector<std::shared_ptr<LightCall>> lights;
  std::map<std::string, Motion> coordinateSystems;
  std::map<std::string, std::shared_ptr<Master>> masters;
  std::vector<std::map<std::string, Scope>> resources{1};  ///< Outermost ResourceBegin first.
  DirMap dirMap;
  /// Options::searchPaths before `dirMap` was applied. A new map applies to these, and so does `&` in a new path:
  /// headers of frames set both again, and no path may be mapped twice.
  std::map<std::string, std::string> unmappedPaths;
  RisState ris;
  std::map<std::string, ParamList> quantized;  ///< Parameters of Quantize by variable, for Displays that show it.
};

enum class Block { Frame, World, Attribute, Transform, Solid, Instance };
const char* blockName(Block block);

/// The state between WorldBegin and WorldEnd.
struct World {
  Motion cameraFromWorld;
  std::vector<Object> objects;
  std::vector<Procedural> procedurals;
  std::vector<Solid> solids;
  SourceLoc where;
  /// A light of the RIS era that comes after objects or procedurals, and the numbers of these.
  struct LateLight {
    int light;
    size_t objects, procedurals;
  };
  std::vector<LateLight> lateLights{};
};

class GraphicsState {
 public:
  static constexpr size_t kDeepest = 10000;

  explicit GraphicsState(Log& messages) : log(messages) {}

  Log& log;
  Scope scope;
  Globals globals;
  std::optional<World> world;
  Interner<const ShaderCall> shaderInterner;
  Interner<Attributes> attributesInterner;
  Motion identity;  ///< The matrix that Identity sets: the CTM of the instance while an object is replayed.
  /// Declarations by Declare, for Displays that show these names. They outlive frames.
  std::map<std::string, std::string> declared;

  void begin(Block block, const SourceLoc& where);
  /// Restores what `begin` saved, and closes blocks inside that were left open. Returns false, and changes nothing, if
  /// no such block is open.
  bool end(Block block, const SourceLoc& where);
  bool isOpen(Block block) const;

  /// Switches the light on here, and also after the enclosing blocks, as lights of the RIS era are.
  void switchOnEverywhere(int light);
  /// Switches the lights of the RIS era on for objects and procedurals that the world had before them. Call it when the
  /// world is complete.
  void lightEarlierObjects();
  /// Turns the CTM into the camera: what was relative to the camera is now relative to the world.
  void enterWorld(const SourceLoc& where);
  Motion cameraFromObject() const { return world ? world->cameraFromWorld * scope.ctm : scope.ctm; }

  void warn(const Request& request, const char* code, const std::string& message) const;
  /// Reports one message for all places that share the key.
  void warnOnce(const std::string& key, const SourceLoc& where, const char* code, const std::string& message,
                Severity severity = Severity::Warning);
  void warnOnce(const std::string& key, const Request& request, const char* code, const std::string& message,
                Severity severity = Severity::Warning) {
    warnOnce(key, request.where, code, message, severity);
  }

 private:
  struct Saved {
    Block block;
    SourceLoc where;
    Scope scope;
    std::unique_ptr<Globals> globals;
  };
  std::vector<Saved> stack_;
  size_t tooDeep_ = 0;
};

bool isFinite(const Motion& m);
/// Returns false if some key cannot be inverted.
bool isInvertible(const Motion& m);
/// Pre: isInvertible(m).
Motion inverse(const Motion& m);

}  // namespace tomales::rib
