#include "reyes/image/display_format.h"

#include <filesystem>

#include "reyes/base/search_path.h"
#include "reyes/base/text.h"
#include "reyes/base/trust.h"
#include "reyes/display_driver.h"
#include "reyes/image/formats.h"

namespace tomales {
namespace {

constexpr std::string_view kHeader = "exrheader_";

/// Parameters that pictures of every format take. "asrgba" asks for Ci and a as R G B A, which is so here anyway.
bool everyFormatTakes(const std::string& name) {
  static constexpr std::string_view kNames[] = {"transfer", "compression", "exrcompression", "quantize", "dither",
                                                "filter",   "filterwidth", "exposure",       "origin",   "asrgba"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

/// Tells whether the Display's type decides which data are written, and not only the format.
bool writesPass(const DisplayCall& display) { return writesMap(display) || writesDeep(display); }

std::string compressionOf(const DisplayCall& display) {
  const std::string plain = displayText(display, "compression");
  return plain.empty() ? displayText(display, "exrcompression") : plain;
}

std::string pixelTypeOf(const DisplayCall& display) {
  const std::string exr = displayText(display, "exrpixeltype");
  return exr.empty() ? displayText(display, "type") : exr;
}

std::vector<Metadata> metadataOf(const DisplayCall& display) {
  // Linear light has the primaries of Rec. 709 and sRGB, unless the Display says otherwise.
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

/// Tells whether the type of this Display is left to drivers.
bool namesDriver(const DisplayCall& display) {
  return !writesPass(display) && display.type != "file" && display.type != "null" && !formatOfType(display.type);
}

/// Returns the format that the type of a Display asks for; null if it leaves that to the file's name.
const PictureFormat* formatOfItsType(const DisplayCall& display) {
  return writesPass(display) ? pictureFormats().front() : formatOfType(display.type);
}

const PictureFormat& formatOf(const DisplayCall& display) {
  const PictureFormat* kind = formatOfItsType(display);
  if (!kind) kind = formatOfExtension(display.name);
  return kind ? *kind : *pictureFormats().front();
}

void setCompression(const DisplayCall& display, FileFormat& format, Log& log) {
  const std::string asked = compressionOf(display);
  if (asked.empty()) return;
  const Words& known = format.kind->compressions;
  if (std::find(known.begin(), known.end(), asked) != known.end())
    format.compression = asked;
  else
    log.report(Severity::Warning, "display-compression", display.where,
               "Display \"" + display.name + "\": files of type " + format.kind->name + " have no compression \"" +
                   asked + "\"; ignored");
}

void warnOfWhatOthersHave(const DisplayCall& display, const PictureFormat& format, Log& log) {
  for (const Param& p : display.params)
    if (anyFormatTakes(p.name) && !format.takes(p.name))
      log.report(
          Severity::Warning, "display-parameter", display.where,
          "Display \"" + display.name + "\": files of type " + format.name + " have no \"" + p.name + "\"; ignored");
}

}  // namespace

std::string displayText(const DisplayCall& display, const char* name) {
  const Param* p = findParam(display.params, name);
  return p && !p->strings.empty() ? lowerCase(p->strings[0]) : "";
}

void warnAboutParams(const DisplayCall& display, Log& log) {
  const auto warn = [&](const std::string& what) {
    log.report(Severity::Warning, "display-parameter", display.where,
               "Display \"" + display.name + "\": " + what + "; ignored");
  };
  for (const Param& p : display.params)
    if (!everyFormatTakes(p.name) && !anyFormatTakes(p.name))
      warn("no parameter \"" + p.name + "\"");
    else if (p.name == "origin" && std::any_of(p.ints.begin(), p.ints.end(), [](int at) { return at != 0; }))
      warn("\"origin\" is a place in a frame buffer, and this is a file");
  const std::string transfer = displayText(display, "transfer"), type = pixelTypeOf(display);
  if (!transfer.empty() && transfer != "srgb" && transfer != "linear") warn("no transfer \"" + transfer + "\"");
  if (!type.empty() && type != "half" && type != "float") warn("no pixel type \"" + type + "\"");
}

void warnOfUnreadParams(const DisplayCall& display, const std::vector<std::string>& unread, Log& log) {
  static constexpr std::string_view kOurs[] = {"filter", "filterwidth", "exposure", "origin", "asrgba"};
  for (const std::string& name : unread)
    if (std::find(std::begin(kOurs), std::end(kOurs), name) == std::end(kOurs))
      log.report(Severity::Warning, "display-parameter", display.where,
                 "Display \"" + display.name + "\": display driver \"" + display.type + "\" has no parameter \"" +
                     name + "\"; ignored");
}

std::string driverOf(const DisplayCall& display, const Options& options, const PluginTrust& trust) {
  if (!namesDriver(display)) return {};
  if (std::string supplied = suppliedDriver(display.type); !supplied.empty()) return supplied;
  const PluginFiles found = findPlugins(display.type, pathOf(options.searchPaths, "display"), trust);
  return found.trusted.empty() ? std::string() : found.trusted.front();
}

void warnOfRefusedDriver(const DisplayCall& display, const Options& options, const PluginTrust& trust, Log& log) {
  if (!namesDriver(display)) return;
  for (const std::string& file : findPlugins(display.type, pathOf(options.searchPaths, "display"), trust).refused)
    log.report(Severity::Missing, "display-plugin", display.where, file + " " + kPluginRefusal);
}

std::string fileOf(const DisplayCall& display) {
  if (formatOfItsType(display) || formatOfExtension(display.name)) return display.name;
  return std::filesystem::path(display.name).replace_extension(formatOf(display).extensions.front()).string();
}

std::string partialName(const std::string& path) {
  const std::filesystem::path name = std::filesystem::path(path).filename();
  return name.stem().string() + ".partial" + name.extension().string();
}

void addHeader(DisplayCall& display, const std::string& name, const std::string& text) {
  if (!formatOf(display).carriesNames) return;
  Param p;
  p.name = std::string(kHeader) + name;
  p.type = ValueType::String;
  p.strings = {text};
  display.params.push_back(std::move(p));
}

FileFormat formatOf(const DisplayCall& display, Log& log) {
  const PictureFormat* kind = &formatOf(display);
  if (!formatOfItsType(display) && display.type != "file")
    log.report(Severity::Warning, "display-type", display.where,
               "Display \"" + display.name + "\": no display type \"" + display.type + "\"; \"" + fileOf(display) +
                   "\" is written, of type " + kind->name);
  FileFormat format{kind, kind->usualType()};
  setCompression(display, format, log);
  if (kind->carriesNames) setExr(display, format);
  warnOfWhatOthersHave(display, *kind, log);
  return format;
}

}  // namespace tomales
