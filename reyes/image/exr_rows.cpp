#include "reyes/image/exr_rows.h"

#include <ImathVec.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfVersion.h>
#include <libdeflate.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "reyes/base/parallel.h"
#include "reyes/base/simd.h"

namespace tomales {
namespace {

using Bytes = std::vector<unsigned char>;

constexpr int kBlockRows = 16;  ///< Rows of a block of ZIP_COMPRESSION ("The OpenEXR File Layout").
/// Level of libdeflate, 1..12. Files are no larger than with level 2 of zlib, and higher levels save at most 1 % in
/// pictures with few flat areas.
constexpr int kLevel = 1;

/// A channel of the file; channels are in the order of their names.
struct FileChannel {
  size_t index;  ///< Index among the channels of the picture.
  bool half;
};

std::vector<FileChannel> channelsOf(const Image& shape, const Imf::Header& header) {
  std::vector<FileChannel> out;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    out.push_back({static_cast<size_t>(shape.channelIndex(c.name())), c.channel().type == Imf::HALF});
  return out;
}

/// Returns the bytes of rows, channel after channel in each row. The machine is little-endian, as the format is.
Bytes rawRows(const Image& rows, int first, int count, const std::vector<FileChannel>& channels) {
  Bytes out;
  const size_t width = static_cast<size_t>(rows.width), all = rows.channels.size();
  for (const FileChannel& c : channels) out.resize(out.size() + width * static_cast<size_t>(count) * (c.half ? 2 : 4));
  unsigned char* to = out.data();
  const auto put = [&](auto value) {
    std::memcpy(to, &value, sizeof(value));
    to += sizeof(value);
  };
  for (int row = first; row < first + count; ++row)
    for (const FileChannel& c : channels) {
      const float* from = &rows.pixels[static_cast<size_t>(row) * width * all + c.index];
      for (size_t i = 0; i < width; ++i)
        if (c.half)
          put(Imath::half(from[i * all]).bits());
        else
          put(from[i * all]);
    }
  return out;
}

/// Puts bytes at even places before those at odd ones, and replaces each by its difference from the one before. Pre: an
/// even number.
TOMALES_HOT void predict(const unsigned char* __restrict raw, size_t half, unsigned char* __restrict split,
                         unsigned char* __restrict out) {
  for (size_t i = 0; i < half; ++i) {
    split[i] = raw[2 * i];
    split[half + i] = raw[2 * i + 1];
  }
  out[0] = split[0];
  for (size_t i = 1; i < 2 * half; ++i) out[i] = static_cast<unsigned char>(split[i] - split[i - 1] + 128);
}

struct FreeCompressor {
  void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};

/// Returns the compressed data, or the data itself if compression does not make it smaller.
Bytes compressed(Bytes raw) {
  static thread_local const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
      libdeflate_alloc_compressor(kLevel));
  if (!compressor) throw std::bad_alloc();
  Bytes split(raw.size()), differences(raw.size());
  predict(raw.data(), raw.size() / 2, split.data(), differences.data());
  const size_t size = libdeflate_zlib_compress(compressor.get(), differences.data(), differences.size(), split.data(),
                                               split.size() - 1);
  if (size == 0) return raw;
  split.resize(size);
  return split;
}

bool isLong(const std::string& name) { return name.size() > 31; }

bool hasLongNames(const Imf::Header& header) {
  for (auto a = header.begin(); a != header.end(); ++a)
    if (isLong(a.name()) || isLong(a.attribute().typeName())) return true;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    if (isLong(c.name())) return true;
  return false;
}

class ExrRows : public FormatWriter {
 public:
  ExrRows(const std::string& path, const Image& shape, const Imf::Header& header)
      : channels_(channelsOf(shape, header)),
        offsets_(static_cast<size_t>((shape.height + kBlockRows - 1) / kBlockRows)) {
    header.sanityCheck();
    errno = 0;
    stream_.open(path, std::ios::binary);
    check();
    put(int32_t{Imf::MAGIC});
    put(int32_t{Imf::EXR_VERSION | (hasLongNames(header) ? Imf::LONG_NAMES_FLAG : 0)});
    Imf::StdOFStream out(stream_, path.c_str());
    header.writeTo(out);
    table_ = stream_.tellp();
    putOffsets();
    check();
  }

  void write(const Image& rows) override {
    static_assert(PictureFile::kBandRows % kBlockRows == 0);
    std::vector<Bytes> blocks(static_cast<size_t>((rows.height + kBlockRows - 1) / kBlockRows));
    parallelFor(blocks.size(), 1, [&](size_t begin, size_t end) {
      for (size_t b = begin; b < end; ++b) {
        const int first = static_cast<int>(b) * kBlockRows;
        blocks[b] = compressed(rawRows(rows, first, std::min(kBlockRows, rows.height - first), channels_));
      }
    });
    for (size_t b = 0; b < blocks.size(); ++b) {
      offsets_[next_++] = static_cast<uint64_t>(stream_.tellp());
      put(static_cast<int32_t>(rows.originY + static_cast<int>(b) * kBlockRows));
      put(static_cast<int32_t>(blocks[b].size()));
      stream_.write(reinterpret_cast<const char*>(blocks[b].data()), static_cast<std::streamsize>(blocks[b].size()));
    }
    check();
  }

  void close() override {
    stream_.seekp(table_);
    putOffsets();
    stream_.flush();
    check();
  }

 private:
  template <class T>
  void put(T value) {
    stream_.write(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  void putOffsets() {
    for (const uint64_t offset : offsets_) put(offset);
  }
  void check() const {
    if (!stream_) throw std::system_error(errno != 0 ? errno : EIO, std::generic_category());
  }

  const std::vector<FileChannel> channels_;
  std::ofstream stream_;
  std::ofstream::pos_type table_;
  std::vector<uint64_t> offsets_;  ///< Offset of every block of rows; 0 before it is written.
  size_t next_ = 0;
};

}  // namespace

std::unique_ptr<FormatWriter> openExrRows(const std::string& path, const Image& shape, const Imf::Header& header) {
  return std::make_unique<ExrRows>(path, shape, header);
}

}  // namespace tomales
