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

OIIO::ImageSpec specOf(const Image& image, const FileFormat& format) {
  OIIO::ImageSpec spec(image.width, image.height, image.channelCount(), typeDesc(format.type));
  spec.channelnames = image.channels;
  spec.alpha_channel = image.channelIndex("A");
  spec.z_channel = image.channelIndex("Z");
  spec.x = image.originX, spec.y = image.originY;
  spec.full_width = image.displayWidth > 0 ? image.displayWidth : image.width;
  spec.full_height = image.displayHeight > 0 ? image.displayHeight : image.height;
  // Depth loses its meaning in half floats.
  if (format.type == SampleType::Half && spec.z_channel >= 0) {
    spec.channelformats.assign(image.channels.size(), OIIO::TypeDesc::HALF);
    spec.channelformats[static_cast<size_t>(spec.z_channel)] = OIIO::TypeDesc::FLOAT;
  }
  if (format.unassociatedAlpha) spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("compression", format.name == "tiff" ? "lzw" : "zip");
  spec.attribute("Software", "Tomales");
  return spec;
}

template <class T>
bool writeIntegers(OIIO::ImageOutput& out, const Image& image, OIIO::TypeDesc type) {
  std::vector<T> pixels(image.pixels.size());
  std::transform(image.pixels.begin(), image.pixels.end(), pixels.begin(),
                 [](float v) { return static_cast<T>(v); });
  return out.write_image(type, pixels.data());
}

bool writePixels(OIIO::ImageOutput& out, const Image& image, SampleType type) {
  if (type == SampleType::UInt8) return writeIntegers<uint8_t>(out, image, OIIO::TypeDesc::UINT8);
  if (type == SampleType::UInt16) return writeIntegers<uint16_t>(out, image, OIIO::TypeDesc::UINT16);
  return out.write_image(OIIO::TypeDesc::FLOAT, image.pixels.data());
}

bool writeTo(const std::string& path, const Image& image, const FileFormat& format, std::string& error) {
  const auto out = OIIO::ImageOutput::create(format.name);
  if (!out) {
    error = OIIO::geterror();
    return false;
  }
  const bool written = out->open(path, specOf(image, format)) && writePixels(*out, image, format.type);
  const bool closed = out->close();
  if (!written || !closed) error = out->geterror();
  return written && closed;
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

bool writeFile(const std::string& path, const Image& image, const FileFormat& format, std::string& error) {
  const fs::path target(path);
  const fs::path temporary =
      target.parent_path() / fmt::format(".{}.{}.part", target.filename().string(), ::getpid());
  std::error_code problem;
  if (!target.has_filename() || fs::is_directory(target, problem)) {
    error = "the name is that of a directory";
    return false;
  }
  if (writeTo(temporary.string(), image, format, error)) {
    fs::rename(temporary, target, problem);
    if (!problem) return true;
    error = problem.message();
  }
  fs::remove(temporary, problem);
  return false;
}

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
