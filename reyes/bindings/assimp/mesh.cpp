#include "reyes/bindings/assimp/mesh.h"

#include <fmt/format.h>

#include <numeric>

#include "reyes/bindings/assimp/nodes.h"
#include "reyes/bindings/assimp/smooth_normals.h"
#include "reyes/bindings/assimp/welding.h"

namespace tomales::model {
namespace {

/// Faces of one kind: vertices of the mesh.
struct Faces {
  std::vector<int> counts, corners;
  std::vector<size_t> numbers;  ///< Their numbers in the mesh.
};

struct Sorted {
  Faces points, lines, polygons;
  int unusable = 0;
};

bool isFiniteVertex(const aiMesh& mesh, unsigned vertex) {
  return vertex < mesh.mNumVertices && isFinite(of(mesh.mVertices[vertex]));
}

Sorted sortedFaces(const aiMesh& mesh) {
  Sorted out;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    unsigned* end = face.mIndices + face.mNumIndices;
    if (!std::all_of(face.mIndices, end, [&](unsigned v) { return isFiniteVertex(mesh, v); })) {
      ++out.unusable;
      continue;
    }
    if (face.mNumIndices == 0) continue;
    Faces& to = face.mNumIndices == 1 ? out.points : face.mNumIndices == 2 ? out.lines : out.polygons;
    to.counts.push_back(static_cast<int>(face.mNumIndices));
    to.numbers.push_back(f);
    to.corners.insert(to.corners.end(), face.mIndices, end);
  }
  return out;
}

/// Tells whether a corner of some face is turned inward. PointsPolygons are convex (RISpec 5.1).
bool anyConcave(const Faces& faces, const std::vector<vec3>& points, const std::vector<int>& pointOf) {
  size_t first = 0;
  for (const int count : faces.counts) {
    const auto at = [&](int k) {
      const int vertex = faces.corners[first + static_cast<size_t>(k % count)];
      return points[static_cast<size_t>(pointOf[static_cast<size_t>(vertex)])];
    };
    vec3 normal(0.0f);
    for (int k = 1; k + 1 < count; ++k) normal += cross(at(k) - at(0), at(k + 1) - at(0));
    for (int k = 0; count > 3 && k < count; ++k)
      if (dot(cross(at(k + 1) - at(k), at(k + 2) - at(k + 1)), normal) < 0) return true;
    first += static_cast<size_t>(count);
  }
  return false;
}

/// Values for each corner of some faces, or for each point if all vertices at a point agree.
class Variables {
 public:
  Variables(const aiMesh& mesh, const Look& look, const Faces& faces, const Welded& welded)
      : vertices_(welded.oneToOne ? welded.vertexOf : faces.corners),
        storage_(welded.oneToOne ? Storage::Vertex : Storage::FaceVarying) {
    addTextureCoordinates(mesh, look);
    addColors(mesh, look);
  }
  template <class Of>
  void add(const std::string& name, ValueType type, int width, const Of& valueOf) {
    std::vector<float> values;
    values.reserve(vertices_.size() * static_cast<size_t>(width));
    for (const int v : vertices_) {
      const vec3 value = valueOf(v);
      for (int k = 0; k < width; ++k) values.push_back(std::isfinite(value[k]) ? value[k] : 0.0f);
    }
    list.push_back(variable(name, storage_, type, std::move(values), type == ValueType::Float ? width : 1));
  }

  ParamList list;

 private:
  void addTextureCoordinates(const aiMesh& mesh, const Look& look) {
    const auto isOfPictures = [&](unsigned set) {
      return set == look.first.set || (look.second && set == look.second->set);
    };
    addPair(mesh, "st", look.first);
    if (look.second && mesh.HasTextureCoords(look.second->set)) {
      add("s1", ValueType::Float, 1, [&](int v) { return vec3(st(mesh, *look.second, v).x); });
      add("t1", ValueType::Float, 1, [&](int v) { return vec3(st(mesh, *look.second, v).y); });
    }
    for (unsigned set = 0; set < AI_MAX_NUMBER_OF_TEXTURECOORDS; ++set)
      if (!isOfPictures(set)) addPair(mesh, fmt::format("st{}", set), {set});
  }
  void addPair(const aiMesh& mesh, const std::string& name, const TextureCoordinates& of) {
    if (mesh.HasTextureCoords(of.set)) add(name, ValueType::Float, 2, [&](int v) { return st(mesh, of, v); });
  }
  static vec3 st(const aiMesh& mesh, const TextureCoordinates& of, int vertex) {
    const aiVector3D& uv = mesh.mTextureCoords[of.set][vertex];
    return of.stFromUv * vec3(uv.x, uv.y, 1);
  }
  void addColors(const aiMesh& mesh, const Look& look) {
    if (!mesh.HasVertexColors(0)) return;
    const aiColor4D* colors = mesh.mColors[0];
    const vec3 multiplied = look.unlit.value_or(look.isColorGiven ? look.color : vec3(1.0f));
    add(look.unlit ? "emission" : "Cs", ValueType::Color, 3,
        [&](int v) { return multiplied * vec3(colors[v].r, colors[v].g, colors[v].b); });
    if (look.usesVertexAlpha &&
        std::any_of(colors, colors + mesh.mNumVertices, [](const aiColor4D& c) { return c.a < 1; }))
      add("Os", ValueType::Color, 3, [&](int v) { return vec3(look.opacity * colors[v].a); });
  }

  const std::vector<int>& vertices_;
  const Storage storage_;
};

std::vector<float> flat(const std::vector<vec3>& triples) {
  std::vector<float> out;
  out.reserve(3 * triples.size());
  for (const vec3& t : triples) out.insert(out.end(), {t.x, t.y, t.z});
  return out;
}

std::vector<int> pointsOf(const Faces& faces, const Welded& welded) {
  std::vector<int> out;
  out.reserve(faces.corners.size());
  for (const int v : faces.corners) out.push_back(welded.pointOf[static_cast<size_t>(v)]);
  return out;
}

Request polygons(const aiMesh& mesh, const Look& look, const Faces& faces, const GeometrySettings& settings) {
  const Welded welded = weld(mesh, faces.corners);
  std::vector<int> corners = pointsOf(faces, welded);
  Variables variables(mesh, look, faces, welded);
  if (!settings.subdivide && settings.keepsNormals && mesh.HasNormals())
    variables.add("N", ValueType::Normal, 3, [&](int v) { return of(mesh.mNormals[v]); });
  else if (!settings.subdivide)
    variables.list.push_back(
        variable("N", Storage::FaceVarying, ValueType::Normal,
                 flat(smoothNormals(welded.points, faces.counts, corners, settings.smooth_degrees))));
  if (!mesh.HasVertexColors(0) && settings.faceColors.size() == mesh.mNumFaces) {
    std::vector<vec3> colors;
    for (const size_t face : faces.numbers) colors.push_back(look.color * settings.faceColors[face]);
    variables.list.push_back(variable("Cs", Storage::Uniform, ValueType::Color, flat(colors)));
  }
  variables.list.insert(variables.list.begin(), variable("P", Storage::Vertex, ValueType::Point, flat(welded.points)));
  if (settings.subdivide)
    return callWith(std::move(variables.list), "SubdivisionMesh", "catmull-clark", faces.counts, std::move(corners),
                    std::vector<std::string>{"interpolateboundary"}, std::vector<int>{0, 0}, std::vector<int>{},
                    std::vector<float>{});
  if (!anyConcave(faces, welded.points, welded.pointOf))
    return callWith(std::move(variables.list), "PointsPolygons", faces.counts, std::move(corners));
  return callWith(std::move(variables.list), "PointsGeneralPolygons", std::vector<int>(faces.counts.size(), 1),
                  faces.counts, std::move(corners));
}

/// Returns the width of points and lines, which models do not give: a three-hundredth of the mesh.
float widthOf(const aiMesh& mesh) { return std::max(glm::length(boundOf(mesh).size()) / 300, 1e-6f); }

Request points(const aiMesh& mesh, const Look& look, const Faces& faces) {
  const Welded welded = weld(mesh, faces.corners);
  Faces once;
  once.corners = welded.vertexOf;
  ParamList list = Variables(mesh, look, once, welded).list;
  for (Param& p : list) p.storage = Storage::Varying;
  list.insert(list.begin(), {variable("P", Storage::Vertex, ValueType::Point, flat(welded.points)),
                             variable("constantwidth", Storage::Constant, ValueType::Float, {widthOf(mesh)})});
  return callWith(std::move(list), "Points");
}

Request lines(const aiMesh& mesh, const Faces& faces) {
  std::vector<float> P;
  for (const int v : faces.corners) {
    const vec3 p = of(mesh.mVertices[v]);
    P.insert(P.end(), {p.x, p.y, p.z});
  }
  ParamList list{variable("P", Storage::Vertex, ValueType::Point, std::move(P)),
                 variable("constantwidth", Storage::Constant, ValueType::Float, {widthOf(mesh)})};
  return callWith(std::move(list), "Curves", "linear", faces.counts, "nonperiodic");
}

size_t valuesOf(const Request& request) {
  size_t out = 0;
  for (const RibArg& a : request.args) out += a.numbers.size() + a.integers.size();
  for (const Param& p : request.params) out += p.floats.size();
  return out;
}

}  // namespace

Geometry geometryOf(const aiMesh& mesh, const Look& look, const GeometrySettings& settings) {
  const Sorted faces = sortedFaces(mesh);
  Geometry out;
  out.unusableFaces = faces.unusable;
  if (!faces.polygons.counts.empty()) out.requests.push_back(polygons(mesh, look, faces.polygons, settings));
  if (!faces.lines.counts.empty()) out.requests.push_back(lines(mesh, faces.lines));
  if (!faces.points.counts.empty()) out.requests.push_back(points(mesh, look, faces.points));
  for (const Request& r : out.requests) out.values += valuesOf(r);
  return out;
}

Bound3 boundOf(const aiMesh& mesh) {
  Bound3 out;
  for (unsigned v = 0; v < mesh.mNumVertices; ++v)
    if (const vec3 p = of(mesh.mVertices[v]); isFinite(p)) out.extend(p);
  return out;
}

}  // namespace tomales::model
