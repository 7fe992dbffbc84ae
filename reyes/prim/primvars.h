// Private to the primitives: handling of parameter lists that all factories share.
#pragma once
#include "reyes/prim_factories.h"

namespace tomales {

/// The number of elements of a variable, by its storage class. A constant variable has one.
struct PrimvarCounts {
  size_t uniform = 1, varying = 4, vertex = 4, faceVarying = 4;
};
/// Turns a RIB parameter list into primvars. It leaves out positions (P, Pw, Pz), which the factories read themselves.
/// A variable whose number of values is not the one that `counts` asks for is dropped, with a sentence in `problems`.
std::vector<Primvar> takePrimvars(const ParamList& params, const PrimvarCounts& counts, Problems& problems);

enum class Count { Exactly, AtLeast };
/// Returns "P", or "Pw" divided by w. Throws PrimError if the number of points does not fit, or if a coordinate is not
/// finite.
std::vector<vec3> takePositions(const ParamList& params, Count count, size_t needed, Problems& problems);

/// Returns "P" with weight 1, or "Pw" unchanged: exactly `count` homogeneous points. Throws PrimError like
/// takePositions().
std::vector<vec4> takeHomogeneous(const ParamList& params, size_t count);

/// Throws PrimError unless every value is finite; `what` begins the sentence.
void requireFinite(std::initializer_list<float> values, const char* what);

/// Checks face sizes and vertex indices of PointsPolygons and SubdivisionMesh. Throws PrimError on a negative size or
/// index, and on sizes that do not add up. Returns 1 + the highest index.
size_t requireFaces(const std::vector<int>& vertexCounts, const std::vector<int>& vertices);

}  // namespace tomales
