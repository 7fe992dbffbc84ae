#include "reyes/image/image_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <filesystem>

#include "reyes/image/exr_file.h"
#include "reyes/pictures.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

PictureShape shapeOf(const Image& image) {
  return {image.originX,
          image.originY,
          image.width,
          image.height,
          image.displayWidth > 0 ? image.displayWidth : image.width,
          image.displayHeight > 0 ? image.displayHeight : image.height,
          image.channels};
}

PictureFormat pictureFormat(const FileFormat& format) {
  const PixelType type = format.type == SampleType::UInt8    ? PixelType::UInt8
                         : format.type == SampleType::UInt16 ? PixelType::UInt16
                                                             : PixelType::Float;
  const std::string best = format.name == "tiff" ? "lzw" : "zip";
  return {format.name, type, format.unassociatedAlpha, format.compression.empty() ? best : format.compression};
}

template <class T>
std::vector<T> integersOf(const Image& image) {
  std::vector<T> pixels(image.pixels.size());
  std::transform(image.pixels.begin(), image.pixels.end(), pixels.begin(), [](float v) { return static_cast<T>(v); });
  return pixels;
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
    if (format.name == "openexr")
      return guarded([&] { exr = std::make_unique<ExrFile>(temporary.string(), shape, format); });
    std::string error;
    if (const PictureLibrary* library = pictureLibrary(error))
      other = library->create(temporary.string(), shapeOf(shape), pictureFormat(format), error);
    return other || fail(error);
  }

  bool write(const Image& rows) {
    if (exr) return guarded([&] { exr->write(rows); });
    if (format.type == SampleType::UInt8) return put(rows, integersOf<uint8_t>(rows).data());
    if (format.type == SampleType::UInt16) return put(rows, integersOf<uint16_t>(rows).data());
    return put(rows, rows.pixels.data());
  }
  bool write(const DeepRows& rows) {
    return guarded([&] { exr->write(rows); });
  }
  bool put(const Image& rows, const void* pixels) {
    return other->write(rows.originY, rows.originY + rows.height, pixels) || fail(other->error());
  }

  bool close() {
    if (failed || !closeFile()) return false;
    std::error_code error;
    fs::rename(temporary, target, error);
    if (error) return fail(error.message());
    return done = true;
  }
  bool closeFile() {
    if (exr) return guarded([&] { exr->close(); });
    return other->close() || fail(other->error());
  }

  template <class Write>
  bool guarded(const Write& write) {
    try {
      write();
      return true;
    } catch (const std::exception& e) {
      return fail(e.what());
    }
  }
  bool fail(const std::string& why) {
    if (!failed) problem = why;
    failed = true;
    return false;
  }

  const fs::path target, temporary;
  const Image shape;
  const FileFormat format;
  std::unique_ptr<ExrFile> exr;
  std::unique_ptr<PictureWriter> other;  ///< Of every other format.
  std::string problem;
  bool failed = false, done = false;
};

PictureFile::PictureFile(const std::string& path, const Image& shape, const FileFormat& format)
    : impl_(new Impl(path, shape, format)) {
  impl_->open();
}

PictureFile::~PictureFile() {
  if (impl_->done) return;
  impl_->exr.reset(), impl_->other.reset();
  std::error_code none;
  fs::remove(impl_->temporary, none);
}

bool PictureFile::write(const Image& rows) { return !impl_->failed && impl_->write(rows); }
bool PictureFile::write(const DeepRows& rows) { return !impl_->failed && impl_->write(rows); }
bool PictureFile::close() { return impl_->close(); }
const std::string& PictureFile::error() const { return impl_->problem; }

bool copyShadowMap(const std::string& from, const std::string& to, std::string& error) {
  {
    const auto in = openPicture(from, error);
    float matrix[16];
    if (!in) return false;
    const std::vector<std::string>& channels = in->shape().channels;
    if (std::find(channels.begin(), channels.end(), "Z") == channels.end() || !in->matrix("worldtocamera", matrix))
      return error = "it is no shadow map: depth or the matrices of its camera are missing", false;
  }
  const fs::path target(to), temporary = target.parent_path() / fmt::format(".{}.{}.part", target.filename().string(), ::getpid());
  std::error_code problem;
  if (fs::equivalent(from, target, problem)) return true;
  fs::copy_file(from, temporary, fs::copy_options::overwrite_existing, problem);
  if (!problem) fs::rename(temporary, target, problem);
  if (!problem) return true;
  error = problem.message();
  fs::remove(temporary, problem);
  return false;
}

std::optional<Image> readImage(const std::string& path, std::string& error) {
  const auto in = openPicture(path, error);
  if (!in) return std::nullopt;
  const PictureShape& s = in->shape();
  Image image{s.width, s.height, s.channels, {}, s.x, s.y, s.fullWidth, s.fullHeight};
  image.pixels.resize(static_cast<size_t>(s.width) * static_cast<size_t>(s.height) * s.channels.size());
  if (!in->read(0, image.channelCount(), image.pixels.data())) return error = in->error(), std::nullopt;
  return image;
}

int Image::channelIndex(const std::string& name) const {
  const auto it = std::find(channels.begin(), channels.end(), name);
  return it == channels.end() ? -1 : static_cast<int>(it - channels.begin());
}

}  // namespace tomales
