// The handlers of requests, which change the graphics state; one table for each chapter of RISpec 3.2. The requests
// that the scene builder itself must know (blocks, motion, retained objects) are not here.
#pragma once
#include <optional>
#include <string_view>
#include <unordered_map>

#include "reyes/rib/graphics_state.h"

namespace tomales::rib {

/// Pre: the request fits its signature, and its numbers are finite.
using Handler = void (*)(GraphicsState&, const Request&);
using HandlerTable = std::unordered_map<std::string_view, Handler>;

const HandlerTable& optionHandlers();
const HandlerTable& displayHandlers();
const HandlerTable& attributeHandlers();
const HandlerTable& shaderHandlers();
const HandlerTable& resourceHandlers();
const HandlerTable& detailHandlers();
const HandlerTable& transformHandlers();  ///< Handlers of CoordinateSystem and its relatives.

/// Tells whether the request is Transform, Translate, ...
bool isTransformation(std::string_view name);
/// Changes the CTM. The keys are one request for each time, all with the same name.
void applyTransformation(GraphicsState& state, const std::vector<const Request*>& keys,
                         const std::vector<float>& times);

/// Tells whether the request is Sphere, Polygon, ...
bool isGeometry(std::string_view name);
/// The motion that a request is a key of.
struct MotionKeys {
  const std::vector<const Request*>& requests;  ///< Sorted by time; the request alone if it does not move.
  const Prim* first;                            ///< The shape at the first key; null if this is the first key.
};
/// Makes the shape of such a request. Throws PrimError if there is nothing to draw.
PrimPtr buildPrim(const Request& request, const Scope& scope, const MotionKeys& motion, const GroundReader& grounds,
                  Problems& problems);
/// Reads a file that a Display of depth has written. Throws PrimError.
GroundPicture readGround(const std::string& path, const mat4& worldFromObject);

/// Returns a conservative bound of the absolute coordinates of the shape's points.
float reachOf(const Request& request);

/// TrimCurve: sets the loops that cut the NuPatches after it, none if it is empty.
void trimCurve(GraphicsState& state, const Request& request);
// Solids: what SolidBegin and SolidEnd do besides saving the attributes. Call beginSolid() inside the new block, and
// endSolid() before it ends.
void beginSolid(GraphicsState& state, const Request& request);
void endSolid(GraphicsState& state, const Request& request);
/// Makes an object part of the solid that is open, if any.
void placeInSolid(GraphicsState& state, Object& object);

// Functions that handlers share.
inline vec3 asVec3(const RibArg& a, size_t at = 0) { return {a.numbers[at], a.numbers[at + 1], a.numbers[at + 2]}; }
mat4 asMatrix(const std::vector<float>& sixteen);
/// Returns the value within the limits, and reports a change.
float clamped(GraphicsState& state, const Request& request, float value, float least, float most);
/// Warns once for each "category:name" of an Option or Attribute that is ignored. If another setting does the same, the
/// message names it, and the picture is not wrong.
void warnOfIgnored(GraphicsState& state, const Request& request, const std::string& key);
/// Returns the basis of this name (RISpec 3.2 section 5.2) with its step, or nothing if there is none.
std::optional<Basis> basisNamed(std::string_view name);
ShaderCall makeShaderCall(const GraphicsState& state, const Request& request);

}  // namespace tomales::rib
