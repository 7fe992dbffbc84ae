// One chunk of points (or one grid to displace) while its shader runs: what TmGrid::host points to.
// Threads: used by one; its BoundScene is shared and constant.
#pragma once
#include "reyes/grid.h"
#include "reyes/shade/arena.h"
#include "reyes/shade/bound_scene.h"
#include "reyes/shade/lights.h"

namespace tomales {

extern const TmServices kServices;  ///< services.cpp; every function takes a Batch as host.

class Batch {
 public:
  Batch(const BoundScene& scene, const BoundGroup& group, const ShadeContext& context, Arena& arena);
  Batch(const Batch&) = delete;

  /// Inputs of a surface shader from points, outputs of `count` floats from element `begin`.
  void setPoints(ShadePoints& points, const BoundShader& shader, const std::vector<Override>& overrides,
                 ShadedPoints& out, int begin);
  /// After setPoints: the shader's outputs are stored in `out` from `begin`.
  void openOutputs(const std::vector<BoundVariable>& variables, ShadedPoints& out, int begin) {
    tomales::openOutputs(variables, out, begin, params_);
  }
  /// Inputs and outputs of a displacement shader: motion key 0 of a grid.
  void setGrid(Grid& grid, const BoundShader& shader, const std::vector<Override>& overrides);

  /// Inputs and outputs of an imager shader.
  void setPixels(ShadedPixels& pixels, const BoundShader& shader);

  /// Calls the shader. False: it threw, which has been reported.
  bool run(const BoundShader& shader, const TmGrid& tmGrid);
  /// Points where the shader returned NaN or infinity become opaque and black, with a warning.
  void blackOutNonFinite(const BoundShader& shader);
  /// Once per shader and place of request.
  void report(Severity severity, const char* code, const std::string& problem) const;

  const BoundScene& scene;
  const BoundGroup& group;
  const ShadeContext& context;
  Arena& arena;
  TmGrid tm{};
  const ShadePoints* points = nullptr;  ///< Null while displacing.
  const Grid* grid = nullptr;           ///< Null while shading.
  const BoundShader* running = nullptr;
  Lights lights;

  /// The last indirect gather: an indirect light runs once a colour channel and asks for the same three
  /// times.
  struct {
    const BoundShader* who = nullptr;
    uint8_t* active = nullptr;
    TmVec3 N, E, dominant[3];
  } gathered;

 private:
  void setCommon(int count, const BoundShader& shader, const std::vector<Override>& overrides,
                 const std::function<const float*(int offset)>& primvar);
  TmConstVec3 constant(const vec3& v);
  std::vector<TmValue> params_;
};

inline TmConstVec3 view(TmVec3 v) { return {v.x, v.y, v.z}; }
inline vec3 get(TmConstVec3 a, int i) { return {a.x[i], a.y[i], a.z[i]}; }
inline vec3 get(TmVec3 a, int i) { return {a.x[i], a.y[i], a.z[i]}; }
inline void set(TmVec3 a, int i, const vec3& v) { a.x[i] = v.x, a.y[i] = v.y, a.z[i] = v.z; }

}  // namespace tomales
