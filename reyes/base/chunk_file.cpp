#include "reyes/base/chunk_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zstd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>
#include <utility>

#include "reyes/base/input_file.h"
#include "reyes/base/pack.h"
#include "reyes/base/parallel.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

constexpr uint32_t kByteOrder = 0x01020304;
constexpr char kEnd[9] = "TOMALESX";
constexpr int kCompression = -5;            // floats compress little, and the fastest level of zstd finds that as well
constexpr size_t kKeptBytes = 1 << 20;      ///< The most that each buffer of a thread keeps.
constexpr size_t kWrittenAtOnce = 1 << 15;  ///< A call of the system costs more than a small chunk.
constexpr uint64_t kMostChunkBytes = uint64_t{1} << 30;

struct Preamble {
  char kind[8];
  uint32_t version, byteOrder;
};
struct Entry {
  uint64_t offset;
  uint32_t stored, size;
};
struct Footer {
  Entry directory;
  char end[8];
};
static_assert(sizeof(Preamble) == 16 && sizeof(Entry) == 16 && sizeof(Footer) == 24);

}  // namespace

void makeAnewWhatIsDamaged(const std::function<void()>& make, Log& log) {
  std::set<std::string> madeAnew;  // a file that is damaged again was made that way
  while (true) try {
      return make();
    } catch (const DamageError& e) {
      std::error_code problem;
      if (!madeAnew.insert(e.path).second || !std::filesystem::remove(e.path, problem)) throw;
      log.report(Severity::Note, "cache-damaged", {std::make_shared<const std::string>(e.path), 0},
                 std::string(e.what()) + "; it is made anew");
    }
}

struct ChunkWriter::Impl {
  std::string path;
  std::unique_ptr<UnfinishedFile> file;
  uint64_t offset = 0;
  std::vector<Entry> entries;

  void write(const void* data, size_t size) {
    if (std::fwrite(data, 1, size, file->stream()) != size) fail(std::strerror(errno));
    offset += size;
  }
  [[noreturn]] void fail(const std::string& why) const {
    throw WriteError(fmt::format("\"{}\" cannot be written: {}", path, why));
  }
  /// Returns the place of the bytes in the file.
  Entry writeFrame(std::span<const std::byte> bytes) {
    if (bytes.size() > kMostChunkBytes)
      throw WriteError(fmt::format("\"{}\": a chunk of {} bytes is too large", path, bytes.size()));
    // Each thread has one, not each file, because many files may be open.
    thread_local std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> zstd{ZSTD_createCCtx(), &ZSTD_freeCCtx};
    thread_local Bytes packed;
    packed.resize(ZSTD_compressBound(bytes.size()));
    ZSTD_CCtx_setParameter(zstd.get(), ZSTD_c_compressionLevel, kCompression);
    ZSTD_CCtx_setParameter(zstd.get(), ZSTD_c_checksumFlag, 1);
    const size_t stored = ZSTD_compress2(zstd.get(), packed.data(), packed.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(stored))
      throw WriteError(fmt::format("\"{}\" cannot be compressed: {}", path, ZSTD_getErrorName(stored)));
    const Entry entry{offset, static_cast<uint32_t>(stored), static_cast<uint32_t>(bytes.size())};
    write(packed.data(), stored);
    if (packed.size() > kKeptBytes) packed = Bytes();
    return entry;
  }
};

ChunkWriter::ChunkWriter(const std::string& path, const char (&kind)[9], uint32_t version) : impl_(new Impl) {
  impl_->path = path;
  std::string why;
  impl_->file = UnfinishedFile::create(path, UnfinishedKind::Scratch, why);
  if (!impl_->file) impl_->fail(why);
  std::setvbuf(impl_->file->stream(), nullptr, _IOFBF, kWrittenAtOnce);
  Preamble preamble{{}, version, kByteOrder};
  std::memcpy(preamble.kind, kind, sizeof preamble.kind);
  impl_->write(&preamble, sizeof preamble);
}

ChunkWriter::ChunkWriter(ChunkWriter&&) noexcept = default;

ChunkWriter::~ChunkWriter() = default;

uint32_t ChunkWriter::add(std::span<const std::byte> bytes) {
  impl_->entries.push_back(impl_->writeFrame(bytes));
  return count() - 1;
}

uint32_t ChunkWriter::count() const { return static_cast<uint32_t>(impl_->entries.size()); }

void ChunkWriter::finish(std::span<const std::byte> header) {
  Impl& w = *impl_;
  w.entries.push_back(w.writeFrame(header));
  Footer footer{w.writeFrame(std::as_bytes(std::span(w.entries))), {}};
  std::memcpy(footer.end, kEnd, sizeof footer.end);
  w.write(&footer, sizeof footer);
  std::string why;
  if (!w.file->finish(why)) w.fail(why);
  w.file.reset();
}

struct ChunkReader::Impl {
  std::string path;
  int file = -1;
  uint64_t bytes = 0;
  std::vector<Entry> entries;  ///< All chunks, without the header.
  Bytes header;

  ~Impl() {
    if (file >= 0) ::close(file);
  }
  [[noreturn]] void fail(const std::string& problem) const {
    throw DamageError(path, fmt::format("\"{}\" {}", path, problem));
  }

  void readAt(uint64_t offset, void* to, size_t size) const {
    auto* out = static_cast<char*>(to);
    while (size > 0) {
      const ssize_t got = ::pread(file, out, size, static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw FileError(fmt::format("\"{}\" cannot be read: {}", path, std::strerror(errno)));
      if (got == 0) fail("is truncated");
      out += got;
      offset += static_cast<uint64_t>(got);
      size -= static_cast<size_t>(got);
    }
  }

  Bytes unpack(const Entry& e) const {
    if (e.offset > bytes || e.stored > bytes - e.offset || e.size > kMostChunkBytes)
      fail("is damaged: a chunk lies outside of it");
    // Each thread keeps one, because making it takes longer than a small chunk.
    thread_local std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> zstd{ZSTD_createDCtx(), &ZSTD_freeDCtx};
    thread_local Bytes stored;
    if (stored.size() < e.stored) stored.resize(e.stored);
    Bytes out(e.size);
    readAt(e.offset, stored.data(), e.stored);
    const size_t size = ZSTD_decompressDCtx(zstd.get(), out.data(), out.size(), stored.data(), e.stored);
    if (stored.size() > kKeptBytes) stored = Bytes();
    if (ZSTD_isError(size)) fail(fmt::format("is damaged: {}", ZSTD_getErrorName(size)));
    if (size != e.size) fail("is damaged: a chunk is too short");
    return out;
  }

  void readDirectory() {
    Footer footer;
    if (bytes < sizeof(Preamble) + sizeof(Footer)) fail("is truncated");
    readAt(bytes - sizeof footer, &footer, sizeof footer);
    if (std::memcmp(footer.end, kEnd, sizeof footer.end) != 0) fail("is truncated: its end is missing");
    const Bytes directory = unpack(footer.directory);
    if (directory.empty() || directory.size() % sizeof(Entry) != 0) fail("is damaged: its directory does not fit");
    entries.resize(directory.size() / sizeof(Entry));
    std::memcpy(entries.data(), directory.data(), directory.size());
    header = unpack(entries.back());
    entries.pop_back();
  }
};

ChunkReader::ChunkReader(const std::string& path, const char (&kind)[9], uint32_t version) : impl_(new Impl) {
  impl_->path = path;
  std::string problem;
  impl_->file = openInput(path, problem);
  struct stat status;
  if (impl_->file < 0 || ::fstat(impl_->file, &status) != 0)
    throw FileError(fmt::format("\"{}\" cannot be read: {}", path, problem.empty() ? std::strerror(errno) : problem));
  impl_->bytes = static_cast<uint64_t>(status.st_size);
  Preamble preamble{};
  if (impl_->bytes >= sizeof preamble) impl_->readAt(0, &preamble, sizeof preamble);
  if (std::memcmp(preamble.kind, kind, sizeof preamble.kind) != 0) impl_->fail("is a file of another kind");
  if (preamble.byteOrder != kByteOrder) impl_->fail("has another byte order");
  if (preamble.version != version)
    throw FileError(
        fmt::format("\"{}\" has version {}; this program reads version {}", path, preamble.version, version));
  impl_->readDirectory();
}

ChunkReader::~ChunkReader() = default;
ChunkReader::ChunkReader(ChunkReader&&) noexcept = default;
const std::string& ChunkReader::path() const { return impl_->path; }
uint32_t ChunkReader::count() const { return static_cast<uint32_t>(impl_->entries.size()); }
Bytes ChunkReader::takeHeader() { return std::exchange(impl_->header, {}); }
uint64_t ChunkReader::fileBytes() const { return impl_->bytes; }

Bytes ChunkReader::read(uint32_t chunk) const {
  if (chunk >= count()) impl_->fail(fmt::format("has no chunk {}", chunk));
  return impl_->unpack(impl_->entries[chunk]);
}

void ChunkReader::readAll() const {
  parallelFor(count(), 16, [this](size_t begin, size_t end) {
    for (size_t chunk = begin; chunk < end; ++chunk) read(static_cast<uint32_t>(chunk));
  });
}

void throwIfDamaged(const Unpacker& read, const std::string& path) {
  if (read.damaged) throw DamageError(path, fmt::format("\"{}\" is damaged: it ends too early", path));
}

}  // namespace tomales
