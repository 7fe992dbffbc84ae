#include "reyes/rib/stream.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace tomales::rib {
namespace {
constexpr size_t kBufferSize = 1 << 16;
}

struct ByteStream::Inflater {
  z_stream z{};
  bool ready = false, memberEnded = false;
  std::unique_ptr<char[]> out = std::make_unique<char[]>(kBufferSize);

  Inflater() { ready = inflateInit2(&z, 15 + 16) == Z_OK; }  // +16: the gzip wrapping only
  ~Inflater() {
    if (ready) inflateEnd(&z);
  }
};

ByteStream::ByteStream(Source source)
    : source_(std::move(source)), raw_(std::make_unique<char[]>(kBufferSize)) {}
ByteStream::~ByteStream() = default;

std::unique_ptr<ByteStream> ByteStream::open(const std::string& path) {
  std::error_code ignored;
  if (path != "-" && std::filesystem::is_directory(path, ignored)) return nullptr;
  std::FILE* file = path == "-" ? stdin : std::fopen(path.c_str(), "rb");
  if (!file) return nullptr;
  const std::shared_ptr<std::FILE> owner(file, [](std::FILE* f) {
    if (f != stdin) std::fclose(f);
  });
  return std::unique_ptr<ByteStream>(new ByteStream(
      [owner](char* buffer, size_t size) { return std::fread(buffer, 1, size, owner.get()); }));
}

std::unique_ptr<ByteStream> ByteStream::fromMemory(const std::string& text) {
  return std::unique_ptr<ByteStream>(
      new ByteStream([&text, at = size_t{0}](char* buffer, size_t size) mutable {
        const size_t n = std::min(size, text.size() - at);
        std::memcpy(buffer, text.data() + at, n);
        at += n;
        return n;
      }));
}

bool ByteStream::fill() {
  if (!inflater_) {
    const size_t n = source_(raw_.get(), kBufferSize);
    next_ = raw_.get();
    end_ = next_ + n;
    const bool gzip = !started_ && n >= 2 && raw_[0] == '\x1f' && raw_[1] == '\x8b';
    started_ = true;
    if (!gzip) return n > 0;
    inflater_ = std::make_unique<Inflater>();
    inflater_->z.next_in = reinterpret_cast<Bytef*>(raw_.get());
    inflater_->z.avail_in = static_cast<uInt>(n);
  }
  z_stream& z = inflater_->z;
  z.next_out = reinterpret_cast<Bytef*>(inflater_->out.get());
  z.avail_out = kBufferSize;
  while (z.avail_out == kBufferSize && !damaged_ && inflater_->ready) {
    if (z.avail_in == 0) {
      z.next_in = reinterpret_cast<Bytef*>(raw_.get());
      z.avail_in = static_cast<uInt>(source_(raw_.get(), kBufferSize));
      if (z.avail_in == 0) {
        damaged_ = !inflater_->memberEnded;
        break;
      }
    }
    if (inflater_->memberEnded) inflateReset(&z);  // gzip files may be concatenated
    const int status = inflate(&z, Z_NO_FLUSH);
    inflater_->memberEnded = status == Z_STREAM_END;
    damaged_ = status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR;
  }
  next_ = inflater_->out.get();
  end_ = next_ + (kBufferSize - z.avail_out);
  return next_ < end_;
}

}  // namespace tomales::rib
