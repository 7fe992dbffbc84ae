#include "reyes/area_lights.h"

#include <algorithm>
#include <vector>

#include "reyes/base/search_path.h"
#include "reyes/dialect.h"
#include "reyes/shade/binder.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

constexpr int kSteps = 32;          ///< Steps along each edge of a patch, which give a sphere's area to a thousandth.
constexpr int kPartsOfTrimmed = 4;  ///< Places along each edge of a polygon that are looked up in trim curves.

/// Returns the share of a polygon of the lattice that trim curves keep.
double keptShare(const Prim& shape, uint32_t patch, int column, int row) {
  const auto at = [](int step, float part) { return (static_cast<float>(step) + part) / kSteps; };
  const Kept kept = shape.kept(patch, {at(column, 0), at(column, 1), at(row, 0), at(row, 1)});
  if (kept != Kept::Part) return kept == Kept::All ? 1 : 0;
  int count = 0;
  for (int k = 0; k < kPartsOfTrimmed * kPartsOfTrimmed; ++k) {
    const auto part = [](int i) { return (static_cast<float>(i) + 0.5f) / kPartsOfTrimmed; };
    count += shape.keeps(patch, at(column, part(k % kPartsOfTrimmed)), at(row, part(k / kPartsOfTrimmed)));
  }
  return static_cast<double>(count) / (kPartsOfTrimmed * kPartsOfTrimmed);
}

/// Sums the areas that remain of the polygons of a lattice over the patch, in camera space.
double areaOf(const Prim& shape, uint32_t patch, const mat4& cameraFromObject) {
  constexpr int kRow = kSteps + 1, kPoints = kRow * kRow;
  std::vector<float> u(kPoints), v(kPoints), points(size_t{12} * kPoints);
  for (int k = 0; k < kPoints; ++k) {
    u[static_cast<size_t>(k)] = static_cast<float>(k % kRow) / kSteps;
    v[static_cast<size_t>(k)] = static_cast<float>(k / kRow) / kSteps;
  }
  float* const p = points.data();
  const auto field = [p](int k) { return p + k * kPoints; };
  const SurfacePoints out{field(0), field(1), field(2), field(3), field(4),  field(5),
                          field(6), field(7), field(8), field(9), field(10), field(11)};
  shape.evaluate(patch, kPoints, u.data(), v.data(), out);
  const auto at = [&](int k) { return transformPoint(cameraFromObject, {out.px[k], out.py[k], out.pz[k]}); };
  double sum = 0;
  for (int row = 0; row < kSteps; ++row)
    for (int column = 0; column < kSteps; ++column) {
      const int k = row * kRow + column;
      sum += keptShare(shape, patch, column, row) * 0.5 *
             static_cast<double>(length(cross(at(k + kRow + 1) - at(k), at(k + kRow) - at(k + 1))));
    }
  return sum;
}

double areaOf(const Scene& scene, int light) {
  double sum = 0;
  for (const Object& object : scene.objects) {
    if (object.attributes->areaLight != light) continue;
    const mat4 cameraFromObject = object.cameraFromObject.at(scene.options.shutterOpen);
    for (uint32_t patch = 0; !object.shapes.empty() && patch < object.shapes.front()->patchCount(); ++patch)
      sum += areaOf(*object.shapes.front(), patch, cameraFromObject);
  }
  return sum;
}

/// Returns null if the light's shader takes no area, or if the scene gives it.
const TmParamDecl* parameterOfArea(const ShaderCall& call, const std::string& path, ShaderRegistry& registry) {
  const ShaderName name = nameOf(call, TM_LIGHT);
  const TmShader* shader = registry.find(name.name, name.kind, path, name.beside);
  if (!shader) return nullptr;
  const TmParamDecl* const end = shader->params + shader->paramCount;
  const TmParamDecl* area =
      std::find_if(shader->params, end, [](const TmParamDecl& p) { return p.role == TM_ROLE_AREA; });
  return area == end || findParam(call.params, area->name) ? nullptr : area;
}

}  // namespace

void measureAreaLights(Scene& scene, ShaderRegistry& registry, Log& log) {
  const std::string convention = wordOf(scene.options.user, "shade:arealight");
  const bool guessed = convention.empty() && isMadeForBmrt(scene);
  if (convention != "bmrt" && !guessed) return;
  const std::string path = pathOf(scene.options.searchPaths, "shader");
  for (std::shared_ptr<LightCall>& light : scene.lights) {
    const TmParamDecl* taken = light->area ? parameterOfArea(light->shader, path, registry) : nullptr;
    const double area = taken ? areaOf(scene, light->index) : 0;
    if (!(area > 0)) continue;
    auto measured = std::make_shared<LightCall>(*light);
    Param p;
    p.name = taken->name;
    p.floats = {static_cast<float>(area)};
    measured->shader.params.push_back(std::move(p));
    light = std::move(measured);
    if (guessed)
      log.report(
          Severity::Note, "scene-bmrt", scene.where,
          "the scene has options or attributes of BMRT's (\"render\", \"radiosity\"): the light of arealight falls "
          "off with the square of the distance (--arealight radiance)");
  }
}

}  // namespace tomales
