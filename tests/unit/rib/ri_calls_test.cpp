// The C binding says what the RIB says.
#include "reyes/rib/ri_calls.h"

#include "reyes/prim_factories.h"
#include "rib_test_tools.h"

namespace tomales {
namespace {

using rib::RiCall;

struct Calls {
  std::vector<RiCall> list;
  Log log{Log::Verbosity::Quiet};
  explicit Calls(const std::function<void()>& program) { rib::recordRiCalls({}, log, program, list); }
};

/// C has to know how many values there are; in RIB they are counted, and the length may be left open (0).
ParamList withLengths(ParamList params) {
  for (Param& p : params) p.arrayLength = std::max(1, p.arrayLength);
  return params;
}

void expectSays(const Calls& calls, const std::string& text) {
  const Requests r(text);
  ASSERT_TRUE(r.log.entries().empty()) << r.log.entries()[0].message;
  ASSERT_TRUE(calls.log.entries().empty()) << calls.log.entries()[0].message;
  ASSERT_EQ(calls.list.size(), r.list.size());
  for (size_t i = 0; i < r.list.size(); ++i) {
    const Request &a = calls.list[i].request, &b = r.list[i];
    SCOPED_TRACE(b.name);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.params, withLengths(b.params));
    ASSERT_EQ(a.args.size(), b.args.size());
    for (size_t k = 0; k < a.args.size(); ++k) {
      EXPECT_EQ(a.args[k].kind, b.args[k].kind) << k;
      EXPECT_EQ(a.args[k].numbers, b.args[k].numbers) << k;
      EXPECT_EQ(a.args[k].integers, b.args[k].integers) << k;
      EXPECT_EQ(a.args[k].strings, b.args[k].strings) << k;
    }
  }
}

TEST(RiCalls, SayAttributesAndTransformations) {
  const Calls calls([] {
    RtFloat red[] = {1, 0, 0}, roughness = .25f, bias = 1;
    RtString map = "a.tex";
    RtMatrix m = {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}, {13, 14, 15, 16}};
    RiAttributeBegin();
    RiDeclare("bump", "uniform float[2]");
    RiAttribute("displacementbound", "sphere", &bias, RI_NULL);
    RiColor(red);
    RtFloat bump[] = {3, 4};
    RiSurface("paintedplastic", "roughness", &roughness, "texturename", &map, "bump", bump, RI_NULL);
    RiSides(1);
    RiMatte(RI_TRUE);
    RiTransform(m);
    RiRotate(30, 0, 0, 1);
    RiMotionBegin(2, 0.0, 0.5);
    RiTranslate(1, 2, 3);
    RiTranslate(1, 2, 4);
    RiMotionEnd();
    RiAttributeEnd();
  });
  expectSays(
      calls,
      "AttributeBegin Declare \"bump\" \"uniform float[2]\" Attribute \"displacementbound\" \"sphere\" 1 Color 1 0 0\n"
      "Surface \"paintedplastic\" \"roughness\" .25 \"texturename\" \"a.tex\" \"uniform float[2] bump\" [3 4] Sides 1 "
      "Matte 1\n"
      "Transform [1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16] Rotate 30 0 0 1 MotionBegin [0 .5] Translate 1 2 3 Translate "
      "1 2 4\n"
      "MotionEnd AttributeEnd");
}

TEST(RiCalls, KnowHowManyValuesEachPrimitiveTakes) {
  const Calls calls([] {
    std::vector<RtFloat> x(200);
    for (size_t i = 0; i < x.size(); ++i) x[i] = static_cast<RtFloat>(i);
    RtFloat* p = x.data();
    const RtInt triangle[] = {3}, corners[] = {2, 0, 1}, loops[] = {1}, tags[] = {1, 1}, edge[] = {0}, four[] = {4, 7},
                two[] = {2};
    const RtToken hole[] = {"hole"};
    RiSphere(1, -1, 1, 360, "varying float w", p, "uniform color c", p, RI_NULL);
    RiPolygon(3, RI_P, p, "facevarying float w", p, RI_NULL);
    RiPointsPolygons(1, triangle, corners, RI_P, p, "uniform float f", p, "facevarying float[2] st", p, RI_NULL);
    RiPointsGeneralPolygons(1, loops, triangle, corners, RI_P, p, RI_NULL);
    RiPatch(RI_BICUBIC, RI_P, p, RI_S, p, RI_NULL);
    RiAttributeBegin();
    RiBasis(RiBSplineBasis, RI_BSPLINESTEP, RiBSplineBasis, RI_BSPLINESTEP);
    RiPatchMesh(RI_BICUBIC, 5, RI_NONPERIODIC, 4, RI_PERIODIC, RI_PZ, p, RI_S, p, "uniform float f", p, RI_NULL);
    RiAttributeEnd();
    RiCurves(RI_CUBIC, 2, four, RI_NONPERIODIC, RI_P, p, RI_WIDTH, p, "uniform float f", p, RI_NULL);
    RiCurves(RI_LINEAR, 1, two, RI_NONPERIODIC, RI_P, p, RI_WIDTH, p, RI_NULL);
    RiNuPatch(3, 2, p, 1, 3, 2, 2, p, 1, 2, RI_PW, p, RI_S, p, "uniform float f", p, RI_NULL);
    RiSubdivisionMesh("catmull-clark", 1, triangle, corners, 1, hole, tags, edge, p, RI_P, p, RI_NULL);
    RiPoints(2, RI_P, p, RI_WIDTH, p, RI_NULL);
  });
  const auto list = [](int n) {
    std::string out = "[";
    for (int i = 0; i < n; ++i) out += std::to_string(i) + " ";
    return out + "] ";
  };
  expectSays(calls, "Sphere 1 -1 1 360 \"varying float w\" " + list(4) + "\"uniform color c\" " + list(3) +  //
                        "Polygon \"P\" " + list(9) + "\"facevarying float w\" " + list(3) +                  //
                        "PointsPolygons [3] [2 0 1] \"P\" " + list(9) + "\"uniform float f\" " + list(1) +   //
                        "\"facevarying float[2] st\" " + list(6) +                                           //
                        "PointsGeneralPolygons [1] [3] [2 0 1] \"P\" " + list(9) +                           //
                        "Patch \"bicubic\" \"P\" " + list(48) + "\"s\" " + list(4) +                         //
                        "AttributeBegin Basis [" +
                        "-0.16666667 .5 -.5 0.16666667 .5 -1 .5 0 -.5 0 .5 0 0.16666667 0.6666667 0.16666667 0" +
                        "] 1 [" +
                        "-0.16666667 .5 -.5 0.16666667 .5 -1 .5 0 -.5 0 .5 0 0.16666667 0.6666667 0.16666667 0" +
                        "] 1 " + "PatchMesh \"bicubic\" 5 \"nonperiodic\" 4 \"periodic\" \"Pz\" " + list(20) +
                        "\"s\" " + list(3 * 4) + "\"uniform float f\" " + list(2 * 4) + "AttributeEnd " +  //
                        "Curves \"cubic\" [4 7] \"nonperiodic\" \"P\" " + list(33) + "\"width\" " + list(2 + 3) +
                        "\"uniform float f\" " + list(2) +                                                   //
                        "Curves \"linear\" [2] \"nonperiodic\" \"P\" " + list(6) + "\"width\" " + list(2) +  //
                        "NuPatch 3 2 " + list(5) + "1 3 2 2 " + list(4) + "1 2 \"Pw\" " + list(24) + "\"s\" " +
                        list(3 * 2) + "\"uniform float f\" " + list(2) +                                             //
                        "SubdivisionMesh \"catmull-clark\" [3] [2 0 1] [\"hole\"] [1 1] [0] [0] \"P\" " + list(9) +  //
                        "Points \"P\" " + list(6) + "\"width\" " + list(2));
}

TEST(RiCalls, HaveTheBasesOfTheRib) {
  const std::pair<RtFloat(*)[4], Basis> pairs[] = {{RiBezierBasis, bezierBasis()},
                                                   {RiBSplineBasis, bsplineBasis()},
                                                   {RiCatmullRomBasis, catmullRomBasis()},
                                                   {RiHermiteBasis, hermiteBasis()},
                                                   {RiPowerBasis, powerBasis()}};
  for (const auto& [c, known] : pairs)
    for (int row = 0; row < 4; ++row)
      for (int k = 0; k < 4; ++k) EXPECT_NEAR(c[row][k], known.matrix[row][k], 1e-7);
}

TEST(RiCalls, ProceduralsAreThoseOfTheRibOrKeepTheirFunction) {
  static int freed;
  freed = 0;
  {
    const Calls calls([] {
      RtBound box = {-1, 1, -2, 2, -3, 3};
      RtString file[] = {"a.rib"};
      RiProcedural(file, box, RiProcDelayedReadArchive, [](RtPointer) { ++freed; });
      EXPECT_EQ(freed, 1);
      RiProcedural(
          &freed, box, [](RtPointer, RtFloat) {}, [](RtPointer) { ++freed; });
    });
    EXPECT_EQ(calls.list[0].request.args[1].strings, std::vector<std::string>{"a.rib"});
    EXPECT_EQ(calls.list[0].request.args[2].numbers, (std::vector<float>{-1, 1, -2, 2, -3, 3}));
    ASSERT_TRUE(calls.list[1].procedural);
    EXPECT_EQ(calls.list[1].procedural->data.get(), &freed);
    EXPECT_EQ(freed, 1);
  }
  EXPECT_EQ(freed, 2);
}

TEST(RiCalls, SayWhatIsNotDeclaredAndKeepWhatCameBeforeAFailure) {
  Calls calls([] {
    RtFloat f = 1;
    RiSurface("matte", "nowhere", &f, RI_NULL);
  });
  EXPECT_TRUE(calls.list[0].request.params.empty());
  EXPECT_EQ(calls.log.count("rib-plugin"), 1);
  EXPECT_THROW(rib::recordRiCalls(
                   {}, calls.log,
                   [] {
                     RiIdentity();
                     throw 1;
                   },
                   calls.list),
               int);
  EXPECT_EQ(calls.list.back().request.name, "Identity");
  RiIdentity();  // nobody listens any more
  EXPECT_EQ(calls.list.size(), 2u);
}

}  // namespace
}  // namespace tomales
