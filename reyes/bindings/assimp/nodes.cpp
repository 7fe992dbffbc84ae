#include "reyes/bindings/assimp/nodes.h"

namespace tomales::model {
namespace {

bool isUsable(const mat4& m) {
  for (int k = 0; k < 4; ++k)
    if (!isFinite(vec3(m[k]))) return false;
  const float volume = glm::determinant(mat3(m));
  return std::isfinite(volume) && volume != 0;
}

}  // namespace

vec3 of(const aiVector3D& v) { return {v.x, v.y, v.z}; }
vec3 of(const aiColor3D& c) { return {c.r, c.g, c.b}; }
std::string of(const aiString& text) { return {text.data, text.length}; }
/// Assimp's matrices act on columns too, and are stored by rows.
mat4 of(const aiMatrix4x4& m) {
  return {{m.a1, m.b1, m.c1, m.d1}, {m.a2, m.b2, m.c2, m.d2}, {m.a3, m.b3, m.c3, m.d3}, {m.a4, m.b4, m.c4, m.d4}};
}

/// Uses a stack of its own: trees of hostile files are deeper than the machine's stack.
Nodes nodesOf(const aiScene& scene, const mat4& worldFromModel) {
  struct Open {
    const aiNode* node;
    mat4 worldFromParent;
  };
  Nodes out;
  std::vector<Open> open;
  if (scene.mRootNode) open.push_back({scene.mRootNode, worldFromModel});
  while (!open.empty()) {
    const auto [node, worldFromParent] = open.back();
    open.pop_back();
    const mat4 world = worldFromParent * of(node->mTransformation);
    out.worldFromNode.emplace(of(node->mName), world);
    if (isUsable(world))
      for (unsigned k = 0; k < node->mNumMeshes; ++k)
        out.instances.push_back({of(node->mName), node->mMeshes[k], world});
    else
      out.unusable += static_cast<int>(node->mNumMeshes);
    for (unsigned k = node->mNumChildren; k-- > 0;) open.push_back({node->mChildren[k], world});
  }
  return out;
}

}  // namespace tomales::model
