#include "reyes/rib/request_table.h"

#include <unordered_map>

namespace tomales::rib {
namespace {

constexpr bool kParams = true, kNone = false;
constexpr Support kWorks = Support::Works, kNotYet = Support::NotYet, kGeometry = Support::NotYetGeometry;

constexpr Signature kTable[] = {
    // Stream, blocks, archives
    {"version", "f", kNone, kWorks},
    {"Declare", "ss", kNone, kWorks},
    {"ErrorHandler", "s", kNone, kWorks},
    {"FrameBegin", "f", kNone, kWorks},
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
    {"ObjectInstance", "h", kNone, kWorks},
    {"MotionBegin", "F", kNone, kWorks},
    {"MotionEnd", "", kNone, kWorks},
    {"ReadArchive", "s", kParams, kWorks},
    {"ArchiveBegin", "s", kParams, kNotYet},
    {"ArchiveEnd", "", kNone, kNotYet},
    {"IfBegin", "s", kParams, kNotYet},
    {"ElseIf", "s", kParams, kNotYet},
    {"Else", "", kNone, kNotYet},
    {"IfEnd", "", kNone, kNotYet},
    {"Resource", "ss", kParams, kNotYet},
    {"ResourceBegin", "", kNone, kNotYet},
    {"ResourceEnd", "", kNone, kNotYet},
    {"System", "s", kNone, kNotYet},
    {"EditBegin", "s", kParams, kNotYet},
    {"EditEnd", "", kNone, kNotYet},
    {"EditAttributeBegin", "s", kNone, kNotYet},
    {"EditAttributeEnd", "", kNone, kNotYet},
    {"EditWorldBegin", "s", kParams, kNotYet},
    {"EditWorldEnd", "", kNone, kNotYet},
    // Options
    {"Format", "3", kNone, kWorks},
    {"FrameAspectRatio", "f", kNone, kWorks},
    {"ScreenWindow", "4", kNone, kWorks},
    {"CropWindow", "4", kNone, kWorks},
    {"Projection", "s", kParams, kWorks},
    {"Clipping", "2", kNone, kWorks},
    {"ClippingPlane", "6", kNone, kNotYet},
    {"Camera", "s", kParams, kNotYet},
    {"DepthOfField", "?3", kNone, kWorks},
    {"Shutter", "2", kNone, kWorks},
    {"PixelSamples", "2", kNone, kWorks},
    {"PixelFilter", "s2", kNone, kWorks},
    {"PixelVariance", "f", kNone, kNotYet},
    {"Exposure", "2", kNone, kWorks},
    {"Imager", "s", kParams, kWorks},
    {"Quantize", "s4", kNone, kWorks},
    {"Display", "sss", kParams, kWorks},
    {"DisplayChannel", "s", kParams, kNotYet},
    {"Hider", "s", kParams, kWorks},
    {"ColorSamples", "FF", kNone, kNotYet},
    {"RelativeDetail", "f", kNone, kNotYet},
    {"Option", "s", kParams, kWorks},
    // Attributes
    {"Attribute", "s", kParams, kWorks},
    {"Color", "3", kNone, kWorks},
    {"Opacity", "3", kNone, kWorks},
    {"TextureCoordinates", "8", kNone, kWorks},
    {"LightSource", "sh", kParams, kWorks},
    {"AreaLightSource", "sh", kParams, kWorks},
    {"Illuminate", "hf", kNone, kWorks},
    {"Surface", "s", kParams, kWorks},
    {"Displacement", "s", kParams, kWorks},
    {"Atmosphere", "s", kParams, kNotYet},
    {"Interior", "s", kParams, kNotYet},
    {"Exterior", "s", kParams, kNotYet},
    {"Shader", "sh", kParams, kNotYet},
    {"VPSurface", "s", kParams, kNotYet},
    {"VPAtmosphere", "s", kParams, kNotYet},
    {"VPInterior", "s", kParams, kNotYet},
    {"VPExterior", "s", kParams, kNotYet},
    {"VPVolumes", "s", kParams, kNotYet},
    {"Deformation", "s", kParams, kNotYet},
    {"DeformationSurface", "s", kParams, kNotYet},
    {"ShadingRate", "f", kNone, kWorks},
    {"ShadingInterpolation", "s", kNone, kWorks},
    {"Matte", "f", kNone, kWorks},
    {"Bound", "6", kNone, kWorks},
    {"Detail", "6", kNone, kWorks},
    {"DetailRange", "4", kNone, kNotYet},
    {"GeometricApproximation", "sf", kNone, kNotYet},
    {"GeometricRepresentation", "s", kNone, kNotYet},
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
    {"Basis", "bfbf", kNone, kWorks},
    {"Sphere", "4", kParams, kWorks},
    {"Cone", "3", kParams, kWorks},
    {"Cylinder", "4", kParams, kWorks},
    {"Hyperboloid", "7", kParams, kWorks},
    {"Paraboloid", "4", kParams, kWorks},
    {"Disk", "3", kParams, kWorks},
    {"Torus", "5", kParams, kWorks},
    {"Polygon", "", kParams, kWorks},
    {"GeneralPolygon", "F", kParams, kWorks},
    {"PointsPolygons", "FF", kParams, kWorks},
    {"PointsGeneralPolygons", "FFF", kParams, kWorks},
    {"Patch", "s", kParams, kWorks},
    {"PatchMesh", "sfsfs", kParams, kWorks},
    {"SubdivisionMesh", "sFF?SFFF", kParams, kWorks},
    {"HierarchicalSubdivisionMesh", "sFF?SFFFS", kParams, kGeometry},
    {"NuPatch", "ffFffffFff", kParams, kGeometry},
    {"TrimCurve", "FFFFFFFFF", kNone, kNotYet},
    {"Points", "", kParams, kGeometry},
    {"Curves", "sFs", kParams, kGeometry},
    {"Blobby", "fFFS", kParams, kGeometry},
    {"Volume", "s6F", kParams, kGeometry},
    {"Geometry", "s", kParams, kGeometry},
    {"Procedural", "sS6", kNone, kGeometry},
    {"Procedural2", "ss", kParams, kGeometry},
    // External resources
    {"MakeTexture", "sssss2", kParams, kNotYet},
    {"MakeBump", "sssss2", kParams, kNotYet},
    {"MakeLatLongEnvironment", "sss2", kParams, kNotYet},
    {"MakeCubeFaceEnvironment", "sssssssfs2", kParams, kNotYet},
    {"MakeShadow", "ss", kParams, kNotYet},
    {"MakeBrickMap", "Ss", kParams, kNotYet},
    {"MakeOcclusion", "Ss", kParams, kNotYet},
    {"MakeTexture3D", "ss", kParams, kNotYet},
};

}  // namespace

const Signature* findSignature(std::string_view name) {
  static const auto index = [] {
    std::unordered_map<std::string_view, const Signature*> map;
    for (const Signature& s : kTable) map.emplace(s.name, &s);
    return map;
  }();
  const auto it = index.find(name);
  return it == index.end() ? nullptr : it->second;
}

}  // namespace tomales::rib
