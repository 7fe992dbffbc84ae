// One chunk of points (or one grid to displace) while its shader runs: what TmGrid::host points to.
// Threads: used by one; its BoundScene is shared and constant.
#pragma once
#include "reyes/base/crash_note.h"
#include "reyes/grid.h"
#include "reyes/shade/arena.h"
#include "reyes/shade/bound_scene.h"
#include "reyes/shade/lights.h"
#include "reyes/shade/neighbours.h"

namespace tomales {

struct Elsewhere;

extern const TmServices kServices;  ///< services.cpp; every function takes a Batch as host.

class Batch {
 public:
  Batch(const BoundScene& scene, const BoundGroup& group, const ShadeContext& context, Arena& arena);
  ~Batch();
  Batch(const Batch&) = delete;

  /// Inputs of a surface or volume shader from points, outputs of `count` floats from element `begin`. Adds neighbours
  /// where the shader wants them and the points have steps.
  void setPoints(ShadePoints& points, const BoundShader& shader, const std::vector<Override>& overrides,
                 ShadedPoints& out, int begin);
  /// After setPoints: the shader's outputs are stored in `out` from `begin`.
  void openOutputs(const std::vector<BoundVariable>& variables, ShadedPoints& out, int begin);
  /// After the shader has run: what it has left for the points, without neighbours, is in `out`.
  void closeOutputs(const std::vector<BoundVariable>& variables, ShadedPoints& out, int begin);
  /// Inputs and outputs of a displacement shader: motion key 0 of a grid.
  void setGrid(Grid& grid, const BoundShader& shader, const std::vector<Override>& overrides);

  /// As a batch whose shader asks for light at `moved`, of its own points: what lights see of the surface and its
  /// shader. `g` has the mask.
  void setElsewhere(const Batch& asking, const TmGrid* g, const ShadePoints& moved);
  /// Inputs of a light shader: points that nothing shades.
  void setLit(const LightProbe& probe, const BoundShader& shader);
  /// Inputs and outputs of an imager shader.
  void setPixels(ShadedPixels& pixels, const BoundShader& shader);

  /// How a value changes over each micropolygon, along u or v: by the neighbours, or because the host knows the value.
  /// False: it does not, and `out` is left alone. Inactive points hold anything.
  bool stepsOf(const TmGrid* g, bool alongV, const float* value, float* out) const;

  /// Calls the shader. False: it threw, which has been reported.
  bool run(const BoundShader& shader, const TmGrid& tmGrid);
  /// Points where the shader returned NaN or infinity become opaque and black, with a warning.
  void blackOutNonFinite(const BoundShader& shader);
  /// Fills in a value that lives as long as the batch: `type` is what the numbers (or the text) are.
  void answer(const std::vector<float>& numbers, const std::string& text, TmType type, int32_t& typeOut, TmValue& out);
  /// Once per shader and place of request.
  void report(Severity severity, const char* code, const std::string& problem, const std::string& subject = {}) const;

  const BoundScene& scene;
  const BoundGroup& group;
  const ShadeContext& context;
  Arena& arena;
  TmGrid tm{};
  const ShadePoints* points =
      nullptr;                 ///< Null while displacing. Those that are shaded: tm may hold their neighbours as well.
  Stencil stencil;             ///< Unset: no neighbours.
  const Grid* grid = nullptr;  ///< Null while shading.
  const BoundShader* running = nullptr;
  const BoundShader* own =
      nullptr;  ///< What the batch has been set for; `running` is another while lights are evaluated.
  Lights lights;
  std::vector<std::unique_ptr<Elsewhere>> elsewhere;  ///< The latest first (elsewhere.h).
  int placesAsked = 0;                                ///< Of them.

  /// The last indirect gather: an indirect light runs once a colour channel and asks for the same three
  /// times.
  struct Gathered {
    const BoundShader* who = nullptr;
    uint8_t* active = nullptr;
    TmVec3 N, E, dominant[3];
  } gathered;

  /// For as long as it lives, memory of the arena is borrowed: for what one of many rays needs.
  class Scratch {
   public:
    explicit Scratch(Batch& batch) : batch_(batch), mark_(batch.arena.mark()), gathered_(batch.gathered) {}
    ~Scratch() { batch_.arena.restore(mark_), batch_.gathered = gathered_; }
    Scratch(const Scratch&) = delete;

   private:
    Batch& batch_;
    const Arena::Mark mark_;
    const Gathered gathered_;
  };

 private:
  void setCommon(int count, const BoundShader& shader, const std::vector<Override>& overrides,
                 const std::function<const float*(int offset)>& primvar);
  CrashNote::Text crashText() const;
  TmConstVec3 constant(const vec3& v);
  TmConstVec3 velocity();
  bool hasNeighbours() const { return points && tm.count > points->count(); }
  std::vector<TmValue> params_;
  std::optional<Widened> wide_;
  std::deque<std::string> answers_;
};

/// The defaults, but for what a caller gives of an options struct that begins with structBytes: as many fields as its
/// release knows of. Null: none.
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

inline TmConstVec3 view(TmVec3 v) { return {v.x, v.y, v.z}; }
inline vec3 get(TmConstVec3 a, int i) { return {a.x[i], a.y[i], a.z[i]}; }
inline vec3 get(TmVec3 a, int i) { return {a.x[i], a.y[i], a.z[i]}; }
inline void set(TmVec3 a, int i, const vec3& v) { a.x[i] = v.x, a.y[i] = v.y, a.z[i] = v.z; }

}  // namespace tomales
