#include "reyes/image/formats.h"

#include <algorithm>
#include <filesystem>

#include "reyes/base/text.h"
#include "reyes/image_files.h"

namespace tomales {

// Each format is defined beside its writer.
const PictureFormat &exrFormat(), &tiffFormat(), &pngFormat();

namespace {

bool has(const Words& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Returns the extensions of all formats as "exr, tif, png" or "exr|.tif|.png": the first of each.
std::string extensions(const std::string& between) {
  std::string out;
  for (const PictureFormat* f : pictureFormats())
    out += (out.empty() ? "" : between) + std::string(f->extensions.front().substr(1));
  return out;
}

}  // namespace

std::span<const PictureFormat* const> pictureFormats() {
  static const PictureFormat* const kAll[] = {&exrFormat(), &tiffFormat(), &pngFormat()};
  return kAll;
}

bool PictureFormat::takes(std::string_view param) const {
  return std::any_of(params.begin(), params.end(), [&](std::string_view p) {
    return p.ends_with('*') ? param.starts_with(p.substr(0, p.size() - 1)) : param == p;
  });
}

std::vector<DisplayFormat> displayFormats() {
  const auto texts = [](const Words& words) { return std::vector<std::string>(words.begin(), words.end()); };
  std::vector<DisplayFormat> out;
  for (const PictureFormat* f : pictureFormats())
    out.push_back({f->name, f->title, texts(f->types), texts(f->extensions), texts(f->compressions), texts(f->params)});
  return out;
}

const PictureFormat* formatOfType(std::string_view displayType) {
  for (const PictureFormat* f : pictureFormats())
    if (displayType == f->name || has(f->types, displayType)) return f;
  return nullptr;
}

const PictureFormat* formatOfExtension(const std::string& path) {
  const std::string extension = endingOf(path);
  for (const PictureFormat* f : pictureFormats())
    if (has(f->extensions, extension)) return f;
  return nullptr;
}

bool anyFormatTakes(std::string_view param) {
  const auto all = pictureFormats();
  return std::any_of(all.begin(), all.end(), [&](const PictureFormat* f) { return f->takes(param); });
}

std::string floatFormats() {
  std::string out;
  for (const PictureFormat* f : pictureFormats())
    if (f->floats) out += (out.empty() ? "" : " or ") + std::string(f->title);
  return out;
}

bool namesPicture(const std::string& path) { return formatOfExtension(path) != nullptr; }

bool isForScreens(const std::string& path) {
  const PictureFormat* format = formatOfExtension(path);
  return format && format->isForScreens;
}

std::string pictureExtensions() { return extensions(", "); }
std::string pictureNames() { return "FILE." + extensions("|."); }

}  // namespace tomales
