#include "reyes/pictures/exr_reader.h"

#include <ImathMatrix.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfVecAttribute.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace tomales {
namespace {

/// Channels that we write, in OpenImageIO's order: by layer, and within it colour, alpha, depth, then the rest by name.
auto rank(const std::string& channel) {
  static constexpr std::string_view kFirst[] = {"R", "G", "B", "A", "AR", "AG", "AB", "Z", "ZBack"};
  const size_t dot = channel.rfind('.'), name = dot == std::string::npos ? 0 : dot + 1;
  const auto at = std::find(std::begin(kFirst), std::end(kFirst), std::string_view(channel).substr(name));
  return std::tuple(channel.substr(0, name), at - std::begin(kFirst), channel);
}

class ExrReader : public PictureReader {
 public:
  explicit ExrReader(const std::string& path) : file_(path.c_str()) {
    const Imath::Box2i &data = header().dataWindow(), &full = header().displayWindow();
    shape_ = {data.min.x - full.min.x,
              data.min.y - full.min.y,
              data.max.x - data.min.x + 1,
              data.max.y - data.min.y + 1,
              full.max.x - full.min.x + 1,
              full.max.y - full.min.y + 1,
              {}};
    for (auto c = header().channels().begin(); c != header().channels().end(); ++c) {
      shape_.channels.push_back(c.name());
      plain_ = plain_ && c.channel().type != Imf::UINT && c.channel().xSampling == 1 && c.channel().ySampling == 1;
    }
    std::sort(shape_.channels.begin(), shape_.channels.end(),
              [](const auto& a, const auto& b) { return rank(a) < rank(b); });
    const std::string type = header().hasType() ? header().type() : "";
    deep_ = type == Imf::DEEPSCANLINE;
    plain_ = plain_ && file_.parts() == 1 && type != Imf::DEEPTILE;
    refuseMoreThanMemory(static_cast<double>(shape_.width) * shape_.height);
  }
  bool plain() const { return plain_; }

  const PictureShape& shape() const override { return shape_; }
  bool deep() const override { return deep_; }
  bool matrix(const char* name, float* out) const override {
    const auto* found = header().findTypedAttribute<Imf::M44fAttribute>(exrAttributeName(name));
    if (found) std::copy_n(&found->value().x[0][0], 16, out);
    return found;
  }
  std::string text(const char* name) const override {
    const auto* found = header().findTypedAttribute<Imf::StringAttribute>(name);
    return found ? found->value() : std::string();
  }
  bool pair(const char* name, float* out) const override {
    const auto* found = header().findTypedAttribute<Imf::V2fAttribute>(name);
    if (found) {
      out[0] = found->value().x;
      out[1] = found->value().y;
    }
    return found;
  }

  bool read(int first, int end, float* out) override {
    return guarded([&] {
      Imf::FrameBuffer buffer;
      for (int c = first; c < end; ++c)
        buffer.insert(shape_.channels[static_cast<size_t>(c)],
                      slice(out + (c - first), static_cast<size_t>(end - first)));
      Imf::InputPart part(file_, 0);
      part.setFrameBuffer(buffer);
      part.readPixels(header().dataWindow().min.y, header().dataWindow().max.y);
    });
  }

  bool readDeep(std::vector<uint32_t>& counts, std::vector<float>& values) override {
    return guarded([&] {
      const Imath::Box2i& window = header().dataWindow();
      const size_t channels = shape_.channels.size(),
                   pixels = static_cast<size_t>(shape_.width) * static_cast<size_t>(shape_.height);
      counts.resize(pixels);
      Imf::DeepFrameBuffer buffer;
      buffer.insertSampleCountSlice(Imf::Slice::Make(Imf::UINT, counts.data(), window));
      std::vector<std::vector<float*>> at(channels, std::vector<float*>(pixels));
      const size_t row = static_cast<size_t>(shape_.width);
      const ptrdiff_t back =
          static_cast<ptrdiff_t>(window.min.x) + static_cast<ptrdiff_t>(window.min.y) * static_cast<ptrdiff_t>(row);
      for (size_t c = 0; c < channels; ++c)
        buffer.insert(shape_.channels[c],
                      Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(at[c].data() - back), sizeof(float*),
                                     sizeof(float*) * row, sizeof(float) * channels));
      Imf::DeepScanLineInputPart part(file_, 0);
      part.setFrameBuffer(buffer);
      part.readPixelSampleCounts(window.min.y, window.max.y);
      size_t samples = 0;
      for (const uint32_t count : counts) samples += count;
      refuseMoreThanMemory(static_cast<double>(samples));
      values.resize(samples * channels);
      float* next = values.data();
      for (size_t i = 0; i < pixels; next += counts[i++] * channels)
        for (size_t c = 0; c < channels; ++c) at[c][i] = next + c;
      part.readPixels(window.min.y, window.max.y);
    });
  }
  std::string error() const override { return error_; }

 private:
  /// A damaged header may claim any size.
  void refuseMoreThanMemory(double pixels) const {
    constexpr double kMostBytes = 32e9;
    if (pixels * static_cast<double>(shape_.channels.size() * sizeof(float)) > kMostBytes)
      throw std::runtime_error("it claims to hold more than 32 GB");
  }
  const Imf::Header& header() const { return file_.header(0); }

  Imf::Slice slice(float* out, size_t step) const {
    const size_t bytes = sizeof(float) * step;
    return Imf::Slice::Make(Imf::FLOAT, out, header().dataWindow(), bytes, bytes * static_cast<size_t>(shape_.width));
  }

  template <class Calls>
  bool guarded(const Calls& calls) {
    try {
      calls();
      return true;
    } catch (const std::exception& e) {
      error_ = e.what();
      return false;
    }
  }

  Imf::MultiPartInputFile file_;
  PictureShape shape_;
  bool deep_ = false, plain_ = true;
  std::string error_;
};

}  // namespace

std::unique_ptr<PictureReader> openExrPicture(const std::string& path, std::string& error) {
  if (!Imf::isOpenExrFile(path.c_str())) return nullptr;
  try {
    auto reader = std::make_unique<ExrReader>(path);
    return reader->plain() ? std::move(reader) : nullptr;
  } catch (const std::exception& e) {
    error = e.what();
    return nullptr;
  }
}

}  // namespace tomales
