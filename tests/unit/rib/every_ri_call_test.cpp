// Every function of the C binding says the request of its name.
#include "reyes/rib/ri_calls.h"
#include "rib_test_tools.h"

namespace tomales {
namespace every_ri_call {
namespace {

/// Compares what the program says with the requests of a text. Handles of the program are its own, and are compared by
/// each other.
void expectSays(const std::function<void()>& program, const std::string& text) {
  Log log(Log::Verbosity::Quiet);
  std::vector<rib::RiCall> calls;
  rib::recordRiCalls({}, log, program, calls);
  EXPECT_TRUE(log.entries().empty()) << log.entries()[0].message;
  const Requests should(text);
  ASSERT_TRUE(should.log.entries().empty()) << should.log.entries()[0].message;
  ASSERT_EQ(calls.size(), should.list.size());
  std::map<std::string, std::string> handles;
  for (size_t i = 0; i < calls.size(); ++i) {
    const Request &a = calls[i].request, &b = should.list[i];
    SCOPED_TRACE(b.name);
    EXPECT_EQ(a.name, b.name);
    ASSERT_EQ(a.args.size(), b.args.size());
    for (size_t k = 0; k < a.args.size(); ++k) {
      EXPECT_EQ(a.args[k].kind, b.args[k].kind) << k;
      EXPECT_EQ(a.args[k].numbers, b.args[k].numbers) << k;
      EXPECT_EQ(a.args[k].integers, b.args[k].integers) << k;
      std::vector<std::string> strings = a.args[k].strings;
      for (size_t s = 0; s < strings.size(); ++s)
        if (strings[s].starts_with("of a plugin: "))
          strings[s] = handles.try_emplace(strings[s], b.args[k].strings.at(s)).first->second;
      EXPECT_EQ(strings, b.args[k].strings) << k;
    }
    ASSERT_EQ(a.params.size(), b.params.size());
    for (size_t k = 0; k < a.params.size(); ++k) {
      EXPECT_EQ(a.params[k].name, b.params[k].name);
      EXPECT_EQ(a.params[k].floats, b.params[k].floats) << a.params[k].name;
    }
  }
  std::set<std::string> different;
  for (const auto& [theirs, ours] : handles) different.insert(ours);
  EXPECT_EQ(different.size(), handles.size());
}

TEST(EveryRiCall, OfBlocksSaysItsRequest) {
  expectSays(
      [] {
        RiTransformBegin();
        RiTransformEnd();
        RiSolidBegin("union");
        RiSolidEnd();
        const RtObjectHandle first = RiObjectBegin();
        RiObjectEnd();
        const RtObjectHandle second = RiObjectBegin();
        RiObjectEnd();
        RiObjectInstance(second);
        RiObjectInstance(first);
        RtFloat times[] = {0, 0.25f, 1};
        RiMotionBeginV(3, times);
        RiMotionEnd();
        RiReadArchive("a.rib", nullptr, RI_NULL);
      },
      "TransformBegin TransformEnd SolidBegin \"union\" SolidEnd ObjectBegin \"a\" ObjectEnd ObjectBegin \"b\" "
      "ObjectEnd "
      "ObjectInstance \"b\" ObjectInstance \"a\" MotionBegin [0 .25 1] MotionEnd ReadArchive \"a.rib\"");
}

TEST(EveryRiCall, OfAttributesSaysItsRequest) {
  expectSays(
      [] {
        RtFloat half[] = {0.5f, 0.25f, 1}, kd = 0.5f;
        const RtBound box = {-1, 1, -2, 2, -3, 3};
        RiOpacity(half);
        RiTextureCoordinates(1, 2, 3, 4, 5, 6, 7, 8);
        RiDisplacement("dented", "Km", &kd, RI_NULL);
        RiAtmosphere("fog", "distance", &kd, RI_NULL);
        RiInterior("a", RI_NULL);
        RiExterior("b", RI_NULL);
        const RtLightHandle sun = RiLightSource("distantlight", "intensity", &kd, RI_NULL),
                            lamp = RiAreaLightSource("arealight", RI_NULL);
        RiIlluminate(lamp, RI_FALSE);
        RiIlluminate(sun, RI_TRUE);
        RiShadingRate(2.5f);
        RiShadingInterpolation("smooth");
        RiMatte(RI_FALSE);
        RiBound(box);
        RiDetail(box);
        RiDetailRange(1, 2, 3, 4);
        RiGeometricApproximation("motionfactor", 2);
        RiOrientation("inside");
        RiReverseOrientation();
        RiSides(2);
      },
      "Opacity .5 .25 1 TextureCoordinates 1 2 3 4 5 6 7 8 Displacement \"dented\" \"Km\" .5 Atmosphere \"fog\" "
      "\"distance\" .5 Interior \"a\" Exterior \"b\" LightSource \"distantlight\" \"sun\" \"intensity\" .5 "
      "AreaLightSource \"arealight\" \"lamp\" Illuminate \"lamp\" 0 Illuminate \"sun\" 1 ShadingRate 2.5 "
      "ShadingInterpolation \"smooth\" Matte 0 Bound [-1 1 -2 2 -3 3] Detail [-1 1 -2 2 -3 3] DetailRange [1 2 3 4] "
      "GeometricApproximation \"motionfactor\" 2 Orientation \"inside\" ReverseOrientation Sides 2");
}

TEST(EveryRiCall, OfTransformationsSaysItsRequest) {
  expectSays(
      [] {
        RtMatrix m = {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}, {13, 14, 15, 16}};
        RiIdentity();
        RiConcatTransform(m);
        RiPerspective(45);
        RiTranslate(1, 2, 3);
        RiScale(4, 5, 6);
        RiSkew(7, 8, 9, 10, 11, 12, 13);
        RiCoordinateSystem("here");
        RiScopedCoordinateSystem("there");
        RiCoordSysTransform("here");
      },
      "Identity ConcatTransform [1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16] Perspective 45 Translate 1 2 3 Scale 4 5 6 "
      "Skew 7 8 9 10 11 12 13 CoordinateSystem \"here\" ScopedCoordinateSystem \"there\" CoordSysTransform \"here\"");
}

TEST(EveryRiCall, OfQuadricsSaysItsRequest) {
  expectSays(
      [] {
        RtFloat w[] = {1, 2, 3, 4};
        const RtPoint p = {1, 2, 3}, q = {4, 5, 6};
        RiCone(1, 2, 3, "varying float w", w, RI_NULL);
        RiCylinder(1, 2, 3, 4, RI_NULL);
        RiParaboloid(2, 3, 4, 5, RI_NULL);
        RiDisk(3, 4, 5, "varying float w", w, RI_NULL);
        RiTorus(4, 5, 6, 7, 8, RI_NULL);
        RiHyperboloid(p, q, 7, "varying float w", w, RI_NULL);
      },
      "Cone 1 2 3 \"varying float w\" [1 2 3 4] Cylinder 1 2 3 4 Paraboloid 2 3 4 5 Disk 3 4 5 \"varying float w\" [1 "
      "2 "
      "3 4] Torus 4 5 6 7 8 Hyperboloid 1 2 3 4 5 6 7 \"varying float w\" [1 2 3 4]");
}

std::string counting(int n) {
  std::string out = "[";
  for (int i = 0; i < n; ++i) out += std::to_string(i) + " ";
  return out + "] ";
}

TEST(EveryRiCall, OfOtherGeometrySaysItsRequest) {
  expectSays(
      [] {
        std::vector<RtFloat> x(100);
        for (size_t i = 0; i < x.size(); ++i) x[i] = static_cast<RtFloat>(i);
        RtFloat* p = x.data();
        const RtInt loops[] = {3, 4}, code[] = {1001, 0}, curves[] = {1, 2}, orders[] = {2, 3, 2}, points[] = {2, 3, 2};
        const RtString files[] = {"a", "b"};
        RiGeneralPolygon(2, loops, RI_P, p, "uniform float f", p, "facevarying float w", p, RI_NULL);
        RiPatch(RI_BILINEAR, RI_P, p, "uniform float f", p, RI_NULL);
        RiPatchMesh(RI_BILINEAR, 4, RI_PERIODIC, 3, RI_NONPERIODIC, RI_P, p, RI_S, p, "uniform float f", p, RI_NULL);
        RiNuPatch(4, 2, p, 1, 3, 5, 3, p, 1, 2, RI_PW, p, RI_S, p, "uniform float f", p, RI_NULL);
        RiTrimCurve(2, curves, orders, p, p, p, points, p, p, p);
        RiCurves(RI_LINEAR, 2, loops, RI_PERIODIC, RI_P, p, RI_WIDTH, p, "uniform float f", p, RI_NULL);
        RiBlobby(1, 2, code, 16, p, 2, files, "varying float w", p, RI_NULL);
        RiGeometry("teapot", RI_NULL);
      },
      "GeneralPolygon [3 4] \"P\" " + counting(21) + "\"uniform float f\" " + counting(1) + "\"facevarying float w\" " +
          counting(7) +  //
          "Patch \"bilinear\" \"P\" " + counting(12) + "\"uniform float f\" " + counting(1) +
          "PatchMesh \"bilinear\" 4 \"periodic\" 3 \"nonperiodic\" \"P\" " + counting(36) + "\"s\" " + counting(4 * 3) +
          "\"uniform float f\" " + counting(4 * 2) +  //
          "NuPatch 4 2 " + counting(6) + "1 3 5 3 " + counting(8) + "1 2 \"Pw\" " + counting(80) + "\"s\" " +
          counting(4 * 4) + "\"uniform float f\" " + counting(3 * 3) +  //
          "TrimCurve [1 2] [2 3 2] " + counting(14) + counting(3) + counting(3) + "[2 3 2] " + counting(7) +
          counting(7) + counting(7) +  //
          "Curves \"linear\" [3 4] \"periodic\" \"P\" " + counting(21) + "\"width\" " + counting(3 + 4) +
          "\"uniform float f\" " + counting(2) +  //
          "Blobby 1 [1001 0] " + counting(16) + "[\"a\" \"b\"] \"varying float w\" " + counting(1) +
          "Geometry \"teapot\"");
}

TEST(EveryRiCall, OfMeshesCountsPointsByTheirLargestNumber) {
  expectSays(
      [] {
        std::vector<RtFloat> x(100);
        for (size_t i = 0; i < x.size(); ++i) x[i] = static_cast<RtFloat>(i);
        RtFloat* p = x.data();
        const RtInt faces[] = {3, 4}, corners[] = {0, 1, 2, 1, 2, 5, 4}, loops[] = {2}, nargs[] = {0, 0, 2, 1},
                    edge[] = {1, 2};
        const RtToken tags[] = {"interpolateboundary", "crease"};
        RiPointsPolygons(2, faces, corners, RI_P, p, "varying float w", p, "uniform float f", p, RI_NULL);
        RiPointsGeneralPolygons(1, loops, faces, corners, RI_P, p, "facevarying float w", p, "uniform float f", p,
                                RI_NULL);
        RiSubdivisionMesh("catmull-clark", 2, faces, corners, 2, tags, nargs, edge, p, RI_P, p, RI_NULL);
      },
      "PointsPolygons [3 4] [0 1 2 1 2 5 4] \"P\" " + counting(18) + "\"varying float w\" " + counting(6) +
          "\"uniform float f\" " + counting(2) +  //
          "PointsGeneralPolygons [2] [3 4] [0 1 2 1 2 5 4] \"P\" " + counting(18) + "\"facevarying float w\" " +
          counting(7) + "\"uniform float f\" " + counting(1) +  //
          "SubdivisionMesh \"catmull-clark\" [3 4] [0 1 2 1 2 5 4] [\"interpolateboundary\" \"crease\"] [0 0 2 1] [1 "
          "2] "
          "[0] \"P\" " +
          counting(18));
}

TEST(EveryRiCall, OfProceduralsNamesTheirFilesAndData) {
  expectSays(
      [] {
        const RtBound box = {-1, 1, -2, 2, -3, 3};
        static RtString two[] = {"first", "second"};
        RiProcedural(two, box, RiProcRunProgram, nullptr);
        RiProcedural(two, box, RiProcDynamicLoad, nullptr);
        RiProcedural(two, box, RiProcDelayedReadArchive, nullptr);
      },
      "Procedural \"RunProgram\" [\"first\" \"second\"] [-1 1 -2 2 -3 3] Procedural \"DynamicLoad\" [\"first\" "
      "\"second\"] [-1 1 -2 2 -3 3] Procedural \"DelayedReadArchive\" [\"first\"] [-1 1 -2 2 -3 3]");
}

}  // namespace
}  // namespace every_ri_call
}  // namespace tomales
