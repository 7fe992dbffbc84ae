#include "reyes/app/denoise/command.h"

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "reyes/app/denoise/filter.h"
#include "reyes/app/exit_code.h"
#include "reyes/base/chunk_file.h"
#include "reyes/base/unfinished_file.h"
#include "reyes/image.h"
#include "reyes/image_files.h"
#include "reyes/pictures.h"

namespace tomales {
namespace {

/// The header attribute that states that a picture was denoised, and the remaining error.
constexpr const char* kDenoised = "tomales:denoised";
constexpr std::array<const char*, 3> kColor{"R", "G", "B"};

/// A guide, and the names that its channels may have. The first set of channels that exists is used.
struct Guide {
  const char* display;  ///< The name for a Display that makes it.
  std::vector<std::vector<std::string>> names;
};
const std::array kGuides{Guide{"albedo", {{"albedo.R", "albedo.G", "albedo.B"}, {"albedo.r", "albedo.g", "albedo.b"}}},
                         Guide{"normal",
                               {{"normal.X", "normal.Y", "normal.Z"},
                                {"normal.x", "normal.y", "normal.z"},
                                {"N.X", "N.Y", "N.Z"},
                                {"N.x", "N.y", "N.z"}}},
                         Guide{"z", {{"Z"}, {"z"}}}};

std::vector<int> channelsOf(const Guide& guide, const Image& picture, const std::string& file) {
  for (const std::vector<std::string>& names : guide.names) {
    std::vector<int> out;
    for (const std::string& name : names)
      if (const int c = picture.channelIndex(name); c >= 0) out.push_back(c);
    if (out.size() == names.size()) return out;
  }
  throw FileError(
      fmt::format("\"{}\" has no channel of \"{}\", which guides the filter: add it to the Display, as in "
                  "\"Ci,a,z,albedo,normal\"",
                  file, guide.display));
}

/// Reads one channel. Infinite values, as depth has where nothing is seen, become the largest finite one.
Plane planeOf(const Image& picture, int channel, bool isDepth, const std::string& file) {
  Plane out;
  float farthest = 0;
  for (size_t i = static_cast<size_t>(channel); i < picture.pixels.size(); i += picture.channels.size()) {
    out.push_back(picture.pixels[i]);
    if (std::isfinite(out.back())) farthest = std::max(farthest, out.back());
  }
  for (size_t i = 0; i < out.size(); ++i) {
    if (isDepth && out[i] > farthest) out[i] = farthest;
    if (!std::isfinite(out[i]))
      throw FileError(fmt::format("\"{}\": channel \"{}\" is no number at pixel {},{}", file,
                                  picture.channels[static_cast<size_t>(channel)],
                                  picture.originX + static_cast<int>(i) % picture.width,
                                  picture.originY + static_cast<int>(i) / picture.width));
  }
  return out;
}

Image readHalf(const std::string& file) {
  std::string error;
  if (const auto picture = openPicture(file, error); picture && !picture->text(kDenoised).empty())
    throw FileError("\"" + file + "\" is denoised already: give the two pictures that it was made of");
  Image out = readParts(file);
  for (const char* c : kColor)
    if (out.channelIndex(c) < 0) throw FileError(fmt::format("\"{}\" has no channel \"{}\"", file, c));
  return out;
}

void refuseStrangers(const Image& a, const Image& b, const DenoiseCommand& command) {
  const auto refuse = [&](const std::string& why) {
    throw FileError(
        fmt::format("\"{}\" and \"{}\" are not two pictures of one frame: {}", command.first, command.second, why));
  };
  if (a.width != b.width || a.height != b.height || a.originX != b.originX || a.originY != b.originY)
    refuse(
        fmt::format("one has {}x{} pixels, the other {}x{}, or another window", a.width, a.height, b.width, b.height));
  bool same = true;
  for (const char* c : kColor)
    for (size_t i = 0; same && i < static_cast<size_t>(a.width) * static_cast<size_t>(a.height); ++i)
      same = a.pixels[i * a.channels.size() + static_cast<size_t>(a.channelIndex(c))] ==
             b.pixels[i * b.channels.size() + static_cast<size_t>(b.channelIndex(c))];
  if (same) refuse("their colours are the same; render one with another --light-seed");
}

HalfBuffers halvesOf(const Image& a, const Image& b, const DenoiseCommand& command) {
  HalfBuffers out{a.width, a.height, {}, {}, {}};
  for (size_t c = 0; c < kColor.size(); ++c) {
    out.a[c] = planeOf(a, a.channelIndex(kColor[c]), false, command.first);
    out.b[c] = planeOf(b, b.channelIndex(kColor[c]), false, command.second);
  }
  for (const Guide& guide : kGuides) {
    const bool isDepth = guide.names.front().size() == 1;
    const std::vector<int> first = channelsOf(guide, a, command.first), second = channelsOf(guide, b, command.second);
    for (size_t k = 0; k < first.size(); ++k) {
      Plane plane = planeOf(a, first[k], isDepth, command.first);
      const Plane other = planeOf(b, second[k], isDepth, command.second);
      for (size_t i = 0; i < plane.size(); ++i) plane[i] = 0.5f * (plane[i] + other[i]);
      out.guides.push_back(std::move(plane));
    }
  }
  return out;
}

Image pictureOf(const Denoised& denoised, const Image& like) {
  Image out{like.width, like.height, {kColor.begin(), kColor.end()}, {}, like.originX, like.originY, 0, 0};
  for (size_t i = 0; i < denoised.color[0].size(); ++i)
    for (const Plane& plane : denoised.color) out.pixels.push_back(plane[i]);
  return out;
}

void denoisePictures(const DenoiseCommand& command) {
  const Image a = readHalf(command.first), b = readHalf(command.second);
  refuseStrangers(a, b, command);
  const Denoised result = denoise(halvesOf(a, b, command));
  const std::string stated = fmt::format("root mean square error {:.2f} % of the mean, {:.2f} % before",
                                         100 * result.after, 100 * result.before);
  replaceChannels(command.first, command.output, pictureOf(result, a),
                  {{kDenoised, stated}, {kContents, ""}, {kStatistics, ""}});
  fmt::print("{}: {}\n", command.output, stated);
}

}  // namespace

int denoiseCommand(const DenoiseCommand& command) {
  Log log;
  if (isAmong(command.output, {command.first, command.second})) {
    log.report(Severity::Output, "output-input", {},
               "\"" + command.output + "\" is one of the pictures that are read, and is not written over");
    return exitCodeOf(log);
  }
  try {
    denoisePictures(command);
  } catch (const std::exception& e) {
    log.report(severityOf(e), "denoise", {}, messageOf(e));
  }
  return exitCodeOf(log);
}

}  // namespace tomales
