// The module over OpenImageIO: only this file and its neighbours in this folder include that library.
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
  bool matrix(const char* name, float* out) const override {
    return in_->spec().getattribute(name, OIIO::TypeMatrix44, out);
  }
  std::string text(const char* name) const override { return std::string(in_->spec().get_string_attribute(name)); }
  bool pair(const char* name, float* out) const override {
    return in_->spec().getattribute(name, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::VEC2), out);
  }
  bool read(int first, int end, float* out) override {
    return in_->read_image(0, 0, first, end, OIIO::TypeDesc::FLOAT, out);
  }
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

class Library : public PictureLibrary {
 public:
  std::unique_ptr<PictureReader> open(const std::string& path, std::string& error) const override {
    auto in = OIIO::ImageInput::open(path);
    if (!in) {
      error = OIIO::geterror();
      return nullptr;
    }
    return std::make_unique<Reader>(std::move(in));
  }
  std::unique_ptr<TextureCache> textures(const TextureSettings& settings) const override {
    return makeTextureCache(settings);
  }
  Making makeTexture(const TextureRecipe& recipe, std::string& error) const override { return convert(recipe, error); }
};

}  // namespace
}  // namespace tomales

extern "C" __attribute__((visibility("default"))) const tomales::PictureLibrary* tomalesPictureLibrary() {
  static const tomales::Library library;
  return &library;
}
