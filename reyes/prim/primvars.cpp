#include "reyes/prim/primvars.h"

#include <fmt/format.h>

namespace tomales {
namespace {

bool isPosition(const std::string& name) { return name == "P" || name == "Pw" || name == "Pz"; }

size_t elementCount(Storage storage, const PrimvarCounts& counts) {
  switch (storage) {
    case Storage::Constant:
      return 1;
    case Storage::Uniform:
      return counts.uniform;
    case Storage::Varying:
      return counts.varying;
    case Storage::Vertex:
      return counts.vertex;
    case Storage::FaceVarying:
      return counts.faceVarying;
  }
  return 0;
}

std::vector<float> floatsOf(const Param& param) {
  if (param.type != ValueType::Integer) return param.floats;
  return std::vector<float>(param.ints.begin(), param.ints.end());
}

/// Texture coordinates are given as pairs, but shaders know "s" and "t".
void splitTextureCoordinates(const Param& param, const std::vector<float>& values, std::vector<Primvar>& out) {
  for (int c = 0; c < 2; ++c) {
    Primvar half{c == 0 ? "s" : "t", param.storage, ValueType::Float, 1, {}};
    half.values.reserve(values.size() / 2);
    for (size_t i = static_cast<size_t>(c); i < values.size(); i += 2) half.values.push_back(values[i]);
    out.push_back(std::move(half));
  }
}

/// Makes a point of each homogeneous point, because shaders take an hpoint for a point (RISpec 3.2, section 3.1). Its
/// weights are dropped. Rational patches interpolate the points with the weights of their own Pw, so that a variable
/// that is a copy of Pw is interpolated as Pw is.
void divideByWeight(Primvar& p) {
  std::vector<float> points;
  points.reserve(p.values.size() / 4 * 3);
  for (size_t k = 0; k < p.values.size(); k += 4)
    for (size_t c = 0; c < 3; ++c) points.push_back(p.values[k + c] / p.values[k + 3]);
  p.type = ValueType::Point;
  p.width = p.width / 4 * 3;
  p.values = std::move(points);
}

bool hasWeights(const std::vector<float>& values) {
  for (size_t k = 3; k < values.size(); k += 4)
    if (values[k] == 0) return false;
  return true;
}

void takePrimvar(const Param& param, const PrimvarCounts& counts, std::vector<Primvar>& out, Problems& problems) {
  if (param.type == ValueType::String) {
    if (param.strings.size() == 1 && (param.storage == Storage::Constant || param.storage == Storage::Uniform))
      return;  // its shaders read it from the parameters
    problems.push_back(fmt::format("{} is a string, which a surface cannot interpolate; it was dropped", param.name));
    return;
  }
  std::vector<float> values = floatsOf(param);
  const size_t elements = elementCount(param.storage, counts);
  const size_t needed = elements * static_cast<size_t>(std::max(1, param.width()));
  if (values.size() != needed) {
    problems.push_back(fmt::format("{} has {} values where {} elements need {} floats; it was dropped", param.name,
                                   values.size(), elements, needed));
    return;
  }
  if (param.name == "st" && param.width() == 2) return splitTextureCoordinates(param, values, out);
  if (param.type == ValueType::HPoint && !hasWeights(values)) {
    problems.push_back(fmt::format("{} has a point of weight 0; it was dropped", param.name));
    return;
  }
  Primvar& p = out.emplace_back(Primvar{param.name, param.storage, param.type, param.width(), std::move(values)});
  if (p.type == ValueType::HPoint) divideByWeight(p);
}

[[noreturn]] void wrongPositionCount(const char* name, size_t values, size_t vertices, size_t width) {
  throw PrimError(
      fmt::format("{} has {} values where {} vertices need {} floats", name, values, vertices, vertices * width));
}

std::vector<vec3> dividedByWeight(const Param& param, Problems& problems) {
  std::vector<vec3> points(param.floats.size() / 4);
  bool rational = false;
  for (size_t i = 0; i < points.size(); ++i) {
    const float* p = &param.floats[4 * i];
    if (p[3] == 0) throw PrimError(fmt::format("Pw of vertex {} has weight 0", i));
    points[i] = vec3(p[0], p[1], p[2]) / p[3];
    rational |= p[3] != param.floats[3];
  }
  if (rational) problems.push_back("Pw has unequal weights; the surface was made from the divided control points");
  return points;
}

}  // namespace

std::vector<Primvar> takePrimvars(const ParamList& params, const PrimvarCounts& counts,
                                  std::vector<std::string>& problems) {
  std::vector<Primvar> out;
  for (const Param& param : params)
    if (!isPosition(param.name)) takePrimvar(param, counts, out, problems);
  return out;
}

std::vector<vec3> takePositions(const ParamList& params, Count count, size_t needed, Problems& problems) {
  const Param* p = findParam(params, "P");
  const Param* pw = p ? nullptr : findParam(params, "Pw");
  if (!p && !pw) throw PrimError("there are no positions: neither P nor Pw is given");
  const Param& given = p ? *p : *pw;
  const size_t width = p ? 3 : 4, there = given.floats.size() / width;
  if (given.floats.size() % width != 0 || there < needed || (count == Count::Exactly && there != needed))
    wrongPositionCount(p ? "P" : "Pw", given.floats.size(), needed, width);
  std::vector<vec3> points(p ? there : 0);
  if (pw) points = dividedByWeight(given, problems);
  for (size_t i = 0; i < points.size(); ++i) {
    if (p) points[i] = {given.floats[3 * i], given.floats[3 * i + 1], given.floats[3 * i + 2]};
    if (!isFinite(points[i])) throw PrimError(fmt::format("position {} is not a finite point", i));
  }
  return points;
}

std::vector<vec4> takeHomogeneous(const ParamList& params, size_t count) {
  Problems unequalWeights;  // not reported here
  const std::vector<vec3> points = takePositions(params, Count::Exactly, count, unequalWeights);
  const Param* pw = findParam(params, "P") ? nullptr : findParam(params, "Pw");
  std::vector<vec4> out;
  for (size_t i = 0; i < points.size(); ++i) {
    const float weight = pw ? pw->floats[4 * i + 3] : 1.0f;
    out.emplace_back(points[i] * weight, weight);
  }
  return out;
}

void requireFinite(std::initializer_list<float> values, const char* what) {
  for (float value : values)
    if (!std::isfinite(value)) throw PrimError(fmt::format("{} has a parameter that is not a finite number", what));
}

size_t requireFaces(const std::vector<int>& vertexCounts, const std::vector<int>& vertices) {
  if (vertexCounts.empty()) throw PrimError("the mesh has no faces");
  size_t total = 0;
  for (size_t f = 0; f < vertexCounts.size(); ++f) {
    if (vertexCounts[f] < 0) throw PrimError(fmt::format("face {} has {} vertices", f, vertexCounts[f]));
    total += static_cast<size_t>(vertexCounts[f]);
  }
  if (total != vertices.size())
    throw PrimError(fmt::format("the faces need {} vertex indices and {} are given", total, vertices.size()));
  int highest = -1;
  for (int vertex : vertices) {
    if (vertex < 0) throw PrimError(fmt::format("vertex index {} is negative", vertex));
    highest = std::max(highest, vertex);
  }
  return static_cast<size_t>(highest) + 1;
}

}  // namespace tomales
