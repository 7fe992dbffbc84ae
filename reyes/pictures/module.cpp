// The module over OpenImageIO: with its neighbours in this folder, all that includes it.
#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>

#include "reyes/pictures/convert.h"
#include "reyes/pictures/textures.h"

namespace tomales {
namespace {

class Reader : public PictureReader {
 public:
  explicit Reader(std::unique_ptr<OIIO::ImageInput> in) : in_(std::move(in)) {
    const OIIO::ImageSpec& s = in_->spec();
    shape_ = {s.x, s.y, s.width, s.height, s.full_width, s.full_height, s.channelnames};
  }
  const PictureShape& shape() const override { return shape_; }
  bool deep() const override { return in_->spec().deep; }
  bool matrix(const char* name, float* out) const override { return in_->spec().getattribute(name, OIIO::TypeMatrix44, out); }
  bool read(int first, int end, float* out) override { return in_->read_image(0, 0, first, end, OIIO::TypeDesc::FLOAT, out); }
  bool readDeep(std::vector<uint32_t>& counts, std::vector<float>& values) override {
    OIIO::DeepData data;
    if (!in_->read_native_deep_image(0, 0, data)) return false;
    for (int64_t pixel = 0; pixel < data.pixels(); ++pixel) {
      counts.push_back(static_cast<uint32_t>(data.samples(pixel)));
      for (int s = 0; s < data.samples(pixel); ++s)
        for (int c = 0; c < data.channels(); ++c) values.push_back(data.deep_value(pixel, c, s));
    }
    return true;
  }
  std::string error() const override { return in_->geterror(); }

 private:
  const std::unique_ptr<OIIO::ImageInput> in_;
  PictureShape shape_;
};

OIIO::TypeDesc typeDesc(PixelType type) {
  return type == PixelType::UInt8 ? OIIO::TypeDesc::UINT8 : type == PixelType::UInt16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::FLOAT;
}

class Writer : public PictureWriter {
 public:
  Writer(std::unique_ptr<OIIO::ImageOutput> out, PixelType type) : out_(std::move(out)), type_(typeDesc(type)) {}
  bool write(int y0, int y1, const void* pixels) override { return out_->write_scanlines(y0, y1, 0, type_, pixels); }
  bool close() override { return out_->close(); }
  std::string error() const override { return out_->geterror(); }

 private:
  const std::unique_ptr<OIIO::ImageOutput> out_;
  const OIIO::TypeDesc type_;
};

OIIO::ImageSpec specOf(const PictureShape& shape, const PictureFormat& format) {
  OIIO::ImageSpec spec(shape.width, shape.height, static_cast<int>(shape.channels.size()), typeDesc(format.type));
  spec.channelnames = shape.channels;
  for (size_t c = 0; c < shape.channels.size(); ++c) {
    if (shape.channels[c] == "A") spec.alpha_channel = static_cast<int>(c);
    if (shape.channels[c] == "Z") spec.z_channel = static_cast<int>(c);
  }
  spec.x = shape.x, spec.y = shape.y, spec.full_width = shape.fullWidth, spec.full_height = shape.fullHeight;
  if (format.unassociatedAlpha) spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("compression", format.compression);
  spec.attribute("Software", "Tomales");
  return spec;
}

class Library : public PictureLibrary {
 public:
  std::unique_ptr<PictureReader> open(const std::string& path, std::string& error) const override {
    auto in = OIIO::ImageInput::open(path);
    if (!in) return error = OIIO::geterror(), nullptr;
    return std::make_unique<Reader>(std::move(in));
  }
  std::unique_ptr<PictureWriter> create(const std::string& path, const PictureShape& shape, const PictureFormat& format,
                                        std::string& error) const override {
    auto out = OIIO::ImageOutput::create(format.name);
    if (!out) return error = OIIO::geterror(), nullptr;
    if (!out->open(path, specOf(shape, format))) return error = out->geterror(), nullptr;
    return std::make_unique<Writer>(std::move(out), format.type);
  }
  std::unique_ptr<TextureCache> textures(const TextureSettings& settings) const override { return makeTextureCache(settings); }
  bool makeTexture(const TextureRecipe& recipe, std::string& error) const override { return convert(recipe, error); }
};

}  // namespace
}  // namespace tomales

extern "C" __attribute__((visibility("default"))) const tomales::PictureLibrary* tomalesPictureLibrary() {
  static const tomales::Library library;
  return &library;
}
