// Builds Prims of geometry requests (RISpec 3.2 section 5).
#include <fmt/format.h>

#include "reyes/rib/geometry_builders.h"
#include "reyes/rib/handlers.h"

namespace tomales::rib {
namespace {

using Builder = PrimPtr (*)(const Request&, const Scope&, Problems&);

bool allFinite(const std::vector<float>& v) {
  return std::all_of(v.begin(), v.end(), [](float f) { return std::isfinite(f); });
}

/// Returns the number of points that P (or Pw, Pz) has.
int pointCount(const Request& r) {
  for (const Param& p : r.params)
    if (p.name == "P" || p.name == "Pw" || p.name == "Pz") return static_cast<int>(p.floats.size()) / p.width();
  throw PrimError("it has no P");
}

std::vector<int> countUp(int n) {
  std::vector<int> out(static_cast<size_t>(std::max(0, n)));
  for (size_t i = 0; i < out.size(); ++i) out[i] = static_cast<int>(i);
  return out;
}

/// Returns the points of a moving shape at each key; nothing if it stands still.
PointKeys pointKeys(const MotionKeys& motion) {
  PointKeys out;
  if (motion.requests.size() < 2) return out;
  for (const Request* key : motion.requests) {
    std::vector<vec3>& points = out.emplace_back();
    for (const Param& p : key->params)
      if (p.name == "P" && allFinite(p.floats))
        for (size_t i = 0; i + 2 < p.floats.size(); i += 3)
          points.emplace_back(p.floats[i], p.floats[i + 1], p.floats[i + 2]);
  }
  return out;
}

PrimPtr polygon(const Request& r, const MotionKeys& motion, Problems& problems) {
  const int n = pointCount(r);
  return makePolygons({n}, countUp(n), r.params, problems, pointKeys(motion));
}

PrimPtr generalPolygon(const Request& r, const MotionKeys& motion, Problems& problems) {
  const std::vector<int>& counts = r.args[0].integers;
  return makeGeneralPolygons({static_cast<int>(counts.size())}, counts, countUp(pointCount(r)), r.params, problems,
                             pointKeys(motion));
}

PrimPtr pointsPolygons(const Request& r, const MotionKeys& motion, Problems& problems) {
  return makePolygons(r.args[0].integers, r.args[1].integers, r.params, problems, pointKeys(motion));
}

PrimPtr pointsGeneralPolygons(const Request& r, const MotionKeys& motion, Problems& problems) {
  return makeGeneralPolygons(r.args[0].integers, r.args[1].integers, r.args[2].integers, r.params, problems,
                             pointKeys(motion));
}

bool bicubic(const Request& r) {
  const std::string& type = r.args[0].strings[0];
  if (type != "bilinear" && type != "bicubic") throw PrimError("unknown patch type \"" + type + "\"");
  return type == "bicubic";
}

PrimPtr patch(const Request& r, const Scope& s, Problems& problems) {
  if (bicubic(r)) return makeBicubicPatchMesh(4, false, s.uBasis, 4, false, s.vBasis, r.params, problems);
  return makeBilinearPatchMesh(2, false, 2, false, r.params, problems);
}

PrimPtr patchMesh(const Request& r, const Scope& s, Problems& problems) {
  const int nu = r.args[1].integer(), nv = r.args[3].integer();
  const bool uPeriodic = isPeriodic(r.args[2].strings[0], problems),
             vPeriodic = isPeriodic(r.args[4].strings[0], problems);
  if (bicubic(r)) return makeBicubicPatchMesh(nu, uPeriodic, s.uBasis, nv, vPeriodic, s.vBasis, r.params, problems);
  return makeBilinearPatchMesh(nu, uPeriodic, nv, vPeriodic, r.params, problems);
}

/// Returns two argument counts for each tag, as SubdivisionMesh has them, from three.
std::vector<int> withoutStrings(const std::vector<int>& pairs) {
  std::vector<int> out;
  for (size_t i = 0; i < pairs.size(); ++i) {
    out.push_back(pairs[i]);
    if (i % 2 == 1) out.push_back(0);
  }
  return out;
}

bool tagsAgree(const SubdivisionTags& t) {
  size_t sums[3] = {0, 0, 0};
  for (size_t i = 0; i < t.argCounts.size(); ++i) {
    if (t.argCounts[i] < 0) return false;
    sums[i % 3] += static_cast<size_t>(t.argCounts[i]);
  }
  return t.argCounts.size() == 3 * t.names.size() && sums[0] == t.ints.size() && sums[1] == t.floats.size() &&
         sums[2] == t.strings.size();
}

PrimPtr subdivisionMesh(const Request& r, const Scope&, Problems& problems) {
  SubdivisionTags tags;
  if (r.args.size() > 7)
    tags = {r.args[3].strings, r.args[4].integers, r.args[5].integers, r.args[6].numbers, r.args[7].strings};
  else if (r.args.size() > 3)
    tags = {r.args[3].strings, withoutStrings(r.args[4].integers), r.args[5].integers, r.args[6].numbers, {}};
  if (!tagsAgree(tags)) {
    problems.push_back("the counts of its tags do not add up: all tags are ignored");
    tags = {};
  }
  return makeSubdivisionMesh(r.args[0].strings[0], r.args[1].integers, r.args[2].integers, tags, r.params, problems);
}

// Returns the shapes of PxrStdAreaLight of PRMan 19 and 20, with side or diameter one.
PrimPtr lightShape(const std::string& name, const Request& r, Problems& problems) {
  if (name == "spherelight") return makeSphere(.5f, -.5f, .5f, 360, r.params, problems);
  if (name == "disklight") return makeDisk(0, .5f, 360, r.params, problems);
  if (name != "rectlight") return nullptr;
  ParamList params = r.params;
  Param& p = params.emplace_back();
  p.name = "P";
  p.type = ValueType::Point;
  p.storage = Storage::Vertex;
  p.floats = {-.5f, -.5f, 0, .5f, -.5f, 0, -.5f, .5f, 0, .5f, .5f, 0};
  return makeBilinearPatchMesh(2, false, 2, false, params, problems);
}

PrimPtr geometry(const Request& r, const Scope& s, Problems& problems) {
  const std::string& name = r.args[0].strings[0];
  if (PrimPtr light = lightShape(name, r, problems)) return light;
  if (name == "teapot") return makeTeapot(r.params, problems);
  if (name == "brickmap") return brickMap(r, s, problems);
  throw PrimError("there is no geometry \"" + name + "\"");
}

const std::unordered_map<std::string_view, Builder>& builders() {
  static const std::unordered_map<std::string_view, Builder> table = {
      {"Patch", patch},
      {"PatchMesh", patchMesh},
      {"NuPatch", nuPatch},
      {"Points", points},
      {"Curves", curves},
      {"SubdivisionMesh", subdivisionMesh},
      {"HierarchicalSubdivisionMesh", subdivisionMesh},
      {"Geometry", geometry},
      {"Volume", volumeBox},
  };
  return table;
}

/// Builders of shapes that must be cut alike at all keys of their motion.
using KeyBuilder = PrimPtr (*)(const Request&, const MotionKeys&, Problems&);
const std::unordered_map<std::string_view, KeyBuilder>& keyBuilders() {
  static const std::unordered_map<std::string_view, KeyBuilder> table = {
      {"Polygon", polygon},
      {"GeneralPolygon", generalPolygon},
      {"PointsPolygons", pointsPolygons},
      {"PointsGeneralPolygons", pointsGeneralPolygons},
      {"Blobby", nullptr},  // handled elsewhere, because it needs its ground
  };
  return table;
}

/// Returns the parameters without primitive variables that hold NaN or infinity. Throws if one of those defines the
/// shape itself.
ParamList finiteParams(const ParamList& params, Problems& problems) {
  ParamList out;
  for (const Param& p : params) {
    if (allFinite(p.floats))
      out.push_back(p);
    else if (p.name == "P" || p.name == "Pw" || p.name == "Pz")
      throw PrimError(fmt::format("{} holds a value that is not finite", p.name));
    else
      problems.push_back(fmt::format("\"{}\" holds a value that is not finite: ignored", p.name));
  }
  return out;
}

}  // namespace

float reachOf(const Request& r) {
  static constexpr std::string_view kShape[] = {"P", "Pw", "Pz", "width", "constantwidth"};
  float reach = 0;
  const auto extend = [&reach](const std::vector<float>& list) {
    for (const float f : list) reach = std::max(reach, std::abs(f));
  };
  for (const RibArg& a : r.args) extend(a.numbers);
  for (const Param& p : r.params)
    if (std::find(std::begin(kShape), std::end(kShape), p.name) != std::end(kShape)) extend(p.floats);
  return reach;
}

bool isGeometry(std::string_view name) {
  return findQuadric(name) || builders().contains(name) || keyBuilders().contains(name);
}

PrimPtr buildPrim(const Request& r, const Scope& scope, const MotionKeys& motion, const GroundReader& grounds,
                  Problems& problems) {
  for (const RibArg& a : r.args)
    if (!allFinite(a.numbers)) throw PrimError("an argument is not finite");
  const auto build = [&](const Request& request) {
    if (const std::optional<Request> joined = blobbyOfPoints(request))
      return blobby(*joined, motion.first, grounds, problems);
    if (request.name == "Blobby") return blobby(request, motion.first, grounds, problems);
    if (const Quadric* quadric = findQuadric(request.name))
      return quadric->make(request.args[0].numbers.data(), request.params, problems);
    const auto keyed = keyBuilders().find(request.name);
    return keyed != keyBuilders().end() ? keyed->second(request, motion, problems)
                                        : builders().at(request.name)(request, scope, problems);
  };
  if (std::all_of(r.params.begin(), r.params.end(), [](const Param& p) { return allFinite(p.floats); }))
    return build(r);
  Request finite = r;
  finite.params = finiteParams(r.params, problems);
  return build(finite);
}

}  // namespace tomales::rib
