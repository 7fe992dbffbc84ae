#include "reyes/image/display_format.h"

#include <filesystem>

namespace tomales {
namespace {

FileFormat formatOfType(const std::string& type) {
  if (type == "openexr" || type == "exr") return {"openexr", SampleType::Float};
  if (type == "shadow" || type == "zfile" || type == "deepshad" || type == "deepexr") return {"openexr", SampleType::Float};
  if (type == "tiff" || type == "tif") return {"tiff", SampleType::UInt8};
  if (type == "png") return {"png", SampleType::UInt8};
  return {"", SampleType::Float};
}

constexpr std::string_view kCompressions[] = {"none", "rle", "zip", "zips", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};
constexpr std::string_view kOnlyExr[] = {"exrpixeltype", "type", "tiled", "multipart", "chromaticities", "mergedepth", "mergeopacity"};
constexpr std::string_view kHeader = "exrheader_";

bool knowsParam(const std::string& name) {
  static constexpr std::string_view kNames[] = {"transfer",    "exrpixeltype", "type",     "compression", "exrcompression",
                                                "tiled",       "multipart",    "quantize", "dither",      "filter",
                                                "filterwidth", "exposure",     "origin",   "chromaticities", "mergedepth",
                                                "mergeopacity", "asrgba"};  // asrgba: Ci and a are R G B A here anyway
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
  if (const Param* p = findParam(display.params, "chromaticities"); p && p->floats.size() == 8) primaries.numbers = p->floats;
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
  const std::string compression = compressionOf(display);
  if (std::find(std::begin(kCompressions), std::end(kCompressions), compression) != std::end(kCompressions))
    format.compression = compression;
  if (flag(display, "tiled")) format.tile = PictureFile::kBandRows;
  format.multipart = flag(display, "multipart");
  format.metadata = metadataOf(display);
}

/// TIFF takes some of OpenEXR's compressions; what else only OpenEXR has is named.
void setOther(const DisplayCall& display, FileFormat& format, Log& log) {
  const auto warn = [&](const char* code, const std::string& what) {
    log.report(Severity::Warning, code, display.where, "Display \"" + display.name + "\": " + what + "; ignored");
  };
  const std::string compression = compressionOf(display);
  const bool known = compression == "none" || compression == "rle" || compression == "zip" || compression == "zips";
  if (format.name == "tiff" && known)
    format.compression = compression;
  else if (!compression.empty())
    warn("display-compression", "a file of type " + format.name + " cannot be compressed by \"" + compression + "\"");
  for (const Param& p : display.params)
    if (p.name.starts_with(kHeader) || std::find(std::begin(kOnlyExr), std::end(kOnlyExr), p.name) != std::end(kOnlyExr))
      warn("display-parameter", "only OpenEXR files have \"" + p.name + "\"");
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
    if (!knowsParam(p.name)) warn("no parameter \"" + p.name + "\"");
  const std::string transfer = displayText(display, "transfer"), type = pixelTypeOf(display), compression = compressionOf(display);
  if (!transfer.empty() && transfer != "srgb" && transfer != "linear")
    warn("no transfer \"" + transfer + "\"");
  if (!type.empty() && type != "half" && type != "float") warn("no pixel type \"" + type + "\"");
  if (!compression.empty() &&
      std::find(std::begin(kCompressions), std::end(kCompressions), compression) == std::end(kCompressions))
    warn("no compression \"" + compression + "\"");
}

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
  if (format.name == "openexr")
    setExr(display, format);
  else
    setOther(display, format, log);
  return format;
}

}  // namespace tomales
