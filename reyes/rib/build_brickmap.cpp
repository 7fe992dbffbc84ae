// Turns Geometry "brickmap" into Points: a disk for every finest voxel, as wide as the voxel is across its corners, in
// the plane of the surface in it.
#include "gi/brick_file.h"
#include "reyes/rib/geometry_builders.h"

namespace tomales::rib {
namespace {

std::vector<float> flattened(const std::vector<vec3>& list) {
  std::vector<float> out;
  out.reserve(3 * list.size());
  for (const vec3& v : list) out.insert(out.end(), {v.x, v.y, v.z});
  return out;
}

Param channelOf(const PointCloud& cloud, const CloudChannel& channel, size_t offset) {
  const bool color = channel.width == 3;
  Param p{channel.name,
          Storage::Varying,
          color ? ValueType::Color : ValueType::Float,
          color ? 1 : channel.width,
          {},
          {},
          {}};
  for (size_t i = 0; i < cloud.count(); ++i) {
    const float* values = cloud.at(i) + offset;
    p.floats.insert(p.floats.end(), values, values + channel.width);
  }
  return p;
}

ParamList paramsOf(const PointCloud& voxels) {
  ParamList out{{"P", Storage::Vertex, ValueType::Point, 1, flattened(voxels.position), {}, {}},
                {"width", Storage::Varying, ValueType::Float, 1, voxels.radius, {}, {}}};
  for (float& width : out[1].floats) width *= 2;
  if (std::any_of(voxels.normal.begin(), voxels.normal.end(), [](const vec3& n) { return n != vec3(0); }))
    out.push_back({"N", Storage::Varying, ValueType::Normal, 1, flattened(voxels.normal), {}, {}});
  size_t offset = 0;
  for (const CloudChannel& channel : voxels.channels) {
    out.push_back(channelOf(voxels, channel, offset));
    offset += static_cast<size_t>(channel.width);
  }
  // Standard shaders know a colour by this name alone.
  const auto color = std::find_if(out.begin(), out.end(), [](const Param& p) { return p.type == ValueType::Color; });
  if (color != out.end() && !findParam(out, "Cs")) {
    out.push_back(*color);
    out.back().name = "Cs";
  }
  return out;
}

}  // namespace

PrimPtr brickMap(const Request& r, const Scope&, Problems& problems) {
  const Param* file = findParam(r.params, "filename");
  if (!file || file->strings.empty()) throw PrimError("a brick map needs a \"string filename\"");
  try {
    const PointCloud voxels = voxelsOf(BrickFile(file->strings[0]), -1);
    if (voxels.count() == 0) throw PrimError("the brick map holds nothing");
    return makePoints(paramsOf(voxels), problems);
  } catch (const FileError& e) {
    throw PrimError(e.what());
  }
}

}  // namespace tomales::rib
