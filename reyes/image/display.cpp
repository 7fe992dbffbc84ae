#include <filesystem>

#include "reyes/base/rng.h"
#include "reyes/image/image_file.h"

namespace tomales {
namespace {

/// The channels of `mode`, in its order. Empty: it names one that does not exist.
std::vector<std::string> channelsOf(const std::string& mode) {
  std::vector<std::string> out;
  for (const char c : mode) {
    if (std::string("rgbaz").find(c) == std::string::npos) return {};
    out.emplace_back(1, static_cast<char>(c - 'a' + 'A'));
  }
  return out;
}

Image pick(const Image& image, const std::vector<std::string>& channels) {
  Image out = image;
  out.channels = channels;
  out.pixels.clear();
  std::vector<int> from;
  for (const std::string& name : channels) from.push_back(image.channelIndex(name));
  for (size_t i = 0; i < image.pixels.size(); i += image.channels.size())
    for (const int c : from) out.pixels.push_back(c < 0 ? 0.0f : image.pixels[i + static_cast<size_t>(c)]);
  return out;
}

// RISpec 3.2 section 4.1.7: round(one * value + dither * random), clamped. Random numbers are named by pixel
// and channel.
void quantise(Image& image, const Quantize& q, float limit) {
  const float low = std::max(q.min, 0.0f), high = std::min(q.max, limit);
  const int channels = image.channelCount();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < channels; ++c) {
        float& v = image.at(x, y)[c];
        const uint32_t name = hashCombine(static_cast<uint32_t>(x + image.originX),
                                          static_cast<uint32_t>(y + image.originY), static_cast<uint32_t>(c));
        const float noisy = std::floor(q.one * v + q.dither * (2 * unitFloat(name) - 1) + 0.5f);
        v = noisy > low ? std::min(noisy, high) : low;  // NaN becomes the minimum
      }
}

// PNG wants colour that is not multiplied by alpha, and encodes that.
void encodeForScreen(Image& image) {
  const int alpha = image.channelIndex("A");
  for (size_t i = 0; i < image.pixels.size(); i += image.channels.size()) {
    const float a = alpha < 0 ? 1.0f : image.pixels[i + static_cast<size_t>(alpha)];
    for (size_t c = 0; c < image.channels.size(); ++c)
      if (static_cast<int>(c) != alpha)
        image.pixels[i + c] = encodeSrgb(a > 0 ? image.pixels[i + c] / a : 0.0f);
  }
}

FileFormat formatOfType(const std::string& type) {
  if (type == "openexr" || type == "exr") return {"openexr", SampleType::Float};
  if (type == "tiff" || type == "tif") return {"tiff", SampleType::UInt8};
  if (type == "png") return {"png", SampleType::UInt8};
  return {"", SampleType::Float};
}

/// A string parameter of a Display, in lower case; empty if it is not there.
std::string text(const DisplayCall& display, const char* name) {
  const Param* p = findParam(display.params, name);
  std::string value = p && !p->strings.empty() ? p->strings[0] : "";
  for (char& c : value) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return value;
}

void warnAboutParams(const DisplayCall& display, Log& log) {
  const auto warn = [&](const std::string& what) {
    log.report(Severity::Warning, "display-parameter", display.where,
               "Display \"" + display.name + "\": " + what + "; ignored");
  };
  for (const Param& p : display.params)
    if (p.name != "transfer" && p.name != "exrpixeltype") warn("no parameter \"" + p.name + "\"");
  const std::string transfer = text(display, "transfer"), type = text(display, "exrpixeltype");
  if (!transfer.empty() && transfer != "srgb" && transfer != "linear")
    warn("no transfer \"" + transfer + "\"");
  if (!type.empty() && type != "half" && type != "float") warn("no exrpixeltype \"" + type + "\"");
}

/// Decides file format, and the name where the Display leaves it open (RISpec's "ri.pic" has a format of no
/// one's).
FileFormat formatOf(const DisplayCall& display, std::string& path, Log& log) {
  FileFormat format = formatOfType(display.type);
  if (format.name.empty()) {
    if (display.type != "file")
      log.report(
          Severity::Warning, "display-type", display.where,
          "Display \"" + display.name + "\": no display type \"" + display.type + "\"; written as a file");
    format = formatOfExtension(path);
  }
  if (format.name.empty()) {
    format = {"openexr", SampleType::Float};
    path = std::filesystem::path(path).replace_extension(".exr").string();
  }
  if (format.name == "openexr" && text(display, "exrpixeltype") == "half") format.type = SampleType::Half;
  return format;
}

std::vector<std::string> channelsToWrite(const DisplayCall& display, Log& log) {
  std::vector<std::string> channels = channelsOf(display.mode);
  if (!channels.empty()) return channels;
  log.report(Severity::Warning, "display-mode", display.where,
             "Display \"" + display.name + "\": no channels \"" + display.mode + "\"; rgba is written");
  return channelsOf("rgba");
}

/// Fits type and pixels of an integer format to Quantize. False: the format cannot hold what is asked for.
bool prepareIntegers(Image& image, FileFormat& format, const DisplayCall& display, const Options& options,
                     Log& log) {
  const bool depth = image.channelIndex("Z") >= 0;
  Quantize q = depth && image.channels.size() == 1 ? options.depthQuantize : options.rgbaQuantize;
  if ((depth && image.channels.size() > 1) || q.one <= 0) {
    if (format.name == "tiff") {
      format.type = SampleType::Float;
      return true;
    }
    if (depth) return false;
    log.report(Severity::Warning, "display-quantize", display.where,
               "Display \"" + display.name + "\": PNG holds no floating point numbers; quantised to 8 bits");
    q = Quantize{};
  }
  if (text(display, "transfer") == "srgb" && !depth) {
    encodeForScreen(image);
    format.unassociatedAlpha = true;
  }
  const bool wide = q.one > 255 || q.max > 255;
  format.type = wide ? SampleType::UInt16 : SampleType::UInt8;
  quantise(image, q, wide ? 65535.0f : 255.0f);
  return true;
}

bool writeReporting(const std::string& path, const Image& image, const FileFormat& format,
                    const SourceLoc& where, Log& log) {
  std::string error;
  if (writeFile(path, image, format, error)) return true;
  log.report(Severity::Output, "image-write", where, "\"" + path + "\" could not be written: " + error);
  return false;
}

}  // namespace

float encodeSrgb(float linear) {
  const float v = linear > 0 ? std::min(linear, 1.0f) : 0.0f;
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

void expose(Image& image, const Options& options) {
  for (const char* name : {"R", "G", "B"}) {
    const int channel = image.channelIndex(name);
    for (size_t i = static_cast<size_t>(channel); channel >= 0 && i < image.pixels.size();
         i += image.channels.size()) {
      float& v = image.pixels[i];
      v *= options.exposureGain;
      if (options.exposureGamma != 1) v = std::pow(std::max(v, 0.0f), 1 / options.exposureGamma);
    }
  }
}

bool writeDisplay(const Image& image, const DisplayCall& display, const Options& options, Log& log) {
  warnAboutParams(display, log);
  std::string path = display.name;
  FileFormat format = formatOf(display, path, log);
  Image picked = pick(image, channelsToWrite(display, log));
  if (format.name != "openexr" && !prepareIntegers(picked, format, display, options, log)) {
    log.report(Severity::Output, "display-depth", display.where,
               "\"" + path + "\" could not be written: PNG holds no depth; use OpenEXR or TIFF");
    return false;
  }
  return writeReporting(path, picked, format, display.where, log);
}

bool writeImage(const std::string& path, const Image& image, bool srgb, Log& log) {
  FileFormat format = formatOfExtension(path);
  if (format.name.empty()) {
    log.report(Severity::Output, "image-write", {},
               "\"" + path + "\" could not be written: its extension names none of exr, tif, png");
    return false;
  }
  Image copy = image;
  if (format.type == SampleType::UInt8) {
    if (srgb) encodeForScreen(copy);
    format.unassociatedAlpha = srgb;
    quantise(copy, Quantize{255, 0, 255, 0}, 255);
  }
  return writeReporting(path, copy, format, {}, log);
}

}  // namespace tomales
