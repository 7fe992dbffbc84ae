#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include "reyes/base/chunk_file.h"
#include "reyes/base/unfinished_file.h"
#include "reyes/image.h"
#include "reyes/image_files.h"

namespace tomales {
namespace {

size_t bytesOf(Imf::PixelType type) { return type == Imf::HALF ? sizeof(uint16_t) : sizeof(float); }

/// The pixels of a part, each channel in a plane of its own type, so that all bits stay.
class PartPixels {
 public:
  explicit PartPixels(const Imf::Header& header) : header_(header) {
    const Imath::Box2i& w = header.dataWindow();
    width_ = w.max.x - w.min.x + 1;
    height_ = w.max.y - w.min.y + 1;
    const Imf::ChannelList& list = header.channels();
    for (auto c = list.begin(); c != list.end(); ++c) {
      std::vector<char>& plane = planes_[c.name()];
      const size_t bytes = bytesOf(c.channel().type);
      plane.resize(bytes * static_cast<size_t>(width_) * static_cast<size_t>(height_));
      buffer_.insert(c.name(), Imf::Slice::Make(c.channel().type, plane.data(), w.min, width_, height_, bytes,
                                                bytes * static_cast<size_t>(width_)));
    }
  }
  const Imf::FrameBuffer& buffer() const { return buffer_; }

  void replace(const Image& by) {
    for (auto& [name, plane] : planes_) {
      const int from = by.channelIndex(name);
      if (from < 0) continue;
      const bool isHalf = header_.channels()[name.c_str()].type == Imf::HALF;
      for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
          const float value = by.at(x, y)[from];
          const size_t i = static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
          if (isHalf)
            reinterpret_cast<half*>(plane.data())[i] = half(value);
          else
            reinterpret_cast<float*>(plane.data())[i] = value;
        }
    }
  }

 private:
  const Imf::Header& header_;
  int width_ = 0, height_ = 0;
  std::map<std::string, std::vector<char>> planes_;
  Imf::FrameBuffer buffer_;
};

/// Opens a file whose parts are rows of pixels.
std::unique_ptr<Imf::MultiPartInputFile> openRows(const std::string& picture) {
  std::unique_ptr<Imf::MultiPartInputFile> in;
  try {
    in = std::make_unique<Imf::MultiPartInputFile>(picture.c_str());
  } catch (const std::exception& e) {
    throw FileError(fmt::format("\"{}\" cannot be read as an OpenEXR picture: {}", picture, e.what()));
  }
  for (int p = 0; p < in->parts(); ++p)
    if (in->header(p).hasType() && in->header(p).type() != Imf::SCANLINEIMAGE)
      throw FileError(
          fmt::format("\"{}\" has a part that is deep or tiled, and only rows of pixels are read", picture));
  return in;
}

std::vector<Imf::Header> changedHeaders(const Imf::MultiPartInputFile& in,
                                        const std::map<std::string, std::string>& texts) {
  std::vector<Imf::Header> out;
  for (int p = 0; p < in.parts(); ++p) {
    Imf::Header& header = out.emplace_back(in.header(p));
    for (const auto& [name, text] : texts) {
      header.erase(name);
      if (!text.empty()) header.insert(name, Imf::StringAttribute(text));
    }
  }
  return out;
}

}  // namespace

Image readParts(const std::string& picture) {
  const auto in = openRows(picture);
  const Imath::Box2i &data = in->header(0).dataWindow(), &display = in->header(0).displayWindow();
  Image out{data.max.x - data.min.x + 1,
            data.max.y - data.min.y + 1,
            {},
            {},
            data.min.x,
            data.min.y,
            display.max.x + 1,
            display.max.y + 1};
  for (int p = 0; p < in->parts(); ++p) {
    const Imf::ChannelList& list = in->header(p).channels();
    for (auto c = list.begin(); c != list.end(); ++c) out.channels.push_back(c.name());
    if (in->header(p).dataWindow() != data)
      throw FileError(fmt::format("\"{}\" has parts of different windows", picture));
  }
  const size_t pixel = out.channels.size() * sizeof(float), row = pixel * static_cast<size_t>(out.width);
  out.pixels.resize(row / sizeof(float) * static_cast<size_t>(out.height));
  try {
    for (int p = 0; p < in->parts(); ++p) {
      Imf::FrameBuffer buffer;
      const Imf::ChannelList& list = in->header(p).channels();
      for (auto c = list.begin(); c != list.end(); ++c)
        buffer.insert(c.name(), Imf::Slice::Make(Imf::FLOAT, out.pixels.data() + out.channelIndex(c.name()), data.min,
                                                 out.width, out.height, pixel, row));
      Imf::InputPart part(*in, p);
      part.setFrameBuffer(buffer);
      part.readPixels(data.min.y, data.max.y);
    }
  } catch (const std::exception& e) {
    throw FileError(fmt::format("\"{}\" cannot be read: {}", picture, e.what()));
  }
  return out;
}

void replaceChannels(const std::string& picture, const std::string& output, const Image& by,
                     const std::map<std::string, std::string>& texts) {
  std::string why;
  const auto file = UnfinishedFile::create(output, UnfinishedKind::Scratch, why);
  if (!file) throw WriteError(fmt::format("\"{}\" could not be written: {}", output, why));
  try {
    const auto in = openRows(picture);
    const std::vector<Imf::Header> headers = changedHeaders(*in, texts);
    Imf::MultiPartOutputFile out(file->path().c_str(), headers.data(), in->parts());
    for (int p = 0; p < in->parts(); ++p) {
      const Imf::Header& header = in->header(p);
      PartPixels pixels(header);
      Imf::InputPart from(*in, p);
      from.setFrameBuffer(pixels.buffer());
      from.readPixels(header.dataWindow().min.y, header.dataWindow().max.y);
      pixels.replace(by);
      Imf::OutputPart to(out, p);
      to.setFrameBuffer(pixels.buffer());
      to.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
    }
  } catch (const FileError&) {
    throw;
  } catch (const std::exception& e) {
    throw WriteError(fmt::format("\"{}\" could not be written: {}", output, e.what()));
  }
  if (!file->finish(why)) throw WriteError(fmt::format("\"{}\" could not be written: {}", output, why));
}

}  // namespace tomales
