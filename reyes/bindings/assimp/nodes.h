// A model's tree of nodes as a list. Everything here is in the model's own space, right-handed, as Assimp gives it.
#pragma once
#include <assimp/scene.h>

#include <map>
#include <string>
#include <vector>

#include "reyes/base/math.h"

namespace tomales::model {

vec3 of(const aiVector3D& v);
vec3 of(const aiColor3D& c);
mat4 of(const aiMatrix4x4& m);
std::string of(const aiString& text);

struct Instance {
  std::string name;  ///< The name of its node.
  unsigned mesh = 0;
  mat4 worldFromMesh{1.0f};
};

struct Nodes {
  std::vector<Instance> instances;  ///< Instances in the order of the tree, depth first.
  std::map<std::string, mat4> worldFromNode;
  int unusable = 0;  ///< Instances that are left out: their transformation is singular or not finite.
};

Nodes nodesOf(const aiScene& scene, const mat4& worldFromModel);

}  // namespace tomales::model
