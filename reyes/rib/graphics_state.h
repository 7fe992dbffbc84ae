// The graphics state of RISpec 3.2 section 4, with its stacks. Spaces: the CTM, shader calls and named
// coordinate systems are relative to camera space before WorldBegin, and to world space after it.
#pragma once
#include <mutex>
#include <set>

#include "reyes/rib.h"
#include "reyes/rib/intern.h"
#include "reyes/rib/ris.h"
#include "reyes/rib/search_path.h"

namespace tomales::rib {

/// Detail and DetailRange (RISpec 3.2 section 4.2.8) as far as they are not yet in Attributes::detail.
struct DetailState {
  float ruler_px2 = kInfinity;                ///< Size of the Detail box in the picture.
  std::optional<std::array<float, 4>> range;  ///< DetailRange since the innermost block began.
  DetailShare divided;  ///< What ranges divide among them: what was left when the block of the ruler began,
  DetailShare left;     ///< and when the innermost block did.
};

/// What AttributeBegin saves.
struct Scope {
  std::shared_ptr<Attributes> attributes = std::make_shared<Attributes>();
  Motion ctm;
  Basis uBasis = bezierBasis(), vBasis = bezierBasis();
  std::shared_ptr<const TrimLoops> trim = std::make_shared<TrimLoops>();  ///< Attribute "trimcurve" is part of it.
  float shadingRate = 1, relativeShadingRate = 1;                         ///< Their product is in the attributes.
  bool roundCurves = false;                                               ///< Attribute "dice" "roundcurve"
  bool lightsCastShadows = false;                   ///< Attribute "light" "shadows": for lights that are made here.
  std::map<std::string, Motion> coordinateSystems;  ///< ScopedCoordinateSystem
  DetailState detail;
  int solid = -1, solidBlock = -1;  ///< In World::solids: the SolidBegin around, if any.

  /// The attributes, no longer shared with anybody.
  Attributes& edit();
};

/// ObjectBegin ... ObjectEnd: its requests, and the geometry of those that have been built for some instance.
struct Master {
  struct Shapes {
    std::vector<PrimPtr> keys;
    std::vector<float> times;
    Basis uBasis, vBasis;
    bool roundCurves;
    std::shared_ptr<const TrimLoops>
        trim;           ///< Those that it was built with; the others see the values of the request only.
    float reach;        ///< reachOf() the requests.
    uint64_t contents;  ///< contentsOf() them.
  };
  std::vector<Request> requests;
  std::map<size_t, Shapes> shapes;  ///< By index of the request.
  std::mutex mutex;                 ///< Of the shapes: procedurals are opened by several threads.
};

/// What FrameBegin and WorldBegin save besides.
struct Globals {
  Options options;
  std::vector<std::shared_ptr<LightCall>> lights;
  std::map<std::string, Motion> coordinateSystems;
  std::map<std::string, std::shared_ptr<Master>> masters;
  std::vector<std::map<std::string, Scope>> resources{1};  ///< Outermost ResourceBegin first.
  DirMap dirMap;
  std::map<std::string, std::string>
      unmappedPaths;  ///< Options::searchPaths before dirMap: headers of frames say both again.
  Patterns patterns;
  std::map<std::string, ParamList> quantized;  ///< Quantize of a variable: parameters of the Displays that show it.
};

enum class Block { Frame, World, Attribute, Transform, Solid, Instance };
const char* blockName(Block block);

/// Between WorldBegin and WorldEnd.
struct World {
  Motion cameraFromWorld;
  std::vector<Object> objects;
  std::vector<Procedural> procedurals;
  std::vector<Solid> solids;
  SourceLoc where;
};

class GraphicsState {
 public:
  static constexpr size_t kDeepest = 10000;

  explicit GraphicsState(Log& messages) : log(messages) {}

  Log& log;
  Scope scope;
  Globals globals;
  std::optional<World> world;
  Interner<const ShaderCall> shaders;
  Interner<Attributes> attributes;
  Motion identity;  ///< What Identity sets: the CTM of the instance while an object is replayed.

  void begin(Block block, const SourceLoc& where);
  /// Restores what `begin` saved, closing forgotten blocks within. False: there is no such block here;
  /// nothing changed.
  bool end(Block block, const SourceLoc& where);
  bool isOpen(Block block) const;

  /// Here, and when the blocks around have ended: lights of the RIS era.
  void switchOnEverywhere(int light);
  /// From camera-relative to world-relative: CTM becomes the camera.
  void enterWorld(const SourceLoc& where);
  Motion cameraFromObject() const { return world ? world->cameraFromWorld * scope.ctm : scope.ctm; }

  void warn(const Request& request, const char* code, const std::string& message) const;
  /// One message for all sites that share the key.
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
/// False if some key cannot be inverted.
bool isInvertible(const Motion& m);
/// Pre: isInvertible(m).
Motion inverse(const Motion& m);

}  // namespace tomales::rib
