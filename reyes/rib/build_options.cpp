// Options (RISpec 3.2 section 4.1). Values that make no picture are reported and leave the option as it was.
#include <fmt/format.h>

#include "reyes/filter_width.h"
#include "reyes/rib/handlers.h"
#include "reyes/rib/option_table.h"
#include "reyes/rib/refusals.h"

namespace tomales::rib {
namespace {

constexpr float kLargestImage = 32768;  // Pixels of a side; readers of OpenEXR and TIFF stop about there.
constexpr float kMostSamples = 256;     // Samples along a side of a pixel's lattice.

void rejectOption(GraphicsState& s, const Request& r, const std::string& why) {
  s.warn(r, "rib-option", why + "; the option is left as it was");
}

// Sets the resolution. By RISpec a resolution or aspect ratio of zero or less keeps the default.
void format(GraphicsState& s, const Request& r) {
  const std::vector<float>& a = r.args[0].numbers;
  Options& o = s.globals.options;
  if (a[0] > kLargestImage || a[1] > kLargestImage) {
    s.log.report(
        Severity::Missing, "rib-option", r.where,
        fmt::format("Format: {} x {} is more than the {} pixels that a picture may have on a side; {} x {} stays", a[0],
                    a[1], kLargestImage, o.xResolution, o.yResolution));
    return;
  }
  if (a[0] > 0) o.xResolution = std::max(1, static_cast<int>(a[0]));
  if (a[1] > 0) o.yResolution = std::max(1, static_cast<int>(a[1]));
  if (a[2] > 0) o.pixelAspect = clamped(s, r, a[2], 1e-3f, 1e3f);
}

void frameAspectRatio(GraphicsState& s, const Request& r) {
  const float aspect = r.args[0].number();
  if (!(aspect > 1e-4f && aspect < 1e4f)) return rejectOption(s, r, fmt::format("{} is no aspect ratio", aspect));
  s.globals.options.frameAspect = aspect;
}

void screenWindow(GraphicsState& s, const Request& r) {
  const std::vector<float>& a = r.args[0].numbers;
  if (a[0] == a[1] || a[2] == a[3]) return rejectOption(s, r, "the window is empty");
  s.globals.options.screenWindow = std::array<float, 4>{a[0], a[1], a[2], a[3]};
}

void cropWindow(GraphicsState& s, const Request& r) {
  std::array<float, 4> w;
  for (size_t i = 0; i < 4; ++i) w[i] = clamped(s, r, r.args[0].numbers[i], 0, 1);
  if (w[0] >= w[1] || w[2] >= w[3]) return rejectOption(s, r, "the window is empty");
  s.globals.options.cropWindow = w;
}

// The lens of PxrCamera (RenderMan 21 and later), in the units of DepthOfField. Out of range it is a pinhole.
void pxrLens(Options& o, const ParamList& params) {
  const auto positive = [&](const char* name) {
    const Param* p = findParam(params, name);
    const float value = p ? p->number(0) : 0;
    return value > 0 && value < kRiInfinity ? value : 0;
  };
  const float stop = positive("fStop"), length = positive("focalLength"), distance = positive("focalDistance");
  if (stop > 0 && length > 0 && distance > 0) {
    o.fStop = stop;
    o.focalLength = length;
    o.focalDistance = distance;
  }
}

void projection(GraphicsState& s, const Request& r) {
  if (s.world) return rejectOption(s, r, "the camera cannot change after WorldBegin");
  const std::string& kind = r.args[0].strings[0];
  Options& o = s.globals.options;
  if (kind == "perspective" || kind == "PxrPerspective" || kind == "PxrCamera")
    o.projection = ProjectionKind::Perspective;
  else if (kind == "orthographic" || kind == "PxrOrthographic")
    o.projection = ProjectionKind::Orthographic;
  else if (kind == "null")
    o.projection = ProjectionKind::Null;
  else
    return rejectOption(s, r, "unknown projection \"" + kind + "\"");
  o.fov_degrees = Options().fov_degrees;
  const bool camera = kind == "PxrCamera";
  if (camera) pxrLens(o, r.params);
  for (const Param& p : r.params) {
    const float fov = p.number(90);
    if (camera && (p.name == "fStop" || p.name == "focalLength" || p.name == "focalDistance")) continue;
    if (p.name != "fov")
      s.warn(r, "rib-unsupported", "parameter \"" + p.name + "\" is not supported, ignored");
    else if (fov > 0 && fov < 180)
      o.fov_degrees = fov;
    else
      rejectOption(s, r, fmt::format("a field of view of {} degrees", fov));
  }
  s.scope.ctm = Motion();
}

void clipping(GraphicsState& s, const Request& r) {
  const std::vector<float>& a = r.args[0].numbers;
  if (!(a[1] > a[0])) return rejectOption(s, r, "the far plane is not beyond the near plane");
  s.globals.options.nearClip = clamped(s, r, a[0], 1e-6f, kRiInfinity);  // RI_EPSILON
  s.globals.options.farClip = std::min(a[1], kRiInfinity);
}

// RISpec 3.2 section 4.1.2: the side that the normal points to is clipped. The plane is in the space of the request.
void clippingPlane(GraphicsState& s, const Request& r) {
  const RibArg& a = r.args[0];
  const mat4 m = s.cameraFromObject().at(s.globals.options.shutterOpen);
  const mat3 linear(m);
  if (asVec3(a, 3) == vec3(0) || glm::determinant(linear) == 0) return rejectOption(s, r, "the plane has no normal");
  const vec3 point = transformPoint(m, asVec3(a));
  const vec3 normal = normalizeOr(glm::transpose(glm::inverse(linear)) * asVec3(a, 3), vec3(0, 0, 1));
  s.globals.options.clippingPlanes.emplace_back(normal, -dot(normal, point));
}

void relativeDetail(GraphicsState& s, const Request& r) {
  const float factor = r.args[0].number();
  if (!(factor >= 0)) return rejectOption(s, r, fmt::format("{} is no factor", factor));
  s.globals.options.relativeDetail = factor;
}

void depthOfField(GraphicsState& s, const Request& r) {
  Options& o = s.globals.options;
  if (r.args.empty()) {
    o.fStop = kInfinity;
    return;
  }
  const std::vector<float>& a = r.args[0].numbers;
  if (!(a[0] > 0 && a[1] > 0 && a[2] > 0)) return rejectOption(s, r, "lens values must be positive");
  o.fStop = a[0];
  o.focalLength = a[1];
  o.focalDistance = a[2];
}

void shutter(GraphicsState& s, const Request& r) {
  const std::vector<float>& a = r.args[0].numbers;
  if (a[1] < a[0]) return rejectOption(s, r, "the shutter closes before it opens");
  s.globals.options.shutterOpen = a[0];
  s.globals.options.shutterClose = a[1];
}

void pixelSamples(GraphicsState& s, const Request& r) {
  const auto samples = [&](float n) { return static_cast<int>(clamped(s, r, n, 1, kMostSamples)); };
  s.globals.options.xSamples = samples(r.args[0].numbers[0]);
  s.globals.options.ySamples = samples(r.args[0].numbers[1]);
}

void pixelFilter(GraphicsState& s, const Request& r) {
  const std::vector<float>& width = r.args[1].numbers;
  if (!(width[0] > 0 && width[1] > 0)) return rejectOption(s, r, "filter widths must be positive");
  s.globals.options.filter = r.args[0].strings[0];
  s.globals.options.xFilterWidth = clamped(s, r, width[0], kNarrowestFilter_px, kWidestFilter_px);
  s.globals.options.yFilterWidth = clamped(s, r, width[1], kNarrowestFilter_px, kWidestFilter_px);
}

void exposure(GraphicsState& s, const Request& r) {
  const std::vector<float>& a = r.args[0].numbers;
  if (!(a[1] > 0)) return rejectOption(s, r, "gamma must be positive");
  s.globals.options.exposureGain = a[0];
  s.globals.options.exposureGamma = a[1];
}

void option(GraphicsState& s, const Request& r) {
  const std::string& category = r.args[0].strings[0];
  for (const Param& p : r.params) {
    const std::string key = category + ":" + p.name;
    s.globals.options.user[key] = p;
    if (!setNamedOption(s, r, key, p)) warnOfIgnored(s, r, key);
  }
}

}  // namespace

float clamped(GraphicsState& s, const Request& r, float value, float least, float most) {
  const float out = std::clamp(value, least, most);
  const bool isNamed = (r.name == "Option" || r.name == "Attribute") && !r.params.empty();
  const std::string name = isNamed ? fmt::format("\"{}\": ", r.args[0].strings[0]) : std::string();
  if (out != value) s.warn(r, "rib-clamped", fmt::format("{}{} is out of range, {} is used", name, value, out));
  return out;
}

void warnOfIgnored(GraphicsState& s, const Request& r, const std::string& key) {
  const std::string what = r.name + " " + key, reason = reasonFor(what);
  const bool option = r.name == "Option";
  const char* code = reason.empty() ? option ? "rib-unknown-option" : "rib-unknown-attribute"
                     : option       ? "rib-ignored-option"
                                    : "rib-ignored-attribute";
  const Severity severity = option && !reason.empty() ? Severity::Note : Severity::Warning;
  s.warnOnce(what, r, code, r.name + " \"" + key + "\" has no effect here" + reason, severity);
}

const HandlerTable& optionHandlers() {
  static const HandlerTable table = {
      {"Format", format},
      {"FrameAspectRatio", frameAspectRatio},
      {"ScreenWindow", screenWindow},
      {"CropWindow", cropWindow},
      {"Projection", projection},
      {"Clipping", clipping},
      {"ClippingPlane", clippingPlane},
      {"RelativeDetail", relativeDetail},
      {"DepthOfField", depthOfField},
      {"Shutter", shutter},
      {"PixelSamples", pixelSamples},
      {"PixelFilter", pixelFilter},
      {"Exposure", exposure},
      {"Option", option},
      {"Imager", [](GraphicsState& s, const Request& r) { s.globals.options.imager = makeShaderCall(s, r); }},
  };
  return table;
}

}  // namespace tomales::rib
