#include "reyes/image/image_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <filesystem>

namespace tomales {
namespace {

namespace fs = std::filesystem;

OIIO::TypeDesc typeDesc(SampleType type) {
  switch (type) {
    case SampleType::Half:
      return OIIO::TypeDesc::HALF;
    case SampleType::UInt8:
      return OIIO::TypeDesc::UINT8;
    case SampleType::UInt16:
      return OIIO::TypeDesc::UINT16;
    default:
      return OIIO::TypeDesc::FLOAT;
  }
}

/// "layer" of "layer.X"; pictures and depth have layers of their own.
std::string layerOf(const std::string& channel) {
  const size_t dot = channel.rfind('.');
  if (dot != std::string::npos) return channel.substr(0, dot);
  if (channel == "Z") return "depth";
  return channel.size() == 1 && std::string("RGBA").find(channel) != std::string::npos ? "rgba" : channel;
}

void setMetadata(const FileFormat& format, OIIO::ImageSpec& spec) {
  for (const Metadata& m : format.metadata) {
    if (m.numbers.empty())
      spec.attribute(m.name, m.text);
    else if (m.numbers.size() == 16)
      spec.attribute(m.name, OIIO::TypeMatrix44, m.numbers.data());
    else
      spec.attribute(m.name, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, m.numbers.size() > 1 ? static_cast<int>(m.numbers.size()) : 0),
                     m.numbers.data());
  }
}

OIIO::ImageSpec specOf(const Image& image, const std::vector<std::string>& channels, const FileFormat& format) {
  OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(channels.size()), typeDesc(format.type));
  spec.channelnames = channels;
  for (size_t c = 0; c < channels.size(); ++c) {
    if (channels[c] == "A") spec.alpha_channel = static_cast<int>(c);
    if (channels[c] == "Z") spec.z_channel = static_cast<int>(c);
  }
  spec.x = image.originX, spec.y = image.originY;
  spec.full_width = image.displayWidth > 0 ? image.displayWidth : image.width;
  spec.full_height = image.displayHeight > 0 ? image.displayHeight : image.height;
  if (format.tile > 0) spec.tile_width = spec.tile_height = format.tile;
  if (format.type == SampleType::Half)
    for (size_t c = 0; c < channels.size(); ++c) {
      const bool precise = std::find(format.precise.begin(), format.precise.end(), channels[c]) != format.precise.end();
      spec.channelformats.push_back(precise ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::HALF);
    }
  if (format.unassociatedAlpha) spec.attribute("oiio:UnassociatedAlpha", 1);
  const std::string best = format.name == "tiff" ? "lzw" : "zip";
  spec.attribute("compression", format.compression.empty() ? best : format.compression);
  spec.attribute("Software", "Tomales");
  setMetadata(format, spec);
  return spec;
}

template <class T>
std::vector<T> integersOf(const Image& image) {
  std::vector<T> pixels(image.pixels.size());
  std::transform(image.pixels.begin(), image.pixels.end(), pixels.begin(), [](float v) { return static_cast<T>(v); });
  return pixels;
}

/// Rows of some of an image's channels.
std::vector<float> pick(const Image& image, const std::vector<size_t>& channels) {
  std::vector<float> out;
  out.reserve(image.pixels.size());
  for (size_t i = 0; i < image.pixels.size(); i += image.channels.size())
    for (const size_t c : channels) out.push_back(image.pixels[i + c]);
  return out;
}

}  // namespace

FileFormat formatOfExtension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension == ".exr") return {"openexr", SampleType::Float};
  if (extension == ".tif" || extension == ".tiff") return {"tiff", SampleType::UInt8};
  if (extension == ".png") return {"png", SampleType::UInt8};
  return {"", SampleType::Float};
}

struct PictureFile::Impl {
  Impl(const std::string& path, const Image& whole, const FileFormat& f)
      : target(path),
        temporary(target.parent_path() / fmt::format(".{}.{}.part", target.filename().string(), ::getpid())),
        shape(whole),
        format(f) {}

  bool open() {
    std::error_code none;
    if (!target.has_filename() || fs::is_directory(target, none)) return fail("the name is that of a directory");
    out = OIIO::ImageOutput::create(format.name);
    if (!out) return fail(OIIO::geterror());
    if (format.multipart) return true;
    return checked(out->open(temporary.string(), specOf(shape, shape.channels, format)));
  }

  bool write(const Image& rows) {
    if (format.multipart) {
      held.insert(held.end(), rows.pixels.begin(), rows.pixels.end());
      return true;
    }
    if (format.type == SampleType::UInt8) return put(rows, OIIO::TypeDesc::UINT8, integersOf<uint8_t>(rows).data());
    if (format.type == SampleType::UInt16) return put(rows, OIIO::TypeDesc::UINT16, integersOf<uint16_t>(rows).data());
    return put(rows, OIIO::TypeDesc::FLOAT, rows.pixels.data());
  }

  bool put(const Image& rows, OIIO::TypeDesc type, const void* pixels) {
    const int y0 = rows.originY, y1 = y0 + rows.height;
    if (format.tile > 0)
      return checked(out->write_tiles(shape.originX, shape.originX + shape.width, y0, y1, 0, 1, type, pixels));
    return checked(out->write_scanlines(y0, y1, 0, type, pixels));
  }

  // A part cannot be opened before the one before it is complete.
  bool writeParts() {
    std::vector<std::string> names;
    std::vector<std::vector<size_t>> parts;
    for (size_t c = 0; c < shape.channels.size(); ++c) {
      const std::string layer = layerOf(shape.channels[c]);
      const auto part = static_cast<size_t>(std::find(names.begin(), names.end(), layer) - names.begin());
      if (part == names.size()) names.push_back(layer), parts.emplace_back();
      parts[part].push_back(c);
    }
    std::vector<OIIO::ImageSpec> specs;
    for (size_t p = 0; p < parts.size(); ++p) {
      std::vector<std::string> channels;
      for (const size_t c : parts[p]) channels.push_back(shape.channels[c]);
      specs.push_back(specOf(shape, channels, format));
      specs.back().attribute("oiio:subimagename", names[p]);
    }
    Image whole = shape;
    whole.pixels = std::move(held);
    bool good = checked(out->open(temporary.string(), static_cast<int>(specs.size()), specs.data()));
    for (size_t p = 0; good && p < parts.size(); ++p) {
      if (p > 0) good = checked(out->open(temporary.string(), specs[p], OIIO::ImageOutput::AppendSubimage));
      good = good && put(whole, OIIO::TypeDesc::FLOAT, pick(whole, parts[p]).data());
    }
    return good;
  }

  bool close() {
    if (failed || (format.multipart && !writeParts())) return false;
    if (!checked(out->close())) return false;
    std::error_code error;
    fs::rename(temporary, target, error);
    if (error) return fail(error.message());
    return done = true;
  }

  bool checked(bool good) { return good || fail(out->geterror()); }
  bool fail(const std::string& why) {
    if (!failed) problem = why;
    failed = true;
    return false;
  }

  const fs::path target, temporary;
  const Image shape;
  const FileFormat format;
  std::unique_ptr<OIIO::ImageOutput> out;
  std::vector<float> held;  ///< Of a file of many parts.
  std::string problem;
  bool failed = false, done = false;
};

PictureFile::PictureFile(const std::string& path, const Image& shape, const FileFormat& format)
    : impl_(new Impl(path, shape, format)) {
  impl_->open();
}

PictureFile::~PictureFile() {
  if (impl_->done) return;
  if (impl_->out) impl_->out->close();
  std::error_code none;
  fs::remove(impl_->temporary, none);
}

bool PictureFile::write(const Image& rows) { return !impl_->failed && impl_->write(rows); }
bool PictureFile::close() { return impl_->close(); }
const std::string& PictureFile::error() const { return impl_->problem; }

std::optional<Image> readImage(const std::string& path, std::string& error) {
  const auto in = OIIO::ImageInput::open(path);
  if (!in) {
    error = OIIO::geterror();
    return std::nullopt;
  }
  const OIIO::ImageSpec& spec = in->spec();
  Image image{spec.width, spec.height, spec.channelnames, {},
              spec.x,     spec.y,      spec.full_width,   spec.full_height};
  image.pixels.resize(static_cast<size_t>(spec.image_pixels()) * static_cast<size_t>(spec.nchannels));
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data())) {
    error = in->geterror();
    return std::nullopt;
  }
  return image;
}

int Image::channelIndex(const std::string& name) const {
  const auto it = std::find(channels.begin(), channels.end(), name);
  return it == channels.end() ? -1 : static_cast<int>(it - channels.begin());
}

}  // namespace tomales
