#include "reyes/rib/request_table.h"

#include <fmt/format.h>

#include <unordered_map>

#include "reyes/prim_factories.h"
#include "reyes/rib.h"

namespace tomales::rib {
namespace {

constexpr bool kParams = true, kNone = false;
constexpr Support kWorks = Support::Works, kDraws = Support::Draws, kIgnored = Support::Ignored;

constexpr Signature kTable[] = {
    // Stream, blocks, archives
    {"version", "f", kNone, kWorks},
    {"Declare", "ss", kNone, kWorks},
    {"ErrorHandler", "s", kNone, kWorks},
    {"FrameBegin", "i", kNone, kWorks},
    {"FrameEnd", "", kNone, kWorks},
    {"WorldBegin", "", kNone, kWorks},
    {"WorldEnd", "", kNone, kWorks},
    {"AttributeBegin", "", kNone, kWorks},
    {"AttributeEnd", "", kNone, kWorks},
    {"TransformBegin", "", kNone, kWorks},
    {"TransformEnd", "", kNone, kWorks},
    {"SolidBegin", "s", kNone, kWorks},
    {"SolidEnd", "", kNone, kWorks},
    {"ObjectBegin", "h", kNone, kWorks},
    {"ObjectEnd", "", kNone, kWorks},
    {"ObjectInstance", "h", kNone, kDraws},
    {"MotionBegin", "F", kNone, kWorks},
    {"MotionEnd", "", kNone, kWorks},
    {"ReadArchive", "s", kParams, kDraws},
    {"ArchiveBegin", "s", kParams, kWorks},
    {"ArchiveEnd", "", kNone, kWorks},
    {"IfBegin", "s", kParams, kWorks},
    {"ElseIf", "s", kParams, kWorks},
    {"Else", "", kNone, kWorks},
    {"IfEnd", "", kNone, kWorks},
    {"Resource", "ss", kParams, kWorks},
    {"ResourceBegin", "", kNone, kWorks},
    {"ResourceEnd", "", kNone, kWorks},
    {"System", "s", kNone, kWorks},
    {"EditBegin", "s", kParams, kIgnored},
    {"EditEnd", "", kNone, kIgnored},
    {"EditAttributeBegin", "s", kNone, kIgnored},
    {"EditAttributeEnd", "", kNone, kIgnored},
    {"EditWorldBegin", "s", kParams, kIgnored},
    {"EditWorldEnd", "", kNone, kIgnored},
    // Options
    {"Format", "3", kNone, kWorks},
    {"FrameAspectRatio", "f", kNone, kWorks},
    {"ScreenWindow", "4", kNone, kWorks},
    {"CropWindow", "4", kNone, kWorks},
    {"Projection", "s", kParams, kWorks},
    {"Clipping", "2", kNone, kWorks},
    {"ClippingPlane", "6", kNone, kWorks},
    {"Camera", "s", kParams, kWorks},
    {"DepthOfField", "?3", kNone, kWorks},
    {"Shutter", "2", kNone, kWorks},
    {"PixelSamples", "2", kNone, kWorks},
    {"PixelFilter", "s2", kNone, kWorks},
    {"PixelVariance", "f", kNone, kIgnored},
    {"VolumePixelSamples", "2", kNone, kIgnored},
    {"PixelSampleImager", "s", kParams, kIgnored},
    {"Exposure", "2", kNone, kWorks},
    {"Imager", "s", kParams, kWorks},
    {"Quantize", "s4", kNone, kWorks},
    {"Display", "sss", kParams, kWorks},
    {"DisplayChannel", "s", kParams, kWorks},
    {"Hider", "s", kParams, kWorks},
    {"Integrator", "sh", kParams, kWorks},
    {"DisplayFilter", "sh", kParams, kWorks},
    {"SampleFilter", "sh", kParams, kWorks},
    {"ColorSamples", "FF", kNone, kWorks},
    {"RelativeDetail", "f", kNone, kWorks},
    {"Option", "s", kParams, kWorks},
    {"Options", "sh", kParams, kIgnored},
    // Attributes
    {"Attribute", "s", kParams, kWorks},
    {"Color", "c", kNone, kWorks},
    {"Opacity", "c", kNone, kWorks},
    {"TextureCoordinates", "8", kNone, kWorks},
    {"LightSource", "sh", kParams, kWorks},
    {"AreaLightSource", "sh", kParams, kWorks},
    {"Illuminate", "hf", kNone, kWorks},
    {"Surface", "s", kParams, kWorks},
    {"Displacement", "s", kParams, kWorks},
    {"Atmosphere", "s", kParams, kWorks},
    {"Interior", "s", kParams, kWorks},
    {"Exterior", "s", kParams, kWorks},
    {"Shader", "sh", kParams, kIgnored},
    {"Bxdf", "sh", kParams, kWorks},
    {"Light", "sh", kParams, kWorks},
    {"LightFilter", "sh", kParams, kWorks},
    {"Pattern", "sh", kParams, kWorks},
    {"Displace", "sh", kParams, kWorks},
    {"VPSurface", "s", kParams, kIgnored},
    {"VPAtmosphere", "s", kParams, kIgnored},
    {"VPInterior", "s", kParams, kIgnored},
    {"VPExterior", "s", kParams, kIgnored},
    {"VPVolumes", "s", kParams, kIgnored},
    {"Deformation", "s", kParams, kIgnored},
    {"DeformationSurface", "s", kParams, kIgnored},
    {"ShadingRate", "f", kNone, kWorks},
    {"ShadingInterpolation", "s", kNone, kWorks},
    {"Matte", "f", kNone, kWorks},
    {"Bound", "6", kNone, kWorks},
    {"Detail", "6", kNone, kWorks},
    {"DetailRange", "4", kNone, kWorks},
    {"GeometricApproximation", "sf", kNone, kWorks},
    {"GeometricRepresentation", "s", kNone, kIgnored},
    {"Orientation", "s", kNone, kWorks},
    {"ReverseOrientation", "", kNone, kWorks},
    {"Sides", "f", kNone, kWorks},
    // Transformations
    {"Identity", "", kNone, kWorks},
    {"Transform", "m", kNone, kWorks},
    {"ConcatTransform", "m", kNone, kWorks},
    {"Perspective", "f", kNone, kWorks},
    {"Translate", "3", kNone, kWorks},
    {"Rotate", "4", kNone, kWorks},
    {"Scale", "3", kNone, kWorks},
    {"Skew", "7", kNone, kWorks},
    {"CoordinateSystem", "s", kNone, kWorks},
    {"ScopedCoordinateSystem", "s", kNone, kWorks},
    {"CoordSysTransform", "s", kNone, kWorks},
    // Geometry
    {"Basis", "bibi", kNone, kWorks},
    {"Polygon", "", kParams, kDraws},
    {"GeneralPolygon", "I", kParams, kDraws},
    {"PointsPolygons", "II", kParams, kDraws},
    {"PointsGeneralPolygons", "III", kParams, kDraws},
    {"Patch", "s", kParams, kDraws},
    {"PatchMesh", "sisis", kParams, kDraws},
    {"SubdivisionMesh", "sII?SIIF", kParams, kDraws},
    {"HierarchicalSubdivisionMesh", "sII?SIIFS", kParams, kDraws},
    {"NuPatch", "iiFffiiFff", kParams, kDraws},
    {"TrimCurve", "IIFFFIFFF", kNone, kWorks},
    {"Points", "", kParams, kDraws},
    {"Curves", "sIs", kParams, kDraws},
    {"Blobby", "iIFS", kParams, kDraws},
    {"Volume", "s6I", kParams, kDraws},
    {"Geometry", "s", kParams, kDraws},
    {"Procedural", "sS6", kNone, kDraws},
    {"Procedural2", "ss", kParams, kDraws},
    // External resources
    {"MakeTexture", "sssss2", kParams, kWorks},
    {"MakeBump", "sssss2", kParams, kWorks},
    {"MakeLatLongEnvironment", "sss2", kParams, kWorks},
    {"MakeCubeFaceEnvironment", "sssssssfs2", kParams, kWorks},
    {"MakeShadow", "ss", kParams, kWorks},
    {"MakeBrickMap", "Ss", kParams, kWorks},
    {"MakeOcclusion", "Ss", kParams, kIgnored},
    {"MakeTexture3D", "ss", kParams, kIgnored},
};

/// Makes the signature of a quadric, of which prim.h has the list.
Signature signatureOf(const Quadric& quadric) {
  static constexpr std::string_view kCounts = "0123456789";
  return {quadric.name, kCounts.substr(static_cast<size_t>(quadric.numberCount), 1), kParams, kDraws};
}

std::string_view nameOf(Support support) {
  switch (support) {
    case Support::Works:
      return "works";
    case Support::Draws:
      return "draws";
    case Support::Ignored:
      return "ignored";
  }
  return "";
}

std::string lineOf(const Signature& s) {
  return fmt::format("{} {} {} {}\n", s.name, s.arguments.empty() ? "-" : s.arguments,
                     s.parameterList ? "parameters" : "-", nameOf(s.support));
}

}  // namespace

const Signature* findSignature(std::string_view name) {
  static const auto index = [] {
    std::unordered_map<std::string_view, Signature> map;
    for (const Signature& s : kTable) map.emplace(s.name, s);
    for (const Quadric& q : quadrics()) map.emplace(q.name, signatureOf(q));
    return map;
  }();
  const auto it = index.find(name);
  return it == index.end() ? nullptr : &it->second;
}

const std::vector<std::string>& requestNames() {
  static const auto names = [] {
    std::vector<std::string> out;
    for (const Signature& s : kTable) out.emplace_back(s.name);
    for (const Quadric& q : quadrics()) out.emplace_back(q.name);
    return out;
  }();
  return names;
}

}  // namespace tomales::rib

std::string tomales::ribRequests() {
  std::string out;
  for (const rib::Signature& s : rib::kTable) out += rib::lineOf(s);
  for (const Quadric& q : quadrics()) out += rib::lineOf(rib::signatureOf(q));
  return out;
}
