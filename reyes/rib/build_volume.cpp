// Builds Volumes: boxes whose density is given in the request, or by a grid of an OpenVDB file as RenderMan's plugin
// impl_openvdb takes it.
#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include "reyes/rib/geometry_builders.h"
#include "reyes/vdb.h"

namespace tomales::rib {
namespace {

constexpr std::string_view kPlugin = "blobbydso:";

Bound3 boundOf(const Request& r) {
  const std::vector<float>& b = r.args[1].numbers;
  const Bound3 out{{b[0], b[2], b[4]}, {b[1], b[3], b[5]}};
  const vec3 size = out.size();
  if (!(size.x > 0 && size.y > 0 && size.z > 0)) throw PrimError("its bound has no volume");
  return out;
}

/// Returns the numbers of a box: one for all of it, or one for each point of a lattice that spans it, x fastest.
std::unique_ptr<DensityGrid> densityOfBox(const Request& r, Problems& problems) {
  const Bound3 bound = boundOf(r);
  ivec3 counts(2);
  const Param* given = findParam(r.params, "density");
  std::vector<float> values(8, given ? given->number(1) : 1.0f);
  if (given && (given->storage == Storage::Varying || given->storage == Storage::Vertex)) {
    const std::vector<int>& n = r.args[2].integers;
    counts = {n[0], n[1], n[2]};
    const auto points = static_cast<size_t>(n[0]) * static_cast<size_t>(n[1]) * static_cast<size_t>(n[2]);
    if (n[0] < 2 || n[1] < 2 || n[2] < 2 || given->floats.size() != points)
      throw PrimError(
          fmt::format("its density has {} numbers, where {} x {} x {} points are wanted, at least 2 each way",
                      given->floats.size(), n[0], n[1], n[2]));
    values = given->floats;
  }
  const vec3 scale = vec3(counts - 1) / bound.size();
  const mat4 indexFromObject = glm::translate(glm::scale(mat4(1.0f), scale), -bound.lo);
  auto out = std::make_unique<DensityGrid>(ivec3(0), counts - 1, indexFromObject, bound);
  size_t next = 0;
  for (int z = 0; z < counts.z; ++z)
    for (int y = 0; y < counts.y; ++y)
      for (int x = 0; x < counts.x; ++x) out->set({x, y, z}, values[next++]);
  if (const size_t bad = out->finish(); bad > 0)
    problems.push_back(fmt::format("{} of its densities are negative or no numbers: they count as 0", bad));
  return out;
}

std::unique_ptr<DensityGrid> densityOfFile(const Request& r, Problems& problems) {
  const std::string& type = r.args[0].strings[0];
  if (type.find("openvdb") == std::string::npos)
    throw PrimError(fmt::format("there is no plugin \"{}\"; impl_openvdb is known", type.substr(kPlugin.size())));
  const Param* strings = findParam(r.params, kVolumeStrings);
  if (!strings || strings->strings.size() < 2)
    throw PrimError(fmt::format("it needs \"constant string[2] {}\" with a file and a grid", kVolumeStrings));
  const std::string &file = strings->strings[0], &grid = strings->strings[1];
  if (strings->strings.size() > 2 && !strings->strings[2].empty())
    problems.push_back(fmt::format("the velocities \"{}\" are ignored: it stands still", strings->strings[2]));
  std::string error;
  std::unique_ptr<DensityGrid> out = readVdb(file, grid, boundOf(r), problems, error);
  if (!out) throw PrimError(fmt::format("\"{}\" cannot be used: {}", file, error));
  return out;
}

}  // namespace

PrimPtr volumeBox(const Request& r, const Scope&, Problems& problems) {
  const std::string& type = r.args[0].strings[0];
  if (r.args[2].integers.size() != 3) throw PrimError("it needs three counts of points");
  if (type == "box") return makeVolume(densityOfBox(r, problems), problems);
  if (type.starts_with(kPlugin)) return makeVolume(densityOfFile(r, problems), problems);
  throw PrimError(fmt::format("there is no Volume of type \"{}\"", type));
}

}  // namespace tomales::rib
