#include "reyes/base/record_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>

#include "reyes/base/input_file.h"

namespace tomales {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are stored as they are in memory");

constexpr int kRecordCompression = 1;                   ///< Faster than most disks, and half the size of memory.
constexpr uint64_t kLargestRecord = uint64_t{1} << 32;  ///< A damaged length must not ask for all memory.
constexpr uint32_t kDirectory = ~uint32_t{0};
constexpr char kTrailerMagic[] = "TomalEND";

struct Header {
  char magic[8];
  uint32_t version, zero;
  uint64_t schema, sum;
};
struct RecordHeader {
  uint32_t kind, index;
  uint64_t stored, size;  ///< Sizes in bytes: in the file, and unpacked.
  uint32_t contentSum, sum;
};
struct Trailer {
  char magic[8];
  uint64_t directory, fileSize, sum;
};
struct DirectoryEntry {
  RecordName name;
  uint64_t offset;
};
static_assert(sizeof(Header) == 32 && sizeof(RecordHeader) == 32 && sizeof(Trailer) == 32 &&
              sizeof(DirectoryEntry) == 16);

uint64_t sumOf(const void* data, size_t size) { return checksum({static_cast<const std::byte*>(data), size}); }

/// Computes the sum of a record whose last member is its sum.
template <class Block>
auto sealOf(const Block& r) {
  return static_cast<decltype(r.sum)>(sumOf(&r, sizeof(Block) - sizeof(r.sum)));
}

Header headerOf(const RecordFileKind& kind) {
  Header h{{}, kind.version, 0, kind.schema, 0};
  std::memcpy(h.magic, kind.magic, sizeof(h.magic));
  h.sum = sealOf(h);
  return h;
}

bool readExactly(int file, uint64_t at, void* out, size_t size) {
  char* p = static_cast<char*>(out);
  while (size > 0) {
    const ssize_t n = ::pread(file, p, size, static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    p += n;
    size -= static_cast<size_t>(n);
    at += static_cast<uint64_t>(n);
  }
  return true;
}

template <class Block>
bool readBlock(int file, uint64_t at, Block& out) {
  return readExactly(file, at, &out, sizeof(Block)) && out.sum == sealOf(out);
}

uint64_t sizeOf(int file) {
  struct stat s {};
  return ::fstat(file, &s) == 0 && S_ISREG(s.st_mode) ? static_cast<uint64_t>(s.st_size) : 0;
}

/// Returns what is wrong with the header; empty if the file is of this kind.
std::string problemOf(int file, const RecordFileKind& kind) {
  Header h{};
  const bool sound = readBlock(file, 0, h);
  if (std::memcmp(h.magic, kind.magic, sizeof(h.magic)) != 0) return "it is no file of this kind, or damaged";
  if (!sound) return "it is truncated or its header is damaged";
  if (h.version != kind.version)
    return fmt::format("it is of version {}, and this program reads version {}", h.version, kind.version);
  if (h.schema != kind.schema) return "it was written by a build of this program that describes scenes differently";
  return {};
}

/// Reads the record at `at`, which ends at `next`. Returns nothing if it is damaged or cut off.
std::optional<Bytes> readRecord(int file, uint64_t fileSize, uint64_t at, RecordHeader& h, uint64_t& next) {
  if (!readBlock(file, at, h)) return std::nullopt;
  const uint64_t begin = at + sizeof(h);
  if (h.stored > fileSize - begin || h.size > kLargestRecord) return std::nullopt;
  Bytes stored(h.stored), out(h.size);
  if (!readExactly(file, begin, stored.data(), stored.size())) return std::nullopt;
  if (h.contentSum != static_cast<uint32_t>(checksum(stored))) return std::nullopt;
  thread_local const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  const size_t got = ZSTD_decompressDCtx(context.get(), out.data(), out.size(), stored.data(), stored.size());
  if (ZSTD_isError(got) || got != h.size) return std::nullopt;
  next = begin + h.stored;
  return out;
}

std::string lastProblem() { return std::strerror(errno); }

}  // namespace

std::unique_ptr<RecordWriter> RecordWriter::create(const std::string& path, const RecordFileKind& kind,
                                                   Unfinished unfinished, std::string& error) {
  auto file = UnfinishedFile::create(
      path, unfinished == Unfinished::Removed ? UnfinishedKind::Scratch : UnfinishedKind::Resumable, error);
  if (!file) return nullptr;
  std::unique_ptr<RecordWriter> writer(new RecordWriter(path, std::move(file), kind));
  if (unfinished == Unfinished::Resumed) writer->keepWholeRecords();
  if (writer->end_ > 0 || writer->restart()) return writer;
  error = writer->error_;
  return nullptr;
}

void RecordWriter::keepWholeRecords() {
  if (!problemOf(file_->descriptor(), kind_).empty()) return;
  const uint64_t size = sizeOf(file_->descriptor());
  uint64_t at = sizeof(Header), next = 0;
  for (RecordHeader h{}; readRecord(file_->descriptor(), size, at, h, next) && h.kind != kDirectory; at = next)
    offsets_[{h.kind, h.index}] = at;
  if (::ftruncate(file_->descriptor(), static_cast<off_t>(at)) == 0)
    end_ = at;
  else
    offsets_.clear();
}

bool RecordWriter::restart() {
  offsets_.clear();
  end_ = 0;
  if (::ftruncate(file_->descriptor(), 0) != 0) return fail(lastProblem());
  const Header header = headerOf(kind_);
  return append(&header, sizeof(header));
}

bool RecordWriter::fail(const std::string& what) {
  if (error_.empty()) error_ = what;
  return false;
}

bool RecordWriter::append(const void* data, size_t size) {
  const char* p = static_cast<const char*>(data);
  for (uint64_t at = end_; size > 0;) {
    const ssize_t n = ::pwrite(file_->descriptor(), p, size, static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return fail(n < 0 ? lastProblem() : "no space left");
    p += n;
    size -= static_cast<size_t>(n);
    at += static_cast<uint64_t>(n);
    if (size == 0) end_ = at;
  }
  return true;
}

bool RecordWriter::has(RecordName name) const {
  const std::lock_guard lock(mutex_);
  return offsets_.contains(name);
}

std::optional<Bytes> RecordWriter::read(RecordName name) const {
  uint64_t offset = 0;
  {
    const std::lock_guard lock(mutex_);
    const auto it = offsets_.find(name);
    if (it == offsets_.end()) return std::nullopt;
    offset = it->second;
  }
  RecordHeader h{};
  uint64_t next = 0;
  return readRecord(file_->descriptor(), ~uint64_t{0}, offset, h, next);
}

bool RecordWriter::write(RecordName name, BytesView content) {
  thread_local const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
  Bytes record(sizeof(RecordHeader) + ZSTD_compressBound(content.size()));
  std::byte* stored = record.data() + sizeof(RecordHeader);
  const size_t size = ZSTD_compressCCtx(context.get(), stored, record.size() - sizeof(RecordHeader), content.data(),
                                        content.size(), kRecordCompression);
  RecordHeader h{name.kind, name.index, size, content.size(), static_cast<uint32_t>(sumOf(stored, size)), 0};
  h.sum = sealOf(h);
  std::memcpy(record.data(), &h, sizeof(h));

  const std::lock_guard lock(mutex_);
  if (!error_.empty()) return false;
  const uint64_t offset = end_;
  if (!append(record.data(), sizeof(h) + size)) return false;
  offsets_[name] = offset;
  return true;
}

bool RecordWriter::finish() {
  std::vector<uint64_t> places;
  for (const auto& [name, offset] : offsets_) places.push_back(offset);
  if (std::is_sorted(places.begin(), places.end())) return finishInOrder();
  std::string why;
  const auto sorted = create(path_, kind_, Unfinished::Removed, why);
  if (!sorted) return fail(why);
  if (!copyTo(*sorted) || !sorted->finishInOrder()) return fail(sorted->error());
  discard();
  return true;
}

bool RecordWriter::copyTo(RecordWriter& other) {
  Bytes record;
  for (const auto& [name, offset] : offsets_) {
    RecordHeader h{};
    if (!readBlock(file_->descriptor(), offset, h)) return other.fail("what was written cannot be read again");
    record.resize(sizeof(h) + h.stored);
    if (!readExactly(file_->descriptor(), offset, record.data(), record.size()))
      return other.fail("what was written cannot be read again");
    other.offsets_[name] = other.end_;
    if (!other.append(record.data(), record.size())) return false;
  }
  return true;
}

bool RecordWriter::finishInOrder() {
  std::vector<DirectoryEntry> entries;
  for (const auto& [name, offset] : offsets_) entries.push_back({name, offset});
  const uint64_t directory = end_;
  if (!write({kDirectory, 0}, std::as_bytes(std::span(entries)))) return false;
  Trailer trailer{{}, directory, end_ + sizeof(Trailer), 0};
  std::memcpy(trailer.magic, kTrailerMagic, sizeof(trailer.magic));
  trailer.sum = sealOf(trailer);
  std::string why;
  return append(&trailer, sizeof(trailer)) && (file_->finish(why) || fail(why));
}

std::string RecordWriter::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

RecordFile::~RecordFile() {
  if (file_ >= 0) ::close(file_);
}

std::unique_ptr<RecordFile> RecordFile::open(const std::string& path, const RecordFileKind& kind, std::string& error) {
  std::unique_ptr<RecordFile> out(new RecordFile);
  out->file_ = openInput(path, error);
  if (out->file_ < 0) return nullptr;
  return out->readDirectory(kind, error) ? std::move(out) : nullptr;
}

bool RecordFile::readDirectory(const RecordFileKind& kind, std::string& error) {
  size_ = sizeOf(file_);
  error = problemOf(file_, kind);
  if (!error.empty()) return false;
  Trailer trailer{};
  const bool ended = size_ >= sizeof(Trailer) && readBlock(file_, size_ - sizeof(Trailer), trailer) &&
                     std::memcmp(trailer.magic, kTrailerMagic, sizeof(trailer.magic)) == 0 && trailer.fileSize == size_;
  RecordHeader h{};
  uint64_t next = 0;
  const auto directory = ended ? readRecord(file_, size_, trailer.directory, h, next) : std::nullopt;
  if (!directory || h.kind != kDirectory || directory->size() % sizeof(DirectoryEntry) != 0) {
    error = ended ? "its directory is damaged" : "it is truncated or damaged at its end";
    return false;
  }
  std::vector<DirectoryEntry> entries(directory->size() / sizeof(DirectoryEntry));
  if (!entries.empty()) std::memcpy(entries.data(), directory->data(), directory->size());
  for (const DirectoryEntry& e : entries) offsets_[e.name] = e.offset;
  return true;
}

std::vector<RecordName> RecordFile::names() const {
  std::vector<RecordName> out;
  for (const auto& [name, offset] : offsets_) out.push_back(name);
  return out;
}

std::optional<Bytes> RecordFile::read(RecordName name, std::string& error) const {
  const auto it = offsets_.find(name);
  if (it == offsets_.end()) {
    error = fmt::format("it lacks record {} {}", name.kind, name.index);
    return std::nullopt;
  }
  RecordHeader h{};
  uint64_t next = 0;
  auto out = readRecord(file_, size_, it->second, h, next);
  if (out && RecordName{h.kind, h.index} == name) return out;
  error = fmt::format("record {} {} is damaged", name.kind, name.index);
  return std::nullopt;
}

}  // namespace tomales
