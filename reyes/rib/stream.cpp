#include "reyes/rib/stream.h"

#include <zlib.h>

#include <algorithm>
#include <filesystem>
#include <new>

#include "reyes/base/input_file.h"
#include "reyes/base/stop.h"
#include "reyes/rib/zip_member.h"

namespace tomales::rib {
namespace {
constexpr size_t kBufferSize = 1 << 16;
}

struct ByteStream::Inflater {
  z_stream z{};
  bool ready = false, memberEnded = false;
  size_t in = 0, out = 0;  ///< Bytes so far.
  std::unique_ptr<char[]> buffer = std::make_unique<char[]>(kBufferSize);

  Inflater() { ready = inflateInit2(&z, 15 + 16) == Z_OK; }  // +16 accepts the gzip wrapping only
  ~Inflater() {
    if (ready) inflateEnd(&z);
  }
};

ByteStream::ByteStream(Source source) : source_(std::move(source)), raw_(std::make_unique<char[]>(kBufferSize)) {}
ByteStream::~ByteStream() = default;

std::string ByteStream::refusal(const std::string& path) {
  std::string problem;
  if (zipOf(path).empty())
    problem = inputProblem(path);
  else
    openZipMember(path, kHarmless_bytes, kLargestRatio, problem);
  return "the file cannot be opened" + (problem.empty() ? "" : ": " + problem);
}

std::unique_ptr<ByteStream> ByteStream::open(const std::string& path) {
  std::error_code ignored;
  if (path != "-" && std::filesystem::is_directory(path, ignored)) return nullptr;
  if (std::string why; path != "-" && !std::filesystem::exists(path, ignored))
    if (const ZipSource source = openZipMember(path, kHarmless_bytes, kLargestRatio, why))
      return std::unique_ptr<ByteStream>(new ByteStream(source));
  std::FILE* file = path == "-" ? stdin : std::fopen(path.c_str(), "rb");
  if (!file) return nullptr;
  const std::shared_ptr<std::FILE> owner(file, [](std::FILE* f) {
    if (f != stdin) std::fclose(f);
  });
  return std::unique_ptr<ByteStream>(
      new ByteStream([owner](char* buffer, size_t size) { return std::fread(buffer, 1, size, owner.get()); }));
}

std::unique_ptr<ByteStream> ByteStream::fromMemory(const std::string& text) {
  return std::unique_ptr<ByteStream>(new ByteStream([&text, at = size_t{0}](char* buffer, size_t size) mutable {
    const size_t n = text.copy(buffer, size, at);
    at += n;
    return n;
  }));
}

std::unique_ptr<ByteStream> ByteStream::fromProgram(Source source) {
  auto stream = std::unique_ptr<ByteStream>(new ByteStream(std::move(source)));
  stream->isProgram_ = true;
  return stream;
}

bool ByteStream::fill() {
  throwIfStopped();
  if (closed_) return false;
  if (!inflater_) {
    size_t n = source_(raw_.get(), kBufferSize);
    if (n == kBrokenZip) {
      damaged_ = true;
      n = 0;
    }
    next_ = raw_.get();
    end_ = next_ + n;
    const bool isGzip = !started_ && n >= 2 && raw_[0] == '\x1f' && raw_[1] == '\x8b';
    started_ = true;
    if (!isGzip) return n > 0;
    inflater_ = std::make_unique<Inflater>();
    inflater_->z.next_in = reinterpret_cast<Bytef*>(raw_.get());
    inflater_->z.avail_in = static_cast<uInt>(n);
    inflater_->in = n;
  }
  return inflateMore();
}

bool ByteStream::inflateMore() {
  Inflater& inflater = *inflater_;
  z_stream& z = inflater.z;
  z.next_out = reinterpret_cast<Bytef*>(inflater.buffer.get());
  z.avail_out = kBufferSize;
  while (z.avail_out == kBufferSize && !damaged_ && inflater.ready) {
    if (z.avail_in == 0) {
      z.next_in = reinterpret_cast<Bytef*>(raw_.get());
      const size_t n = source_(raw_.get(), kBufferSize);
      z.avail_in = n == kBrokenZip ? 0 : static_cast<uInt>(n);
      inflater.in += z.avail_in;
      if (z.avail_in == 0) {
        damaged_ = !inflater.memberEnded;
        break;
      }
    }
    if (inflater.memberEnded) inflateReset(&z);  // gzip files may be concatenated
    const int status = inflate(&z, Z_NO_FLUSH);
    inflater.memberEnded = status == Z_STREAM_END;
    damaged_ = status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR;
  }
  next_ = inflater.buffer.get();
  end_ = next_ + (kBufferSize - z.avail_out);
  inflater.out += static_cast<size_t>(end_ - next_);
  damaged_ |= inflater.out > kHarmless_bytes && inflater.out / kLargestRatio > inflater.in;
  return next_ < end_;
}

std::string ByteStream::damage() const {
  if (!inflater_ || inflater_->out <= kHarmless_bytes) return "damaged or cut off";
  return "a bomb or damaged: it swells beyond " + std::to_string(kHarmless_bytes >> 20) + " MiB and " +
         std::to_string(kLargestRatio) + " times its size";
}

std::string gzip(std::string_view text) {
  z_stream z{};
  if (deflateInit2(&z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string out(deflateBound(&z, text.size()), '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  z.avail_in = static_cast<uInt>(text.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  deflate(&z, Z_FINISH);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

}  // namespace tomales::rib
