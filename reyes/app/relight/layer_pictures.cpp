#include "reyes/app/relight/layer_pictures.h"

#include <set>

#include "reyes/app/frame/frame_shaders.h"
#include "reyes/surface_variables.h"

namespace tomales {
namespace {

/// Returns the value of the variable that ShotJob::prepareToShow() has been asked for; a number is a grey.
vec3 variableAt(const Image& rows, int x, int y, const std::string& variable) {
  constexpr int kAlpha = 3, kDepth = 4, kFirst = 5;  // R G B A Z come first
  const float* pixel = rows.at(x, y);
  if (rows.channelCount() >= kFirst + 3) return {pixel[kFirst], pixel[kFirst + 1], pixel[kFirst + 2]};
  return vec3(pixel[rows.channelCount() > kFirst ? kFirst : variable == "z" ? kDepth : kAlpha]);
}

}  // namespace

std::vector<std::string> variablesOf(const Options& options) {
  std::set<std::string> out;
  for (const SurfaceVariable& v : kSurfaceVariables)
    if ((v.kind == ChannelKind::Variable && v.source != VariableSource::Noise) || v.name == "a" || v.name == "z")
      out.emplace(v.name);
  for (const auto& [name, channel] : options.channels) out.insert(name);
  return {out.begin(), out.end()};
}

LayerPictures::LayerPictures(const PixelRect& window, size_t layers)
    : window_(window),
      variableLayer_(layers - 1),
      store_(window, layers),
      glow_(static_cast<size_t>(window.width()) * static_cast<size_t>(window.height())) {}

size_t LayerPictures::placeOf(int x, int y) const {
  return static_cast<size_t>(y - window_.y0) * static_cast<size_t>(window_.width()) +
         static_cast<size_t>(x - window_.x0);
}

std::vector<float> LayerPictures::finished() const {
  const std::lock_guard lock(mutex_);
  return finished_;
}

void LayerPictures::take(const WorkStep& step, const Image& rows, const ShotJob& job) {
  const PixelRect part{rows.originX, rows.originY, rows.originX + rows.width, rows.originY + rows.height};
  const bool isVariable = step.layer == variableLayer_;
  Image finished = rows;
  if (step.layer == kWhole) {
    expose(finished, job.shot().scene.options);
    runImager(finished, job.job().shading());
  }
  // An imager's picture is shown as it is.
  const Image& shown = step.layer == kWhole && job.job().shading().hasImager() ? finished : rows;
  std::vector<vec3> rgb;
  for (int y = 0; y < rows.height; ++y)
    for (int x = 0; x < rows.width; ++x) {
      vec3& glow = glow_[placeOf(part.x0 + x, part.y0 + y)];
      vec3 color = isVariable ? variableAt(rows, x, y, step.variable) : colorAt(shown, x, y);
      if (step.layer == kGlow) glow = color;
      if (step.layer >= kFirstLight && !isVariable) color -= glow;
      rgb.push_back(color);
    }
  store_.put(step.layer, part, rgb, step.number);
  if (step.layer == kWhole) takeFinished(finished);
}

void LayerPictures::takeFinished(const Image& rows) {
  const std::lock_guard lock(mutex_);
  finished_.resize(3 * glow_.size());
  for (int y = 0; y < rows.height; ++y)
    for (int x = 0; x < rows.width; ++x)
      std::copy_n(rows.at(x, y), 3, finished_.data() + 3 * placeOf(rows.originX + x, rows.originY + y));
}

void LayerPictures::subtractGlow(size_t layer, std::vector<vec3>& colors) {
  if (layer == kGlow) {
    coarseGlow_ = colors;
  } else {
    for (size_t i = 0; i < colors.size(); ++i) colors[i] -= coarseGlow_[i];
  }
}

}  // namespace tomales
