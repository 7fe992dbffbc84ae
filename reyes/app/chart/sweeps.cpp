#include "reyes/app/chart/sweeps.h"

#include <fmt/format.h>

namespace tomales {
namespace {

using Arguments = std::vector<std::string>;

const Arguments kGather{"--gi", "gather"}, kAtlas{"--gi", "atlas"}, kTraced{"--gi", "reference"};
constexpr const char* kAtlasName = "atlas";

/// Rays of a record and the allowed error of its use. Both vary, because changing only one soon stops reducing the
/// error.
struct GatherStep {
  const char *samples, *maxError, *photons;
};
constexpr GatherStep kGatherSteps[] = {{"32", "4", "30000"},
                                       {"96", "2.5", "100000"},
                                       {"256", "1.5", "300000"},
                                       {"512", "1.1", "600000"},
                                       {"1024", "0.8", "1000000"}};

void add(Arguments& to, const Arguments& more) { to.insert(to.end(), more.begin(), more.end()); }

/// `coarser` multiplies the allowed error.
ChartCurve gatherCurve(const std::string& name, const Arguments& method, double coarser = 1) {
  ChartCurve out{name, {}};
  for (const GatherStep& s : kGatherSteps) {
    Arguments& settings = out.settings.emplace_back(method);
    if (name == kAtlasName) add(settings, {"--photons", s.photons});
    add(settings, {"--samples", s.samples, "--max-error", fmt::format("{:g}", coarser * std::stod(s.maxError))});
  }
  return out;
}

/// Paths carry light that photons do not, so the numbers of both grow.
ChartCurve tracedCurve() {
  constexpr const char *kPaths[] = {"4", "16", "64", "128", "256"},
                       *kPhotons[] = {"30000", "100000", "300000", "1000000", "3000000"};
  ChartCurve out{"reference", {}};
  for (size_t k = 0; k < std::size(kPaths); ++k)
    add(out.settings.emplace_back(kTraced), {"--photons", kPhotons[k], "--samples", kPaths[k]});
  return out;
}

/// With this allowed error, `ward` makes as many records as `screen` at maxerror 1 (docs/measured/irradiance_cache.md),
/// and so does `hessian`.
constexpr double kWard = 1.4;
ChartCurve errorFunctionCurve(const std::string& name, double coarser) {
  return gatherCurve("gather, " + name, {"--gi", "gather", "--error-function", name}, coarser);
}

/// Makes one curve, along which one option takes these values.
ChartCurve varied(const std::string& name, const Arguments& fixed, const std::string& option, const Arguments& values) {
  ChartCurve out{name, {}};
  for (const std::string& value : values) {
    Arguments& settings = out.settings.emplace_back(fixed);
    add(settings,
        option.starts_with(kPrelude) ? Arguments{fmt::format(fmt::runtime(option), value)} : Arguments{option, value});
  }
  return out;
}

const char *kIndirect = "lamps, and surfaces that reflect their light to each other",
           *kDirect = "lamps, or surfaces that glow";

const Arguments kPixelSamples{"1x1", "2x2", "3x3", "4x4", "6x6", "8x8"},
    kFilterWidths{"4", "2", "1.5", "1", "0.7", "0.5", "0.25"};
const Arguments kOffsets{"0.3", "0.1", "0.03", "0.01", "0.003", "0.001", "0.0001"};
const Arguments kTessellations{"0.125", "0.25", "0.5", "1", "2", "4", "8"};

std::vector<ChartSweep> allSweeps() {
  const std::string filter = std::string(kPrelude) + "Option \"texture\" \"filter\" ";
  const std::string motion = std::string(kPrelude) + "GeometricApproximation \"motionfactor\" {}";
  const std::string offset = std::string(kPrelude) + "Attribute \"trace\" \"float offset\" {}";
  const std::string tessellation = std::string(kPrelude) + "Attribute \"trace\" \"float tessellation\" {}";
  return {
      {"gi",
       "methods of indirect light",
       kIndirect,
       {"--indirect-only"},
       kTraced,
       "--light-seed",
       true,
       {errorFunctionCurve("screen", 1), errorFunctionCurve("ward", kWard), errorFunctionCurve("hessian", 1),
        gatherCurve("radiosity, one bounce", {"--gi", "radiosity"}), gatherCurve(kAtlasName, kAtlas),
        varied("progressive", {"--gi", "progressive"}, "--photons",
               {"30000", "100000", "300000", "1000000", "3000000"}),
        tracedCurve()}},
      {"maxerror",
       "error allowed in irradiance interpolation",
       kIndirect,
       {"--indirect-only"},
       kTraced,
       "--light-seed",
       true,
       {varied("gather", kGather, "--max-error", {"8", "4", "2", "1", "0.5", "0.25"})}},
      {"samples",
       "gather rays of an irradiance record",
       kIndirect,
       {"--indirect-only"},
       kTraced,
       "--light-seed",
       true,
       {varied("gather", kGather, "--samples", {"16", "50", "150", "450", "1350", "4000"})}},
      {"photons",
       "photons of the irradiance atlas",
       kIndirect,
       {"--indirect-only"},
       kTraced,
       "--light-seed",
       true,
       {varied("atlas", kAtlas, "--photons", {"10000", "30000", "100000", "300000", "1000000", "3000000"})}},
      {"brickcache",
       "memory for bricks",
       kIndirect,
       {"--indirect-only"},
       kTraced,
       "--light-seed",
       true,
       {varied("atlas", kAtlas, "--brick-cache", {"100K", "300K", "1M", "3M", "10M"})}},
      {"brickerror",
       "error allowed in bricks that stand for finer ones",
       kIndirect,
       {"--indirect-only"},
       kTraced,
       "--light-seed",
       true,
       {varied("atlas", kAtlas, "--brick-maxerror", {"1", "0.3", "0.1", "0.03", "0.01", "0.003"})}},
      {"shadingrate",
       "shading rate",
       kDirect,
       {"--gi", "none"},
       {"--shading-rate", "0.0625"},
       "--light-seed",
       false,
       {varied("shading rate", {}, "--shading-rate", {"16", "8", "4", "2", "1", "0.5", "0.25"})}},
      {"pixelsamples",
       "pixel samples",
       kDirect,
       {"--gi", "none"},
       {"--pixel-samples", "16x16"},
       "--seed",
       false,
       {varied("jittered", {}, "--pixel-samples", kPixelSamples),
        varied("regular", {std::string(kPrelude) + "Hider \"hidden\" \"int jitter\" 0"}, "--pixel-samples",
               kPixelSamples)}},
      {"shadowsamples",
       "samples of area lights and skies",
       kDirect,
       {"--gi", "none"},
       {"--light-samples", "256"},
       "--light-seed",
       false,
       {varied("light samples", {}, "--light-samples", {"1", "2", "4", "8", "16", "32", "64", "128"})}},
      {"texturefilter",
       "width of texture filters",
       kDirect,
       {"--gi", "none"},
       {"--shading-rate", "0.125"},
       "--light-seed",
       false,
       {varied("box", {}, filter + "\"box\" \"width\" {}", kFilterWidths),
        varied("gaussian", {}, filter + "\"gaussian\" \"width\" {}", kFilterWidths)}},
      {"motionfactor",
       "coarser shading of what moves",
       kDirect,
       {"--gi", "none"},
       {fmt::format(fmt::runtime(motion), 0)},
       "--light-seed",
       false,
       {varied("motion factor", {}, motion, {"16", "8", "4", "2", "1", "0"})}},
      {"tessellation",
       "fineness of the polygons that rays meet",
       kIndirect,
       {"--gi", "gather", "--indirect-only"},
       {fmt::format(fmt::runtime(tessellation), 16)},
       "--light-seed",
       false,
       {varied("hit list", {}, tessellation, kTessellations),
        varied("bias alone", {"--no-hit-list"}, tessellation, kTessellations)}},
      {"offset",
       "distance that may lie between what rays meet and what the eye sees, in units of the scene",
       kIndirect,
       {"--gi", "gather", "--indirect-only"},
       {fmt::format(fmt::runtime(tessellation), 16)},
       "--light-seed",
       false,
       {varied("hit list", {}, offset, kOffsets)}},
  };
}

}  // namespace

std::optional<ChartSweep> chartSweep(const std::string& name) {
  for (const ChartSweep& sweep : allSweeps())
    if (sweep.name == name) return sweep;
  return std::nullopt;
}

std::string chartSweepNames() {
  std::string out;
  for (const ChartSweep& sweep : allSweeps()) out += (out.empty() ? "" : ", ") + sweep.name;
  return out;
}

}  // namespace tomales
