// The instructions of a compiled shader: one table, from which the checker's constants, the dumps, the passes and the
// machine read the operands and results of an instruction.
#pragma once
#include <cstdint>
#include <string_view>

namespace tomales::compiler {

// The columns are name, signature, traits.
// Signature: results, '=', operands.
//   f: number, t: triple, m: matrix, s: text, a: array
//   *: a number, triple or matrix, componentwise. All stars of one instruction have the shape of its result, or are
//      numbers, which stand for every component.
// Traits:
//   P  pure: the same inputs give the same outputs, so it may be shared, moved or left out. It runs over all points,
//      active or not, so it must not fail for any values.
//   K  a kernel (kernels.h) does it; without K the machine does.
// clang-format off
#define RSL_OPS(OP)                                                                                                  \
  /* Arithmetic. Comparisons give 1 or 0. */                                                                         \
  OP(Add, "*=**", "PK") OP(Sub, "*=**", "PK") OP(Mul, "*=**", "PK") OP(Div, "*=**", "PK") OP(Neg, "*=*", "PK")       \
  OP(Less, "f=ff", "PK") OP(LessEqual, "f=ff", "PK") OP(Equal, "f=ff", "PK") OP(NotEqual, "f=ff", "PK")              \
  OP(And, "f=ff", "PK") OP(Or, "f=ff", "PK") OP(Not, "f=f", "PK") OP(Select, "*=f**", "PK")                          \
  /* Mathematics (RISpec 15.1) */                                                                                    \
  OP(Min, "*=**", "PK") OP(Max, "*=**", "PK") OP(Clamp, "*=***", "PK") OP(Mix, "*=***", "PK")                        \
  OP(Step, "*=**", "PK") OP(Smoothstep, "*=***", "PK") OP(Filterstep, "f=fff", "PK") /* edge, x, width */            \
  OP(Abs, "*=*", "PK") OP(Sign, "*=*", "PK") OP(Floor, "*=*", "PK") OP(Ceil, "*=*", "PK") OP(Round, "*=*", "PK")     \
  OP(Mod, "*=**", "PK") OP(Sqrt, "*=*", "PK") OP(InverseSqrt, "*=*", "PK") OP(Exp, "*=*", "PK") OP(Log, "*=*", "PK") \
  OP(Pow, "*=**", "PK") OP(Sin, "*=*", "PK") OP(Cos, "*=*", "PK") OP(Tan, "*=*", "PK") OP(Asin, "*=*", "PK")         \
  OP(Acos, "*=*", "PK") OP(Atan, "*=*", "PK") OP(Atan2, "*=**", "PK") OP(Erf, "*=*", "PK") OP(Erfc, "*=*", "PK")     \
  /* Triples (RISpec 15.2) */                                                                                        \
  OP(MakeTriple, "t=fff", "PK") OP(Component, "f=tf", "PK") /* of a number that is held to 0..2 */                   \
  OP(SetComponent, "t=tff", "PK")                           /* the triple, which component, its value */             \
  OP(Dot, "f=tt", "PK") OP(Cross, "t=tt", "PK") OP(Length, "f=t", "PK") OP(Normalize, "t=t", "PK")                   \
  OP(Reflect, "t=tt", "PK") OP(Refract, "t=ttf", "PK") OP(Faceforward, "t=ttt", "PK") OP(Fresnel, "f=ttf", "PK")     \
  OP(Ptlined, "f=ttt", "PK") OP(RotatePoint, "t=tftt", "PK") OP(TripleEqual, "f=tt", "PK")                           \
  /* Noise (RISpec 15.1): F gives a number, T a triple; of 1, 2 numbers, a place, a place and a time. */             \
  OP(Noise1F, "f=f", "PK") OP(Noise2F, "f=ff", "PK") OP(Noise3F, "f=t", "PK") OP(Noise4F, "f=tf", "PK")              \
  OP(Noise1T, "t=f", "PK") OP(Noise2T, "t=ff", "PK") OP(Noise3T, "t=t", "PK") OP(Noise4T, "t=tf", "PK")              \
  OP(Cell1F, "f=f", "PK") OP(Cell2F, "f=ff", "PK") OP(Cell3F, "f=t", "PK") OP(Cell4F, "f=tf", "PK")                  \
  OP(Cell1T, "t=f", "PK") OP(Cell2T, "t=ff", "PK") OP(Cell3T, "t=t", "PK") OP(Cell4T, "t=tf", "PK")                  \
  OP(Pnoise1F, "f=ff", "PK") OP(Pnoise2F, "f=ffff", "PK") OP(Pnoise3F, "f=tt", "PK") OP(Pnoise4F, "f=tftf", "PK")    \
  OP(Pnoise1T, "t=ff", "PK") OP(Pnoise2T, "t=ffff", "PK") OP(Pnoise3T, "t=tt", "PK") OP(Pnoise4T, "t=tftf", "PK")    \
  OP(Wnoise, "f=tf", "PK")                                                                                           \
  /* How Noise3F changes along a direction: its gradient . direction. Likewise each component of Noise3T. */         \
  OP(Slope3F, "f=tt", "PK") OP(Slope3T, "t=tt", "PK")                                                                \
  /* Matrices (RISpec 15.4) */                                                                                       \
  OP(MatrixOf, "m=f", "PK") /* the number on the diagonal */                                                         \
  OP(MakeMatrix, "m=ffffffffffffffff", "PK") OP(MatrixProduct, "m=mm", "PK") OP(MatrixInverse, "m=m", "PK")          \
  OP(Determinant, "f=m", "PK") OP(TranslateMatrix, "m=mt", "PK") OP(RotateMatrix, "m=mft", "PK")                     \
  OP(ScaleMatrix, "m=mt", "PK") OP(TransformPoint, "t=mt", "PK") OP(TransformVector, "t=mt", "PK")                   \
  OP(TransformNormal, "t=mt", "PK") OP(MatrixElement, "f=mff", "PK") OP(SetMatrixElement, "m=mfff", "PK")            \
  OP(MatrixEqual, "f=mm", "PK")                                                                                      \
  /* What needs texts or many knots: the machine does them. */                                                       \
  OP(ColorTransform, "t=sst", "P")  /* from, to */                                                                   \
  OP(SplineF, "f=sf...", "P")       /* basis, value, knots: numbers, or one array */                                 \
  OP(SplineT, "t=sf...", "P")                                                                                        \
  OP(TextEqual, "f=ss", "P") OP(Concat, "s=s...", "P") OP(Match, "f=ss", "P") OP(Format, "s=s...", "P")              \
  OP(ElementF, "f=af", "P") OP(ElementT, "t=af", "P") OP(ElementM, "m=af", "P") OP(ElementS, "s=af", "P")        \
  /* array, index held to its bounds; out of bounds is reported once */                                              \
  OP(SetElement, "a=f*", "")        /* array; index, value: active points alone */                                   \
  OP(Copy, "*=*", "")               /* active points alone; of texts and whole arrays too */                         \
  /* The surface. A step is the change over one micropolygon along u or v. */                                        \
  OP(StepU, "*=*", "P") OP(StepV, "*=*", "P")                                                                        \
  OP(CalculateNormal, "t=t", "")                                                                                     \
  OP(TransformSpace, "t=sst", "") /* from, to; extra: TmTransformKind */                                             \
  OP(SpaceMatrix, "m=ss", "")     /* maps points from, to */                                                         \
  OP(RandomF, "f=", "") OP(RandomT, "t=", "") OP(RandomGrid, "f=", "")                                               \
  /* Light. -1 stands for an argument that is left out. */                                                           \
  OP(Ambient, "t=", "") OP(Diffuse, "t=t", "") OP(Specular, "t=ttf", "") OP(SpecularScale, "f=", "")                 \
  OP(Illuminance, "tt=sttf", "") /* L, Cl = category, P, axis, angle; settings; body */                              \
  OP(ConeLight, "t=tf", "")      /* a direction in the cone around an axis, half angle: TM_LIGHT_SAMPLED */          \
  OP(SkyLight, "t=", "")         /* gives L, which the host has chosen: TM_LIGHT_SKY */                                       \
  OP(IndirectDiffuse, "t=ttf", "") OP(Occlusion, "f=ttf", "") /* P, N, samples; settings */                          \
  OP(Shadow, "t=st", "")         /* name, P; settings */                                                             \
  OP(Trace, "t=tt", "") OP(TraceDistance, "f=tt", "") OP(Transmission, "t=tt", "") /* P, direction | target */       \
  OP(Gather, "=sttff", "")       /* category, P, direction, angle, samples; settings; body, other */                 \
  /* Pictures: name, first channel, s, t, and the two sides of a region, s and t of each: -1 none. */                \
  OP(TextureF, "f=sfffffff", "") OP(TextureT, "t=sfffffff", "")                                                      \
  OP(EnvironmentF, "f=sftf", "") OP(EnvironmentT, "t=sftf", "") /* name, channel, direction, angle or -1 */          \
  OP(TextureInfo, "f=ss", "")    /* name, what; settings: the one that is filled in */                               \
  /* Point clouds */                                                                                                 \
  OP(Bake3d, "f=sstt", "") OP(Texture3d, "f=stt", "") OP(PhotonMap, "t=stt", "") OP(Caustic, "t=tt", "")             \
  OP(Subsurface, "t=stt", "")                                                                                        \
  /* Messages; extra: TmWhom. Settings: the one that is filled in. ShaderName: of "surface", "light", ... */           \
  OP(Ask, "f=s", "") OP(ShaderName, "s=s", "") OP(RayInfo, "f=s", "") OP(RayLabel, "s=", "")                          \
  OP(Print, "=s...", "")                                                                                             \
  OP(Plugin, "=*...", "")        /* result, if any, outputs = arguments; extra: index in Code::plugins */          \
  OP(Report, "=s", "") /* TM_MISSING, once: what the shader needs and nobody has */                                  \
  /* Structure (code.h) */                                                                                           \
  OP(If, "=f", "")      /* body, other */                                                                            \
  OP(Loop, "=f", "")    /* blocks: condition, which leaves its result in the register; body; step */                 \
                        /* extra: a label. What leaves it ends the loop, what leaves extra + 1 goes on with step */    \
  OP(Scope, "=", "")    /* body. extra: a label, which Leave may leave */                                              \
  OP(Leave, "=", "")    /* extra: a label that is open. Active points are out until what has it ends */
// clang-format on

enum class Op : uint8_t {
#define RSL_OP(name, signature, traits) name,
  RSL_OPS(RSL_OP)
#undef RSL_OP
};

struct OpInfo {
  Op op;
  std::string_view name, signature, traits;
  bool pure() const { return traits.find('P') != std::string_view::npos; }
  bool kernel() const { return traits.find('K') != std::string_view::npos; }
  bool componentwise() const { return signature.find('*') != std::string_view::npos; }
};
const OpInfo& info(Op op);
constexpr int kOps = static_cast<int>(Op::Leave) + 1;

}  // namespace tomales::compiler
