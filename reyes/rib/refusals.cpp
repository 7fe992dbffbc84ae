#include "reyes/rib/refusals.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace tomales::rib {
namespace {

constexpr const char *kVolumes =
                         "a Volume is followed along each ray, and where two overlap the farther counts as if it were "
                         "behind the other",
                     *kVisiblePoints =
                         "there are no shaders of visible points; Atmosphere shades what lies before the camera",
                     *kEdits = "edits are files of their own, for tomales shade --edit; all up to its End is left out",
                     *kCaches = "caches are as large as they need to be", *kHair = "curves are diced like all else",
                     *kResume = "tomales --resume keeps finished buckets", *kNoCache = "rays run shaders instead",
                     *kWriter = "tomales catrib writes RIB", *kStatistics = "tomales --stats FILE.json writes them",
                     *kAdaptive = "every pixel takes the samples of PixelSamples",
                     *kStatic = "the shadows of lights are traced or come from maps",
                     *kOneCamera = "there is one camera", *kStitch = "edges between patches never open",
                     *kEstimate = "tomales irradiance --nearest sets it",
                     *kDerivatives = "derivatives are central differences over the grid",
                     *kHitList = "Attribute \"trace\" \"bias\" moves rays off surfaces",
                     *kRecords = "tomales gather -o writes irradiance records, tomales render --irradiance reads them",
                     *kPhotonTrace = "tomales photons --bounces ends the paths of photons",
                     *kSplits = "geometry splits as far as it must";

const std::unordered_map<std::string_view, std::string>& reasons() {
  static const std::unordered_map<std::string_view, std::string> table = {
      {"VPInterior", kVisiblePoints},
      {"VPExterior", kVisiblePoints},
      {"VPAtmosphere", kVisiblePoints},
      {"VPSurface", kVisiblePoints},
      {"VPVolumes", kVisiblePoints},
      {"Shader", "shaders do not call each other here"},
      {"Deformation", "Displacement moves surfaces"},
      {"DeformationSurface", "Displacement moves surfaces"},
      {"EditBegin", kEdits},
      {"EditAttributeBegin", kEdits},
      {"EditWorldBegin", kEdits},
      {"EditEnd", "there is no EditBegin"},
      {"EditAttributeEnd", "there is no EditAttributeBegin"},
      {"EditWorldEnd", "there is no EditWorldBegin"},
      {"PixelVariance", kAdaptive},
      {"VolumePixelSamples", kVolumes},
      {"PixelSampleImager", "an Imager runs for each pixel"},
      {"GeometricRepresentation", "geometry is always drawn as surfaces"},
      {"MakeTexture3D", "MakeBrickMap makes brick maps"},
      {"MakeOcclusion", "MakeShadow makes one map of one picture"},
      {"Hider photon", "tomales photons writes photon maps; the picture is rendered as by \"hidden\""},
      {"Hider raytrace",
       fmt::format("the picture is rendered as by \"hidden\", with maxsamples (at most {}) for PixelSamples",
                   kMostTracedSamples)},
      {"Hider bake", "the picture is rendered as by \"hidden\", and bakes nothing"},
      {"Hider null", "the picture is rendered as by \"hidden\"; Display type \"null\" writes none"},
      {"Hider paint", "the picture is rendered as by \"hidden\""},
      {"Hider zbuffer", "the picture is rendered as by \"hidden\""},
      {"Hider depthmask", "the picture is rendered as by \"hidden\", without a mask"},
      {"Hider:emit", "tomales photons --photons says how many"},
      {"Hider:maxsamples", kAdaptive},
      {"Hider:minsamples", kAdaptive},
      {"Hider:incremental", "buckets are finished one by one"},
      {"Hider:integrationmode", "--gi chooses how light is found"},
      {"Hider:extrememotiondof", "samples take motion and defocus together in any case"},
      {"Hider:occlusionbound", "what is hidden is found without a bound"},
      {"Hider:mcmaxlevel", "the hider keeps no pyramid"},
      {"Option limits:eyesplits", "geometry through the eye plane needs no limit"},
      {"Option limits:threads", "tomales -t sets the number of threads"},
      {"Option limits:brickmemory", "tomales --brick-cache sets it"},
      {"Option bucket:orderorigin", "spirals begin in the middle"},
      {"Option trace:specularthreshold", "rays wider than 10 degrees are diffuse"},
      {"Option shutter:clampmotion", "dPdtime is that of the open shutter"},
      {"Option shading:checknans", "values that are NaN or infinite are always reported"},
      {"Option hair:minwidth", "thin curves keep their width"},
      {"Attribute dice:hair", kHair},
      {"Attribute dice:strategy", "the rate is measured where surfaces are in the picture"},
      {"Attribute dice:referencecamera", kOneCamera},
      {"Attribute dice:preservecv", kHair},
      {"Attribute dice:offscreenstrategy", "what is off screen is not diced; rays meet a coarse copy"},
      {"Attribute dice:minlength", "ShadingRate alone says how fine"},
      {"Attribute dice:minlengthspace", "ShadingRate alone says how fine"},
      {"Attribute dice:numprobes", kSplits},
      {"Attribute dice:minsplits", kSplits},
      {"Attribute dice:boundexpand", kSplits},
      {"Attribute derivatives:centered", kDerivatives},
      {"Attribute derivatives:extrapolate", kDerivatives},
      {"Attribute sides:backfacetolerance", "each micropolygon faces one way or the other"},
      {"Attribute sides:doubleshaded", "a surface is shaded as it faces the camera"},
      {"Attribute stitch:enable", kStitch},
      {"Attribute stitch:traceenable", kStitch},
      {"Attribute stitch:newgroup", kStitch},
      {"Attribute procedural:attributes", "procedurals have the attributes of the place where they stand"},
      {"Attribute procedural:immediatesubdivide", "procedurals are read when a bucket comes to their bound"},
      {"Attribute visibility:midpoint", "the depthfilter \"midpoint\" takes all surfaces"},
      {"Attribute shade:camerahitmode", "the camera sees shaders"},
      {"Attribute shade:diffusehitcache", kNoCache},
      {"Attribute shade:transmissionhitcache", kNoCache},
      {"Attribute shade:strategy", "surfaces are shaded as grids"},
      {"Attribute shade:frequency", "surfaces are shaded once, at shutter open"},
      {"Attribute shade:volumeintersectionstrategy", kVolumes},
      {"Attribute shade:volumeintersectionpriority", kVolumes},
      {"Attribute volume:depthrelativeshadingrate", kVolumes},
      {"Attribute volume:depthinterpolation", kVolumes},
      {"Attribute volume:deptherror", kVolumes},
      {"Attribute irradiance:handle", kRecords},
      {"Attribute irradiance:filemode", kRecords},
      {"Attribute irradiance:nsamples", "tomales --samples or indirectlight \"samples\" sets it"},
      {"Attribute irradiance:shadingrate", "irradiance:maxpixeldist says how dense records are"},
      {"Attribute photon:estimator", kEstimate},
      {"Attribute photon:maxdiffusedepth", kPhotonTrace},
      {"Attribute photon:maxspeculardepth", kPhotonTrace},
      {"Attribute photon:minstoredepth", "all photons that arrive on diffuse surfaces are stored"},
      {"Attribute trace:importancethreshold", "all rays are traced"},
      {"Attribute trace:decimationrate", "\"trace\" \"tessellation\" says how fine rays see geometry"},
      {"Attribute autoshadows:res", kStatic},
      {"Attribute autoshadows:shadowmapname", kStatic},
  };
  return table;
}

// Reasons for all names of a category.
constexpr std::pair<std::string_view, const char*> kCategories[] = {
    {"Option statistics:", kStatistics},
    {"Option rib:", kWriter},
    {"Option checkpoint:", kResume},
    {"Option texture:", "texture filters are parameters of shaders"},
    {"Attribute render:",
     "\"visibility\" says what sees an object, \"trace\" \"displacements\" whether rays see it displaced"}};

}  // namespace

std::string reasonFor(std::string_view what) {
  const char* why = nullptr;
  if (const auto it = reasons().find(what); it != reasons().end()) why = it->second.c_str();
  for (const auto& [prefix, reason] : kCategories)
    if (!why && what.starts_with(prefix)) why = reason;
  const bool memory = what.starts_with("Option limits:") && what.ends_with("memory");
  if (!why && memory) why = kCaches;
  return why ? std::string(": ") + why : "";
}

}  // namespace tomales::rib
