#include <ImathMatrix.h>
#include <ImathVec.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFloatVectorAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfTileDescriptionAttribute.h>
#include <OpenEXR/ImfTiledOutputPart.h>
#include <OpenEXR/ImfVecAttribute.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "reyes/base/parallel.h"
#include "reyes/image/exr_headers.h"
#include "reyes/image/exr_rows.h"
#include "reyes/pictures.h"

namespace tomales {
namespace {

/// Compression level, 1..9. Pictures of floats that share few bits get 1 to 5 % larger than at 4, OpenEXR's own level,
/// in two thirds of the time.
constexpr int kZipLevel = 2;

/// Returns "layer" of "layer.X". Colour and depth have layers of their own.
std::string layerOf(const std::string& channel) {
  const size_t dot = channel.rfind('.');
  if (dot != std::string::npos) return channel.substr(0, dot);
  if (channel == "Z") return "depth";
  return channel.size() == 1 && std::string("RGBA").find(channel) != std::string::npos ? "rgba" : channel;
}

/// The channels of a picture that one part of the file holds.
struct ExrLayer {
  std::string name;
  std::vector<size_t> channels;
};

std::vector<ExrLayer> exrLayersOf(const std::vector<std::string>& channels, bool multipart) {
  std::vector<ExrLayer> parts;
  for (size_t c = 0; c < channels.size(); ++c) {
    const std::string layer = multipart ? layerOf(channels[c]) : "";
    auto part = std::find_if(parts.begin(), parts.end(), [&](const ExrLayer& p) { return p.name == layer; });
    if (part == parts.end()) part = parts.insert(part, {layer, {}});
    part->channels.push_back(c);
  }
  return parts;
}

Imf::Compression compressionOf(const FileFormat& format) {
  static const std::pair<const char*, Imf::Compression> kNames[] = {
      {"none", Imf::NO_COMPRESSION},   {"rle", Imf::RLE_COMPRESSION},   {"zip", Imf::ZIP_COMPRESSION},
      {"zips", Imf::ZIPS_COMPRESSION}, {"piz", Imf::PIZ_COMPRESSION},   {"pxr24", Imf::PXR24_COMPRESSION},
      {"b44", Imf::B44_COMPRESSION},   {"b44a", Imf::B44A_COMPRESSION}, {"dwaa", Imf::DWAA_COMPRESSION},
      {"dwab", Imf::DWAB_COMPRESSION}};
  for (const auto& [name, compression] : kNames)
    if (format.compression == name) return compression;
  // Common readers take deep files only as scanlines of ZIPS.
  return format.deep ? Imf::ZIPS_COMPRESSION : Imf::ZIP_COMPRESSION;
}

void setMetadata(const Metadata& m, Imf::Header& header) {
  const std::vector<float>& n = m.numbers;
  const std::string name = exrAttributeName(m.name);
  if (n.empty()) {
    header.insert(name, Imf::StringAttribute(m.text));
  } else if (n.size() == 16) {
    Imath::M44f matrix;
    std::copy(n.begin(), n.end(), &matrix.x[0][0]);
    header.insert(name, Imf::M44fAttribute(matrix));
  } else if (name == "chromaticities" && n.size() == 8) {
    header.insert(name, Imf::ChromaticitiesAttribute({{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}}));
  } else if (n.size() == 1) {
    header.insert(name, Imf::FloatAttribute(n[0]));
  } else if (n.size() == 2) {
    header.insert(name, Imf::V2fAttribute({n[0], n[1]}));
  } else if (n.size() == 3) {
    header.insert(name, Imf::V3fAttribute({n[0], n[1], n[2]}));
  } else {
    header.insert(name, Imf::FloatVectorAttribute(n));
  }
}

Imf::PixelType typeOf(const FileFormat& format, const std::string& channel) {
  const bool precise = std::find(format.precise.begin(), format.precise.end(), channel) != format.precise.end();
  return format.type == SampleType::Half && !precise ? Imf::HALF : Imf::FLOAT;
}

Imf::Header headerOf(const Image& image, const FileFormat& format, const ExrLayer& part) {
  const int width = image.displayWidth > 0 ? image.displayWidth : image.width;
  const int height = image.displayHeight > 0 ? image.displayHeight : image.height;
  const Imath::V2i origin(image.originX, image.originY);
  Imf::Header header({{0, 0}, {width - 1, height - 1}},
                     {origin, origin + Imath::V2i(image.width - 1, image.height - 1)});
  header.pixelAspectRatio() = format.pixelAspect;
  header.compression() = compressionOf(format);
  for (const size_t c : part.channels)
    header.channels().insert(image.channels[c], Imf::Channel(typeOf(format, image.channels[c])));
  if (!part.name.empty()) header.setName(part.name);
  header.setType(format.deep ? Imf::DEEPSCANLINE : format.tile > 0 ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  if (format.tile > 0) {
    const auto side = static_cast<unsigned>(format.tile);
    header.setTileDescription({side, side});
  }
  header.insert("Software", Imf::StringAttribute("Tomales"));
  for (const Metadata& m : format.metadata) setMetadata(m, header);
  return header;
}

/// One channel's values in the type that the file has.
class Plane {
 public:
  Plane(Imf::PixelType type, size_t count) : type_(type) {
    type == Imf::HALF ? halves_.resize(count) : floats_.resize(count);
  }
  void set(size_t i, float v) {
    if (type_ == Imf::HALF)
      halves_[i] = v;
    else
      floats_[i] = v;
  }
  Imf::PixelType type() const { return type_; }
  size_t valueBytes() const { return type_ == Imf::HALF ? sizeof(Imath::half) : sizeof(float); }
  char* at(size_t i) {
    return type_ == Imf::HALF ? reinterpret_cast<char*>(&halves_[i]) : reinterpret_cast<char*>(&floats_[i]);
  }
  char* data() {
    return type_ == Imf::HALF ? reinterpret_cast<char*>(halves_.data()) : reinterpret_cast<char*>(floats_.data());
  }

 private:
  Imf::PixelType type_;
  std::vector<Imath::half> halves_;
  std::vector<float> floats_;
};

class ExrFile : public FormatWriter {
 public:
  ExrFile(const std::string& path, const Image& image, const std::vector<Imf::Header>& headers) : shape(image) {
    for (const Imf::Header& header : headers) parts.push_back({header, {}});
    for (Part& part : parts)
      for (auto c = part.header.channels().begin(); c != part.header.channels().end(); ++c)
        part.channels.push_back({static_cast<size_t>(shape.channelIndex(c.name())), c.channel().type});
    errno = 0;
    stream.open(path, std::ios::binary);
    check();
    out = std::make_unique<Imf::StdOFStream>(stream, path.c_str());
    const int helpers = threadCount() > 1 ? threadCount() : 0;  // threads that compress; without any, the caller does
    if (Imf::globalThreadCount() < helpers) Imf::setGlobalThreadCount(helpers);
    file = std::make_unique<Imf::MultiPartOutputFile>(*out, headers.data(), static_cast<int>(headers.size()), false,
                                                      helpers);
  }

  void write(const Image& rows) override {
    const size_t channels = rows.channels.size(), pixels = rows.pixels.size() / channels;
    const Imath::Box2i window = windowOf(rows.originY, rows.height);
    for (size_t p = 0; p < parts.size(); ++p) {
      std::vector<Plane> planes;
      Imf::FrameBuffer buffer;
      planes.reserve(parts[p].channels.size());
      for (const auto& [c, type] : parts[p].channels) {
        Plane& plane = planes.emplace_back(type, pixels);
        for (size_t i = 0; i < pixels; ++i) plane.set(i, rows.pixels[i * channels + c]);
        buffer.insert(shape.channels[c], Imf::Slice::Make(plane.type(), plane.data(), window));
      }
      if (parts[p].header.hasTileDescription())
        writeTiles(static_cast<int>(p), buffer, rows.originY, rows.height);
      else
        writeRows(static_cast<int>(p), buffer, rows.height);
    }
    check();
  }

  void write(const DeepRows& rows) override {
    const size_t channels = shape.channels.size(), samples = rows.values.size() / channels;
    std::vector<unsigned> counts(rows.counts.begin(), rows.counts.end());
    const Imath::Box2i window = windowOf(rows.y0, rows.height);
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(Imf::Slice::Make(Imf::UINT, counts.data(), window));
    std::vector<Plane> planes;
    std::vector<std::vector<char*>> pointers(channels);
    const size_t row = static_cast<size_t>(shape.width);
    const ptrdiff_t back =
        static_cast<ptrdiff_t>(shape.originX) + static_cast<ptrdiff_t>(rows.y0) * static_cast<ptrdiff_t>(row);
    planes.reserve(channels);
    for (const auto& [c, type] : parts[0].channels) {
      // one more, so that there is an end to point at
      Plane& plane = planes.emplace_back(type, samples + 1);
      for (size_t i = 0; i < samples; ++i) plane.set(i, rows.values[i * channels + c]);
      size_t first = 0;
      for (const unsigned count : counts) {
        pointers[c].push_back(plane.at(first));
        first += count;
      }
      buffer.insert(shape.channels[c], Imf::DeepSlice(type, reinterpret_cast<char*>(pointers[c].data() - back),
                                                      sizeof(char*), sizeof(char*) * row, plane.valueBytes()));
    }
    Imf::DeepScanLineOutputPart part(*file, 0);
    part.setFrameBuffer(buffer);
    part.writePixels(rows.height);
    check();
  }

  void close() override {
    file.reset();  // writes the table of offsets, and does not throw
    stream.flush();
    check();
  }

 private:
  struct Channel {
    size_t index;  ///< Among the channels of the picture.
    Imf::PixelType type;
  };
  struct Part {
    Imf::Header header;
    std::vector<Channel> channels;
  };

  void check() const {
    if (!stream) throw std::system_error(errno != 0 ? errno : EIO, std::generic_category());
  }

  Imath::Box2i windowOf(int y0, int height) const {
    return {{shape.originX, y0}, {shape.originX + shape.width - 1, y0 + height - 1}};
  }

  void writeRows(int p, const Imf::FrameBuffer& buffer, int height) {
    Imf::OutputPart part(*file, p);
    part.setFrameBuffer(buffer);
    part.writePixels(height);
  }

  void writeTiles(int p, const Imf::FrameBuffer& buffer, int y0, int height) {
    Imf::TiledOutputPart part(*file, p);
    part.setFrameBuffer(buffer);
    const int side = static_cast<int>(parts[static_cast<size_t>(p)].header.tileDescription().ySize);
    const int first = (y0 - shape.originY) / side, last = (y0 - shape.originY + height - 1) / side;
    part.writeTiles(0, part.numXTiles() - 1, first, last);
  }

  const Image shape;
  std::vector<Part> parts;
  std::ofstream stream;
  std::unique_ptr<Imf::StdOFStream> out;
  std::unique_ptr<Imf::MultiPartOutputFile> file;
};

std::unique_ptr<FormatWriter> openExr(const std::string& path, const Image& shape, const FileFormat& format) {
  std::vector<Imf::Header> headers;
  for (const ExrLayer& layer : exrLayersOf(shape.channels, format.multipart))
    headers.push_back(headerOf(shape, format, layer));
  return openExrOf(path, shape, std::move(headers));
}

}  // namespace

std::unique_ptr<FormatWriter> openExrOf(const std::string& path, const Image& shape, std::vector<Imf::Header> headers) {
  for (Imf::Header& header : headers) header.zipCompressionLevel() = kZipLevel;
  const Imf::Header& first = headers.front();
  const bool rows =
      headers.size() == 1 && first.type() == Imf::SCANLINEIMAGE && first.compression() == Imf::ZIP_COMPRESSION;
  if (rows) return openExrRows(path, shape, first);
  return std::make_unique<ExrFile>(path, shape, headers);
}

const PictureFormat& exrFormat() {
  static const PictureFormat row = {
      .name = "openexr",
      .title = "OpenEXR",
      .types = {"exr"},
      .extensions = {".exr"},
      .compressions = {"none", "rle", "zip", "zips", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"},
      .params = {"exrpixeltype", "type", "tiled", "multipart", "chromaticities", "mergedepth", "mergeopacity",
                 "exrheader_*"},
      .floats = true,
      .carriesNames = true,
      .open = openExr};
  return row;
}

}  // namespace tomales
