#include "reyes/rsl/builtins.h"

#include <algorithm>
#include <map>
#include <regex>

#include "reyes/shader_api.h"

namespace tomales::compiler {
namespace {

struct BuiltinRow {
  /// The declaration as RSL writes it: "result name(types)". T stands for each of float, color, point, vector and
  /// normal in turn, V for each of the four triples, and `any` for every type; `out` marks an argument that is
  /// assigned; ... stands for Builtin::more.
  const char* signature;
  Op op = Op::Copy;
  Emit emit = Emit::Instruction;
  float number = 0;
};

// clang-format off
constexpr BuiltinRow kRows[] = {
    // Mathematics (RISpec 15.1)
    {"float sin(float)", Op::Sin}, {"float cos(float)", Op::Cos}, {"float tan(float)", Op::Tan},
    {"float asin(float)", Op::Asin}, {"float acos(float)", Op::Acos}, {"float atan(float)", Op::Atan},
    {"float atan(float float)", Op::Atan2}, {"float exp(float)", Op::Exp}, {"float log(float)", Op::Log},
    {"float sqrt(float)", Op::Sqrt}, {"float inversesqrt(float)", Op::InverseSqrt}, {"float pow(float float)", Op::Pow},
    {"V pow(V float)", Op::Pow}, {"V pow(V V)", Op::Pow},
    {"float mod(float float)", Op::Mod}, {"T abs(T)", Op::Abs}, {"float sign(float)", Op::Sign},
    {"T floor(T)", Op::Floor}, {"T ceil(T)", Op::Ceil}, {"T round(T)", Op::Round},
    {"float erf(float)", Op::Erf}, {"float erfc(float)", Op::Erfc},
    {"T min(T T ...)", Op::Min, Emit::Fold}, {"T max(T T ...)", Op::Max, Emit::Fold},
    {"T clamp(T T T)", Op::Clamp}, {"T mix(T T float)", Op::Mix}, {"color mix(color color color)", Op::Mix},
    {"float step(float float)", Op::Step}, {"float smoothstep(float float float)", Op::Smoothstep},
    {"float __boxstep(float float float)", Op::Filterstep}, // edge, x, width
    {"T spline(float T ...)", Op::SplineF, Emit::Spline}, {"T spline(string float T ...)", Op::SplineF, Emit::Spline},
    {"T spline(float T[])", Op::SplineF, Emit::Spline}, {"T spline(string float T[])", Op::SplineF, Emit::Spline},
    {"T Du(T)", Op::StepU, Emit::Derivative}, {"T Dv(T)", Op::StepV, Emit::Derivative},
    {"T __stepu(T)", Op::StepU}, {"T __stepv(T)", Op::StepV}, // over a micropolygon, for the prelude
    {"float random()", Op::RandomF}, {"V random()", Op::RandomT}, {"float randomgrid()", Op::RandomGrid},
    // Noise
    {"float noise(float)", Op::Noise1F}, {"float noise(float float)", Op::Noise2F},
    {"float noise(point)", Op::Noise3F}, {"float noise(point float)", Op::Noise4F},
    {"V noise(float)", Op::Noise1T}, {"V noise(float float)", Op::Noise2T},
    {"V noise(point)", Op::Noise3T}, {"V noise(point float)", Op::Noise4T},
    {"float cellnoise(float)", Op::Cell1F}, {"float cellnoise(float float)", Op::Cell2F},
    {"float cellnoise(point)", Op::Cell3F}, {"float cellnoise(point float)", Op::Cell4F},
    {"V cellnoise(float)", Op::Cell1T}, {"V cellnoise(float float)", Op::Cell2T},
    {"V cellnoise(point)", Op::Cell3T}, {"V cellnoise(point float)", Op::Cell4T},
    {"float pnoise(float float)", Op::Pnoise1F}, {"float pnoise(float float float float)", Op::Pnoise2F},
    {"float pnoise(point point)", Op::Pnoise3F}, {"float pnoise(point float point float)", Op::Pnoise4F},
    {"V pnoise(float float)", Op::Pnoise1T}, {"V pnoise(float float float float)", Op::Pnoise2T},
    {"V pnoise(point point)", Op::Pnoise3T}, {"V pnoise(point float point float)", Op::Pnoise4T},
    {"float wnoise(point float)", Op::Wnoise},
    // Geometry (15.2)
    {"float xcomp(V)", Op::Component, Emit::Component, 0}, {"float ycomp(V)", Op::Component, Emit::Component, 1},
    {"float zcomp(V)", Op::Component, Emit::Component, 2}, {"float comp(V float)", Op::Component},
    {"void setxcomp(out V float)", Op::SetComponent, Emit::SetComponent, 0},
    {"void setycomp(out V float)", Op::SetComponent, Emit::SetComponent, 1},
    {"void setzcomp(out V float)", Op::SetComponent, Emit::SetComponent, 2},
    {"void setcomp(out V float float)", Op::SetComponent, Emit::SetComponent, -1},
    {"float length(vector)", Op::Length}, {"V normalize(V)", Op::Normalize},
    {"float ptlined(point point point)", Op::Ptlined}, {"V rotate(V float point point)", Op::RotatePoint},
    {"vector faceforward(vector vector vector)", Op::Faceforward}, {"vector reflect(vector vector)", Op::Reflect},
    {"vector refract(vector vector float)", Op::Refract},
    {"float __reflected(vector vector float)", Op::Fresnel}, // fresnel()'s Kr
    {"normal calculatenormal(point)", Op::CalculateNormal, Emit::Normal},
    {"point transform(string point)", Op::TransformSpace, Emit::Transform, TM_AS_POINT},
    {"point transform(string string point)", Op::TransformSpace, Emit::Transform, TM_AS_POINT},
    {"point transform(matrix point)", Op::TransformPoint},
    {"point transform(string matrix point)", Op::TransformPoint, Emit::Transform, TM_AS_POINT},
    {"point ptransform(string point)", Op::TransformSpace, Emit::Transform, TM_AS_POINT},
    {"point ptransform(string string point)", Op::TransformSpace, Emit::Transform, TM_AS_POINT},
    {"vector vtransform(string vector)", Op::TransformSpace, Emit::Transform, TM_AS_VECTOR},
    {"vector vtransform(string string vector)", Op::TransformSpace, Emit::Transform, TM_AS_VECTOR},
    {"vector vtransform(matrix vector)", Op::TransformVector},
    {"vector vtransform(string matrix vector)", Op::TransformVector, Emit::Transform, TM_AS_VECTOR},
    {"normal ntransform(string normal)", Op::TransformSpace, Emit::Transform, TM_AS_NORMAL},
    {"normal ntransform(string string normal)", Op::TransformSpace, Emit::Transform, TM_AS_NORMAL},
    {"normal ntransform(matrix normal)", Op::TransformNormal},
    {"normal ntransform(string matrix normal)", Op::TransformNormal, Emit::Transform, TM_AS_NORMAL},
    // Colour, matrices, texts, arrays (15.3 to 15.5)
    {"color ctransform(string color)", Op::ColorTransform, Emit::ColorTransform},
    {"color ctransform(string string color)", Op::ColorTransform, Emit::ColorTransform},
    {"float comp(matrix float float)", Op::MatrixElement},
    {"void setcomp(out matrix float float float)", Op::SetMatrixElement, Emit::SetComponent, -1},
    {"float determinant(matrix)", Op::Determinant}, {"matrix translate(matrix vector)", Op::TranslateMatrix},
    {"matrix rotate(matrix float vector)", Op::RotateMatrix}, {"matrix scale(matrix point)", Op::ScaleMatrix},
    {"string concat(string ...)", Op::Concat, Emit::Print}, {"string format(string ...)", Op::Format, Emit::Print},
    {"void printf(string ...)", Op::Print, Emit::Print}, {"float match(string string)", Op::Match},
    {"float arraylength(any[])", Op::Copy, Emit::ArrayLength},
    // Light (15.6)
    {"color ambient()", Op::Ambient}, {"color diffuse(normal)", Op::Diffuse},
    {"color specular(normal vector float)", Op::Specular}, {"float __specularscale()", Op::SpecularScale},
    {"color trace(point vector ...)", Op::Trace, Emit::List},
    {"float trace(point vector ...)", Op::TraceDistance, Emit::List},
    {"color transmission(point point ...)", Op::Transmission, Emit::List},
    {"color visibility(point point ...)", Op::Transmission, Emit::List},
    {"float occlusion(point normal ...)", Op::Occlusion, Emit::Traced},
    {"float occlusion(point normal float ...)", Op::Occlusion, Emit::Traced},
    {"float occlusion(string point normal float ...)", Op::Occlusion, Emit::Traced},
    {"color indirectdiffuse(point normal ...)", Op::IndirectDiffuse, Emit::Traced},
    {"color indirectdiffuse(point normal float ...)", Op::IndirectDiffuse, Emit::Traced},
    {"color indirect(point normal float ...)", Op::IndirectDiffuse, Emit::Traced},
    {"color caustic(point normal)", Op::Caustic},
    {"color photonmap(string point normal ...)", Op::PhotonMap, Emit::List},
    {"color subsurface(point normal ...)", Op::Subsurface, Emit::Traced},
    {"float bake3d(string string point normal ...)", Op::Bake3d, Emit::List},
    {"float texture3d(string point normal ...)", Op::Texture3d, Emit::List},
    // Pictures (15.7). A channel is written texture("file"[2], ...), which the checker reads.
    {"float texture(string ...)", Op::TextureF, Emit::Texture}, {"color texture(string ...)", Op::TextureT, Emit::Texture},
    {"float environment(string vector ...)", Op::EnvironmentF, Emit::Environment},
    {"color environment(string vector ...)", Op::EnvironmentT, Emit::Environment},
    {"float shadow(string point ...)", Op::Shadow, Emit::Shadow}, {"color shadow(string point ...)", Op::Shadow, Emit::Shadow},
    {"float textureinfo(string string out any)", Op::TextureInfo, Emit::Ask},
    // Messages (15.8)
    {"float surface(string out any)", Op::Ask, Emit::Ask, TM_OF_SURFACE},
    {"float displacement(string out any)", Op::Ask, Emit::Ask, TM_OF_DISPLACEMENT},
    {"float atmosphere(string out any)", Op::Ask, Emit::Ask, TM_OF_ATMOSPHERE},
    {"float incident(string out any)", Op::Ask, Emit::Ask, TM_OF_INCIDENT},
    {"float opposite(string out any)", Op::Ask, Emit::Ask, TM_OF_OPPOSITE},
    {"float lightsource(string out any)", Op::Ask, Emit::Ask, TM_OF_LIGHT},
    {"float attribute(string out any)", Op::Ask, Emit::Ask, TM_OF_ATTRIBUTES},
    {"float option(string out any)", Op::Ask, Emit::Ask, TM_OF_OPTIONS},
    {"float rendererinfo(string out any)", Op::Ask, Emit::Ask, TM_OF_RENDERER},
    {"float rayinfo(string out any)", Op::RayInfo, Emit::Ask},
    {"string shadername()", Op::ShaderName, Emit::ShaderName}, {"string shadername(string)", Op::ShaderName, Emit::ShaderName},
    {"string raylabel()", Op::RayLabel},
};
// clang-format on

/// Makes one of the functions that a signature declares: `letter` stands for T or V.
Builtin readingOf(std::string_view signature, Base letter) {
  Builtin out;
  std::string_view rest = signature;
  Slot slot;
  bool first = true;
  while (!rest.empty()) {
    const size_t end = rest.find_first_of(" (),");
    std::string_view word = rest.substr(0, end);
    const char after = end == std::string_view::npos ? ' ' : rest[end];
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (word.empty()) continue;
    if (after == '(') {
      out.name = word;
    } else if (word == "...") {
      out.more = true;
    } else if (word == "out" || word == "output") {
      slot.output = true;
    } else {
      slot.array = word.ends_with("[]");
      if (slot.array) word.remove_suffix(2);
      slot.any = word == "any";
      const Base base = slot.any ? Base::Float : word == "T" || word == "V" ? letter : baseNamed(word).value();
      if (first) {
        out.result = base;
      } else {
        slot.base = base;
        out.slots.push_back(slot);
      }
      first = false;
      slot = {};
    }
  }
  return out;
}

Builtin readingOf(const BuiltinRow& row, Base letter) {
  Builtin out = readingOf(row.signature, letter);
  out.op = row.op;
  out.emit = row.emit;
  out.number = row.number;
  return out;
}

std::vector<Builtin> readAll() {
  std::vector<Builtin> out;
  for (const BuiltinRow& row : kRows) {
    const std::string_view text = row.signature;
    const auto has = [&](const char* letter) {
      return text.starts_with(std::string(letter) + " ") || text.find(std::string("(") + letter) != text.npos ||
             text.find(std::string(" ") + letter) != text.npos;
    };
    if (has("T"))
      for (const Base b : {Base::Float, Base::Color, Base::Point, Base::Vector, Base::Normal})
        out.push_back(readingOf(row, b));
    else if (has("V"))
      for (const Base b : {Base::Color, Base::Point, Base::Vector, Base::Normal}) out.push_back(readingOf(row, b));
    else
      out.push_back(readingOf(row, Base::Float));
  }
  std::stable_sort(out.begin(), out.end(), [](const Builtin& a, const Builtin& b) { return a.name < b.name; });
  return out;
}

}  // namespace

std::optional<Builtin> builtinOf(const TmFunction& function) {
  static const std::regex kForm(
      R"(\s*(void|float|color|point|vector|normal)\s+[A-Za-z_]\w*\s*\((\s*|)"
      R"((\s*(output\s+(float|color|point|vector|normal)|float|color|point|vector|normal|matrix|string)\s*(,(?!\s*\))|(?=\))))*)\)\s*)");
  if (!function.prototype || !function.call || !std::regex_match(function.prototype, kForm)) return {};
  Builtin out = readingOf(function.prototype, Base::Float);
  out.op = Op::Plugin;
  out.emit = Emit::Plugin;
  out.plugin = &function;
  return out;
}

std::span<const Builtin> builtins() {
  static const std::vector<Builtin> table = readAll();
  return table;
}

std::pair<int32_t, int32_t> rowsOf(std::string_view name) {
  const std::span<const Builtin> all = builtins();
  const auto [from, to] = std::equal_range(all.begin(), all.end(), name, [](const auto& a, const auto& b) {
    const auto text = [](const auto& x) -> std::string_view {
      if constexpr (std::is_same_v<std::decay_t<decltype(x)>, Builtin>)
        return x.name;
      else
        return x;
    };
    return text(a) < text(b);
  });
  return {static_cast<int32_t>(from - all.begin()), static_cast<int32_t>(to - from)};
}

}  // namespace tomales::compiler
