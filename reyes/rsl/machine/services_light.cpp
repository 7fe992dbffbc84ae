// Light (RISpec 15.6).
#include <cmath>
#include <cstring>
#include <numbers>
#include <optional>

#include "reyes/rsl/globals.h"
#include "reyes/rsl/machine/lists.h"
#include "reyes/shader.h"

namespace tomales::compiler {
namespace {

void ambient(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  call.services.ambient(call.host, call.g, call.giveTriple());
}

void diffuse(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  call.services.diffuse(call.host, call.g, TM_ALL_LIGHT, call.triple(0), call.giveTriple());
}

void specular(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  call.services.specular(call.host, call.g, call.triple(0), call.triple(1), call.number(2), call.giveTriple());
}

/// Asks for what specular() divides by the roughness to get its exponent, as sl::specularScale().
void specularScale(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  if (run.specularScale == 0) {
    int32_t type = 0;
    TmValue v{};
    const bool told =
        call.services.ask(call.host, call.g, TM_OF_OPTIONS, -1, "shade:specular", &type, &v) && type == TM_STRING;
    run.specularScale = told && std::strcmp(v.string, "rispec") == 0 ? 1.0f : 8.0f;
  }
  call.set(run.specularScale);
}

void assign(Run& run, int32_t r, TmConstVec3 from) {
  if (r < 0) return;
  Lanes& l = run.lanes[r];
  // A register that nothing else writes can use the service's arrays.
  if (l.block != 0 && run.program.located(r).once && useArrays(l, 3, from.x, from.y, from.z)) return;
  const float* const c[3] = {from.x, from.y, from.z};
  for (ptrdiff_t k = 0; k < 3; ++k)
    if (l.block != 0)
      copyWhere(run.padded, run.mask->on, c[k], l.data + k * l.component);
    else
      std::fill_n(l.data + k * l.component, kBlock, c[k][run.firstActive()]);
}

/// Copies the parameters and outputs of a light that the list asks for to their registers.
void tellOfLight(Run& run, const std::vector<rsl::LightList::Wanted>& wanted) {
  for (const rsl::LightList::Wanted& w : wanted) {
    int32_t type = 0;
    TmValue v{};
    if (run.grid.call->ask(run.grid.host, run.asking(), TM_OF_LIGHT, run.light, w.name.c_str(), &type, &v))
      fill(run, w.into.target, type, v);
  }
}

bool isUntouchedP(const Run& run, int32_t r) {
  const Located& l = run.program.located(r);
  return l.global == static_cast<int32_t>(Global::P) && !l.assigned;
}

/// Fills in the query from the category, P, axis and angle of the instruction.
void ask(Call& call, const std::string& category, TmIlluminance& query) {
  Run& run = call.run;
  query.category = category.c_str();
  // A volume that gives a P asks in the air, wherever P is (TmIlluminance::P).
  const bool inAir = run.program.code().kind == ShaderKind::Volume;
  const bool own = call.has(1) && !inAir && isUntouchedP(run, call.of.in[1]);
  if (call.has(1) && !own) query.P = call.copied(1);
  if (call.has(2)) query.axis = call.copied(2);
  if (!call.has(3)) return;
  if (run.varies(call.of.in[3])) {
    float* const angles = run.memory.floats(static_cast<size_t>(run.padded));
    query.angles = std::copy_n(call.number(3), run.padded, angles) - run.padded;
  } else {
    query.angle = *run.lane(call.of.in[3]).data;
  }
}

void runLit(Run& run, const PreparedInstruction& s, const TmIlluminance& sample, const rsl::LightList& list,
            uint8_t* lit) {
  if (!both(run.padded, sample.lit, run.mask->on, lit)) return;
  const bool all = std::memcmp(lit, run.mask->on, static_cast<size_t>(run.padded)) == 0;
  std::optional<Narrowed> inner;
  if (!all) inner.emplace(run, lit);
  assign(run, s.of->out[0], sample.L);
  assign(run, s.of->out[1], sample.Cl);
  run.light = sample.light;
  tellOfLight(run, list.wanted);
  execute(run, s.blocks[0]);
}

void illuminance(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const std::string category = call.has(0) ? call.text(0) : "";
  TmIlluminance query = tmIlluminanceDefaults();
  ask(call, category, query);
  rsl::LightList list;
  list.padded = run.padded;
  list = listed(call, std::move(list));
  const std::vector<TmMessage> sent = list.messages();
  query.sent = sent.data();
  query.sentCount = static_cast<int32_t>(sent.size());
  query.refresh = list.refresh;
  // The mask must stay the same until there are no more samples, even if points leave the loop.
  const auto n = static_cast<size_t>(run.padded);
  uint8_t *const asked = run.memory.bytes(n), *const lit = run.memory.bytes(n);
  std::copy_n(run.mask->on, n, asked);
  const int32_t outer = run.light;
  while (run.mask->any) {
    run.grid.active = asked;
    if (!call.services.illuminance(call.host, &run.grid, &query)) break;
    runLit(run, s, query, list, lit);
  }
  run.light = outer;
}

/// Applies a kernel of one number to the batch.
void apply(Run& run, Op op, float* in, float* out) {
  const Lanes from{in, kBlock, 0}, to{out, kBlock, 0};
  kernelOf(op)(run.blocks, to, &from);
}

/// Gives a direction in a cone: uniform over its solid angle if the host gives random numbers, otherwise the axis
/// (sl::solar()).
void coneLight(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const TmConstVec3 axis = call.triple(0);
  const float* const angle = call.number(1);
  const TmVec3 out = call.giveTriple();
  const auto n = static_cast<size_t>(run.padded);
  if (!run.grid.xi0) {
    std::copy_n(axis.x, n, out.x);
    std::copy_n(axis.y, n, out.y);
    std::copy_n(axis.z, n, out.z);
    return;
  }
  float *const turn = run.memory.floats(n), *const cosine = run.memory.floats(n), *const x = run.memory.floats(n),
               *const y = run.memory.floats(n);
  for (size_t i = 0; i < n; ++i) turn[i] = angle[i];
  apply(run, Op::Cos, turn, cosine);
  for (size_t i = 0; i < n; ++i)
    turn[i] = 2 * std::numbers::pi_v<float> * run.grid.xi1[std::min<size_t>(i, static_cast<size_t>(run.count) - 1)];
  apply(run, Op::Cos, turn, x);
  apply(run, Op::Sin, turn, y);
  for (int32_t i = 0; i < run.count; ++i) {
    const float z = 1 - run.grid.xi0[i] * (1 - cosine[i]), r = std::sqrt(std::max(0.0f, 1 - z * z));
    const rsl::Vec3 along = rsl::normalize(rsl::get(axis, i));
    rsl::Vec3 tangent, bitangent;
    rsl::orthonormalBasis(along, tangent, bitangent);
    if (run.mask->on[i]) rsl::set(out, i, r * x[i] * tangent + r * y[i] * bitangent + z * along);
  }
}

/// Reverses the host's direction, because RSL's L points from the light.
void skyLight(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const TmVec3 out = call.giveTriple();
  const TmVec3& L = run.given.L;
  for (int32_t i = 0; i < run.count; ++i)
    if (run.mask->on[i]) rsl::set(out, i, -rsl::get(L, i));
}

void shadow(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const TmShadowOptions options = listed(call, tmShadowDefaults());
  call.services.shadow(call.host, call.g, call.text(0), &options, call.triple(1), call.giveTriple());
}

constexpr Row kLightRows[] = {{Op::Ambient, ambient},         {Op::Diffuse, diffuse},
                              {Op::Specular, specular},       {Op::SpecularScale, specularScale},
                              {Op::Illuminance, illuminance}, {Op::ConeLight, coneLight},
                              {Op::SkyLight, skyLight},       {Op::Shadow, shadow}};

}  // namespace

std::span<const Row> lightRows() { return kLightRows; }

}  // namespace tomales::compiler
