#include "reyes/image/display_format.h"

#include <filesystem>

namespace tomales {
namespace {

FileFormat formatOfType(const std::string& type) {
  if (type == "openexr" || type == "exr") return {"openexr", SampleType::Float};
  if (type == "shadow" || type == "zfile" || type == "deepshad" || type == "deepexr")
    return {"openexr", SampleType::Float};
  if (type == "tiff" || type == "tif") return {"tiff", SampleType::UInt8};
  if (type == "png") return {"png", SampleType::UInt8};
  return {"", SampleType::Float};
}

constexpr std::string_view kOnlyExr[] = {"exrpixeltype",   "type",       "tiled",       "multipart",
                                         "chromaticities", "mergedepth", "mergeopacity"};
constexpr std::string_view kHeader = "exrheader_";

bool knowsParam(const std::string& name) {
  static constexpr std::string_view kNames[] = {"transfer",       "exrpixeltype",   "type",        "compression",
                                                "exrcompression", "tiled",          "multipart",   "quantize",
                                                "dither",         "filter",         "filterwidth", "exposure",
                                                "origin",         "chromaticities", "mergedepth",  "mergeopacity",
                                                "asrgba"};  // asrgba: Ci and a are R G B A here anyway
  return name.starts_with(kHeader) || std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

std::string compressionOf(const DisplayCall& display) {
  const std::string plain = displayText(display, "compression");
  return plain.empty() ? displayText(display, "exrcompression") : plain;
}

std::string pixelTypeOf(const DisplayCall& display) {
  const std::string exr = displayText(display, "exrpixeltype");
  return exr.empty() ? displayText(display, "type") : exr;
}

std::vector<Metadata> metadataOf(const DisplayCall& display) {
  // Linear light of the primaries of Rec. 709 and sRGB, unless the Display says otherwise.
  Metadata primaries{"chromaticities", "", {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f}};
  if (const Param* p = findParam(display.params, "chromaticities"); p && p->floats.size() == 8)
    primaries.numbers = p->floats;
  std::vector<Metadata> out{primaries};
  for (const Param& p : display.params) {
    if (!p.name.starts_with(kHeader)) continue;
    Metadata m{p.name.substr(kHeader.size()), p.strings.empty() ? "" : p.strings[0], p.floats};
    for (const int i : p.ints) m.numbers.push_back(static_cast<float>(i));
    out.push_back(std::move(m));
  }
  return out;
}

bool flag(const DisplayCall& display, const char* name) {
  const Param* p = findParam(display.params, name);
  return p && p->number(0) != 0;
}

void setExr(const DisplayCall& display, FileFormat& format) {
  if (pixelTypeOf(display) == "half") format.type = SampleType::Half;
  if (flag(display, "tiled")) format.tile = PictureFile::kBandRows;
  format.multipart = flag(display, "multipart");
  format.metadata = metadataOf(display);
}

void setCompression(const DisplayCall& display, FileFormat& format, Log& log) {
  static const std::vector<std::string_view> kExr = {"none",  "rle", "zip",  "zips", "piz",
                                                     "pxr24", "b44", "b44a", "dwaa", "dwab"};
  static const std::vector<std::string_view> kTiff = {"none", "rle", "zip", "zips", "lzw"}, kPng = {"zip"};
  const std::vector<std::string_view>& known = format.name == "openexr" ? kExr : format.name == "tiff" ? kTiff : kPng;
  const std::string asked = compressionOf(display);
  if (asked.empty()) return;
  if (std::find(known.begin(), known.end(), asked) != known.end())
    format.compression = asked;
  else
    log.report(Severity::Warning, "display-compression", display.where,
               "Display \"" + display.name + "\": files of type " + format.name + " have no compression \"" + asked +
                   "\"; ignored");
}

void warnOfWhatOnlyExrHas(const DisplayCall& display, const FileFormat& format, Log& log) {
  for (const Param& p : display.params)
    if (p.name.starts_with(kHeader) ||
        std::find(std::begin(kOnlyExr), std::end(kOnlyExr), p.name) != std::end(kOnlyExr))
      log.report(
          Severity::Warning, "display-parameter", display.where,
          "Display \"" + display.name + "\": files of type " + format.name + " have no \"" + p.name + "\"; ignored");
}

}  // namespace

std::string displayText(const DisplayCall& display, const char* name) {
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
    if (!knowsParam(p.name))
      warn("no parameter \"" + p.name + "\"");
    else if (p.name == "origin" && std::any_of(p.ints.begin(), p.ints.end(), [](int at) { return at != 0; }))
      warn("\"origin\" is a place in a frame buffer, and this is a file");
  const std::string transfer = displayText(display, "transfer"), type = pixelTypeOf(display);
  if (!transfer.empty() && transfer != "srgb" && transfer != "linear") warn("no transfer \"" + transfer + "\"");
  if (!type.empty() && type != "half" && type != "float") warn("no pixel type \"" + type + "\"");
}

FileFormat formatOf(const DisplayCall& display, std::string& path, Log& log) {
  FileFormat format = formatOfType(display.type);
  const bool unknown = format.name.empty() && display.type != "file";
  if (format.name.empty()) format = formatOfExtension(path);
  if (format.name.empty()) {
    format = {"openexr", SampleType::Float};
    path = std::filesystem::path(path).replace_extension(".exr").string();
  }
  if (unknown)
    log.report(Severity::Warning, "display-type", display.where,
               "Display \"" + display.name + "\": no display type \"" + display.type + "\"; \"" + path +
                   "\" is written, of type " + format.name);
  setCompression(display, format, log);
  if (format.name == "openexr")
    setExr(display, format);
  else
    warnOfWhatOnlyExrHas(display, format, log);
  return format;
}

}  // namespace tomales
