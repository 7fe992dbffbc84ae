#include "reyes/app/commands/compare_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "reyes/app/exit_code.h"
#include "reyes/image.h"
#include "reyes/image_compare.h"
#include "reyes/image_files.h"

namespace tomales {
namespace {

using Json = nlohmann::ordered_json;

std::optional<Image> load(const std::string& path, Log& log) {
  std::string error;
  std::optional<Image> image = readImage(path, error);
  if (!image)
    log.report(Severity::Error, "image-read", {std::make_shared<std::string>(path), 0},
               "cannot be read as a picture: " + error);
  return image;
}

/// Tells whether there are colours to compare: a map of depth has none.
bool hasColors(const Image& image) {
  return std::any_of(image.channels.begin(), image.channels.end(),
                     [](const std::string& name) { return name != "A" && name != "Z"; });
}

Json figuresOf(const Comparison& c) {
  Json out{{"rmse", c.rmse},
           {"relative_mse", c.relativeMse},
           {"mean_absolute_relative_error", c.meanAbsoluteRelativeError},
           {"max_error", c.maxError},
           {"psnr_dB", c.psnr_dB},
           {"ssim", c.ssim},
           {"flip_like", c.flip},
           {"smudges", c.smudges[0]},
           {"specks", c.specks},
           {"different_pixels", c.differentPixels}};
  for (size_t i = 1; i < kSmudgeSizes.size(); ++i) out[fmt::format("smudges_{}", kSmudgeSizes[i])] = c.smudges[i];
  return out;
}

}  // namespace

int compareCommand(const std::string& test, const std::string& reference, const std::string& differenceFile,
                   bool json) {
  Log log;
  const std::optional<Image> a = load(test, log), b = load(reference, log);
  if (!a || !b) return exitCodeOf(log);
  if (a->width != b->width || a->height != b->height) {
    log.report(Severity::Error, "image-size", {std::make_shared<std::string>(test), 0},
               fmt::format("{}x{} pixels cannot be compared with {}x{} of \"{}\"", a->width, a->height, b->width,
                           b->height, reference));
    return exitCodeOf(log);
  }
  for (const auto& [image, file] : {std::pair(&*a, &test), std::pair(&*b, &reference)})
    if (!hasColors(*image))
      log.report(Severity::Error, "image-size", {std::make_shared<std::string>(*file), 0},
                 fmt::format("has no colours to compare, but {}", fmt::join(image->channels, ", ")));
  if (log.worst() >= Severity::Error) return exitCodeOf(log);
  const Json figures = figuresOf(compare(*a, *b));
  if (json)
    std::puts(figures.dump(2).c_str());
  else
    for (const auto& [name, value] : figures.items())
      std::puts(fmt::format("{:<30} {:.8g}", name, value.get<double>()).c_str());
  if (!differenceFile.empty()) writeImage(differenceFile, differenceImage(*a, *b), true, log);
  return exitCodeOf(log);
}

}  // namespace tomales
