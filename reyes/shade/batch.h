// One sub-batch of points (or one grid to displace) while its shader runs; TmGrid::host points to it. One of its
// functions whose names begin with "set" is called, once. Threads: one thread uses it; its BoundScene is shared and
// constant.
#pragma once
#include "reyes/base/crash_note.h"
#include "reyes/grid.h"
#include "reyes/rsl_host.h"
#include "reyes/shade/arena.h"
#include "reyes/shade/bound_scene.h"
#include "reyes/shade/lights.h"
#include "reyes/shade/neighbours.h"

namespace tomales {

struct RemoteBatch;

extern const TmServices kServices;  ///< services.cpp; every function takes a Batch as host.

class Batch {
 public:
  Batch(const BoundScene& scene, const BoundGroup& group, const ShadeContext& context, Arena& arena);
  ~Batch();
  Batch(const Batch&) = delete;

  /// Sets the inputs of a surface or volume shader from points, and its outputs to elements of `out` from `begin` on.
  /// Adds neighbours where the shader wants them and the points have steps.
  void setPoints(ShadePoints& points, const BoundShader& shader, ShadedPoints& out, int begin);
  /// Lets the shader's outputs be stored in `out` from `begin` on. Call it after setPoints().
  void openOutputs(const std::vector<BoundVariable>& variables, ShadedPoints& out, int begin);
  /// Copies the outputs for the points, without neighbours, to `out`. Call it when the shader has run.
  void closeOutputs(const std::vector<BoundVariable>& variables, ShadedPoints& out, int begin);
  /// Sets the inputs and outputs of a displacement shader to motion key 0 of a grid.
  void setGrid(Grid& grid, const BoundShader& shader);

  /// Makes this a copy of the batch `asking`, whose shader asks for light at `moved`, which are its own points at other
  /// positions. Lights then see the surface and the shader of `asking`. `g` has the mask.
  void setRemote(const Batch& asking, const TmGrid* g, const ShadePoints& moved);
  /// Sets the inputs of a light shader to points that nothing shades.
  void setLit(const LightProbe& probe, const BoundShader& shader);
  /// Sets the inputs and outputs of an imager shader.
  void setPixels(ShadedPixels& pixels, const BoundShader& shader);

  /// Computes the change of a value over each micropolygon, along u or v, from its neighbours or from the host's own
  /// knowledge of the value. Returns false and leaves `out` alone if it has neither. Inactive points get arbitrary
  /// values.
  bool stepsOf(const TmGrid* g, bool alongV, const float* value, float* out) const;

  /// Tells whether primitive variables are known. Points in the air of a Volume have none.
  bool hasPrimvars() const;
  /// Returns values of the primitive variables at the points and their neighbours. Pre: hasPrimvars().
  const float* primvar(int offset) const;
  /// Returns the parameters of a shader of the group, including those that primitive variables give. They are valid as
  /// long as the batch.
  const std::vector<TmValue>& valuesOf(const BoundShader& shader);

  /// Calls the shader. Returns false, after a report, if it has thrown.
  bool run(const BoundShader& shader, const TmGrid& tmGrid);
  /// Finds the value of a parameter whose default the shader computes (rslComputesDefault()), at the points of a grid,
  /// whose `params` are the shader's. Returns nothing, after a report, if the shader has thrown, or if the parameter
  /// depends on itself.
  std::optional<RslValue> computed(const BoundShader& shader, int param, const TmGrid& tmGrid);
  /// Makes points where the shader returned NaN or infinity opaque and black, with a warning.
  void blackOutNonFinite(const BoundShader& shader);
  /// Fills in `typeOut` and `out` with numbers (or a text) of that type, which live as long as the batch.
  void answer(const std::vector<float>& numbers, const std::string& text, TmType type, int32_t& typeOut, TmValue& out);
  /// Reports once for each shader and place of request.
  void report(Severity severity, const char* code, const std::string& problem, const std::string& subject = {}) const;

  const BoundScene& scene;
  const BoundGroup& group;
  const ShadeContext& context;
  Arena& arena;
  TmGrid tm{};
  /// The points that are shaded (tm may hold their neighbours as well); null while displacing.
  const ShadePoints* points = nullptr;
  Stencil stencil;             ///< Unset if there are no neighbours.
  const Grid* grid = nullptr;  ///< Null while shading.
  /// The results of the surface at the points, while the atmosphere runs; otherwise null.
  const ShadedPoints* ofSurface = nullptr;
  const BoundShader* running = nullptr;
  /// The shader that the batch has been set for. While lights are evaluated, `running` is another one.
  const BoundShader* own = nullptr;
  Lights lights;
  std::vector<std::unique_ptr<RemoteBatch>> remoteBatches;  ///< The latest first (remote_batch.h).
  int remoteBatchesAsked = 0;                               ///< The number made so far.

  /// The last indirect gather. An indirect light runs once for each colour channel, and asks for the same gather three
  /// times.
  struct Gathered {
    const BoundShader* who = nullptr;
    uint8_t* active = nullptr;
    TmVec3 N, E, dominant[3];
  } gathered;

  /// Borrows memory of the arena for as long as it lives, for example for one of many rays.
  class Scratch {
   public:
    explicit Scratch(Batch& batch) : batch_(batch), mark_(batch.arena.mark()), gathered_(batch.gathered) {}
    ~Scratch() {
      batch_.arena.restore(mark_);
      batch_.gathered = gathered_;
    }
    Scratch(const Scratch&) = delete;

   private:
    Batch& batch_;
    const Arena::Mark mark_;
    const Gathered gathered_;
  };

 private:
  /// Makes the result of valuesOf().
  std::vector<TmValue> laidOut(const BoundShader& shader) const;
  /// Calls `call`, which runs code of the shader. Returns false, after a report, if it has thrown.
  bool guarded(const BoundShader& shader, const std::function<void()>& call);
  void setCommon(int count, const BoundShader& shader);
  /// Sets the inputs that primitive variables may give. Call it when points or grid is set.
  void setVariables();
  CrashNote::Text crashText() const;
  TmConstVec3 constant(const vec3& v);
  TmConstVec3 velocity();
  bool hasNeighbours() const { return points && tm.count > points->count(); }
  std::vector<TmValue> params_;
  std::optional<Widened> wide_;
  std::deque<std::string> answers_;
  std::map<const BoundShader*, std::vector<TmValue>> values_;     ///< The results of valuesOf().
  std::vector<std::pair<const BoundShader*, int>> computingNow_;  ///< Parameters that computed() is finding.
};

/// Returns the default options, overwritten by the caller's fields. The caller's struct begins with structBytes, which
/// shows how many fields its release has. `given` may be null.
template <class Options>
Options givenOptions(const Batch& batch, Options options, const Options* given) {
  if (given && given->structBytes < sizeof given->structBytes)
    batch.report(Severity::Missing, "shader-options",
                 "gives options whose structBytes is 0, which no function of defaults has made; the defaults count");
  else if (given)
    std::copy_n(reinterpret_cast<const char*>(given), std::min<size_t>(given->structBytes, sizeof options),
                reinterpret_cast<char*>(&options));
  return options;
}

}  // namespace tomales
