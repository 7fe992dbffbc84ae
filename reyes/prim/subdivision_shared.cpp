#include "reyes/prim/subdivision_shared.h"

#include <map>

#include "reyes/base/pack.h"

namespace tomales {

template <class A>
void fields(A& a, MeshTags& x) {
  auto& [boundary, faceVarying, propagateCorners, smoothTriangles, chaikin, creaseEdges, creaseSharpness, corners,
         cornerSharpness, holes] = x;
  each(a, boundary, faceVarying, propagateCorners, smoothTriangles, chaikin, creaseEdges, creaseSharpness, corners,
       cornerSharpness, holes);
}

namespace {

/// Limit on the vertices of faces; larger meshes are rarely equal, and would be long keys.
constexpr size_t kLargest = 4096;

std::string keyOf(const Coarse& mesh) {
  Packer key;
  key.put(mesh.scheme, mesh.vertexCounts, mesh.vertices, mesh.tags, mesh.positions.size(), mesh.channels.size());
  for (const FaceVaryingChannel& c : mesh.channels) key.put(c.indices);
  return {reinterpret_cast<const char*>(key.bytes.data()), key.bytes.size()};
}

/// The shared faces that some mesh still uses.
struct Known {
  std::mutex mutex;
  std::map<std::string, std::weak_ptr<const SharedFaces>> byKey;
  size_t most = 64;  ///< Size at which entries of deleted meshes are removed.
};

}  // namespace

std::shared_ptr<const SharedFaces> sharedFaces(const Coarse& mesh) {
  if (mesh.vertices.size() > kLargest) return std::make_shared<const SharedFaces>(mesh);
  static Known known;
  std::string key = keyOf(mesh);
  const std::lock_guard lock(known.mutex);
  if (known.byKey.size() >= known.most) {
    std::erase_if(known.byKey, [](const auto& entry) { return entry.second.expired(); });
    known.most = 2 * known.byKey.size() + 64;
  }
  std::weak_ptr<const SharedFaces>& place = known.byKey[std::move(key)];
  std::shared_ptr<const SharedFaces> faces = place.lock();
  if (!faces) place = faces = std::make_shared<const SharedFaces>(mesh);
  return faces;
}

}  // namespace tomales
