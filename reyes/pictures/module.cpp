// The module over OpenImageIO: all that includes it.
#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>

#include <algorithm>

#include "reyes/pictures.h"

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

class Cache : public TextureCache {
 public:
  Cache(const std::string& searchPath, float cache_MB) : system_(OIIO::TextureSystem::create(false)) {
    system_->attribute("searchpath", searchPath);
    system_->attribute("max_memory_MB", cache_MB);
    system_->attribute("automip", 1);  // pictures that no one ran maketx on
    system_->attribute("autotile", 64);
  }
  ~Cache() override { OIIO::TextureSystem::destroy(system_, true); }

  bool lookup(const TextureQuery& q, TmVec3 out, int64_t& lookups, std::string& error) override {
    OIIO::TextureSystem::Perthread* thread = system_->get_perthread_info();
    OIIO::TextureSystem::TextureHandle* handle = system_->get_texture_handle(OIIO::ustring(q.name), thread);
    bool found = handle && system_->good(handle);
    OIIO::TextureOpt options;
    options.firstchannel = q.channel;
    if (q.latlong) options.swrap = OIIO::TextureOpt::WrapPeriodic, options.twrap = OIIO::TextureOpt::WrapClamp;
    float* const channels[3] = {out.x, out.y, out.z};
    const int n = std::min(q.channels, 3);
    for (int i = 0; i < q.count && found; ++i) {
      if (!q.active[i]) continue;
      float texel[3] = {0, 0, 0};
      found = system_->texture(handle, thread, options, q.s[i], q.t[i], q.width[i], 0, 0, q.height[i], n, texel);
      for (int k = 0; k < n; ++k) channels[k][i] = texel[k];
      ++lookups;
    }
    error = system_->geterror();
    return found;
  }

 private:
  OIIO::TextureSystem* const system_;
};

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
  std::unique_ptr<TextureCache> textures(const std::string& searchPath, float cache_MB) const override {
    return std::make_unique<Cache>(searchPath, cache_MB);
  }
};

}  // namespace
}  // namespace tomales

extern "C" __attribute__((visibility("default"))) const tomales::PictureLibrary* tomalesPictureLibrary() {
  static const tomales::Library library;
  return &library;
}
