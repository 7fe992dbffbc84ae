#include "reyes/rib/zip.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

// Signatures and offsets: PKWARE's APPNOTE.TXT, sections 4.3.7 (local header), 4.3.12 (central directory), 4.3.16 (its
// end).
namespace tomales::rib {
namespace {

using File = std::shared_ptr<std::FILE>;
constexpr size_t kEndSize = 22, kEntrySize = 46, kLocalSize = 30, kLongestComment = 0xffff;
constexpr size_t kLargestDirectory = size_t{1} << 26;
constexpr uint32_t kEnd = 0x06054b50, kEntry = 0x02014b50, kLocal = 0x04034b50;
constexpr unsigned kStored = 0, kDeflated = 8, kEncrypted = 1;

uint32_t number(std::string_view bytes, size_t at, int size) {
  uint32_t out = 0;
  for (int i = size - 1; i >= 0; --i) out = out << 8 | static_cast<unsigned char>(bytes[at + static_cast<size_t>(i)]);
  return out;
}

/// Shorter than `size` where the file ends.
std::string readAt(std::FILE* file, long at, size_t size) {
  std::string out(size, '\0');
  if (at < 0 || std::fseek(file, at, SEEK_SET) != 0) return "";
  out.resize(std::fread(out.data(), 1, size, file));
  return out;
}

/// The central directory, or nothing.
std::string directoryOf(std::FILE* file) {
  if (std::fseek(file, 0, SEEK_END) != 0) return "";
  const long size = std::ftell(file), from = std::max(0l, size - static_cast<long>(kEndSize + kLongestComment));
  const std::string tail = readAt(file, from, static_cast<size_t>(size - from));
  for (size_t at = tail.size() < kEndSize ? 0 : tail.size() - kEndSize + 1; at-- > 0;)
    if (number(tail, at, 4) == kEnd && number(tail, at + 12, 4) <= kLargestDirectory)
      return readAt(file, static_cast<long>(number(tail, at + 16, 4)), number(tail, at + 12, 4));
  return "";
}

struct Member {
  unsigned flags, method;
  uint32_t crc, packed, size, offset;
};

std::optional<Member> findMember(std::string_view directory, std::string_view name) {
  for (size_t at = 0; at + kEntrySize <= directory.size() && number(directory, at, 4) == kEntry;) {
    const size_t nameSize = number(directory, at + 28, 2);
    if (directory.substr(at + kEntrySize, nameSize) == name)
      return Member{number(directory, at + 8, 2),  number(directory, at + 10, 2), number(directory, at + 16, 4),
                    number(directory, at + 20, 4), number(directory, at + 24, 4), number(directory, at + 42, 4)};
    at += kEntrySize + nameSize + number(directory, at + 30, 2) + number(directory, at + 32, 2);
  }
  return std::nullopt;
}

std::string littleEndian(uint32_t n) {
  std::string out;
  for (int i = 0; i < 4; ++i) out += static_cast<char>(n >> 8 * i);
  return out;
}

/// `before`, then `size` bytes of the file from where it stands, then `after`.
struct Parts {
  File file;
  std::string before, after;
  size_t size;

  size_t operator()(char* buffer, size_t room) {
    if (before.empty() && size > 0) {
      const size_t n = std::fread(buffer, 1, std::min(room, size), file.get());
      size = n == 0 ? 0 : size - n;  // cut off: the check at its end does not fit, and is reported
      if (n > 0) return n;
    }
    std::string& text = before.empty() ? after : before;
    const size_t n = std::min(room, text.size());
    std::memcpy(buffer, text.data(), n);
    text.erase(0, n);
    return n;
  }
};

}  // namespace

std::string fileOfMember(const std::string& path) { return path.substr(0, path.rfind('!')); }

std::function<size_t(char*, size_t)> zipMember(const std::string& path) {
  const std::string name = fileOfMember(path);
  if (name == path) return {};
  const File file(std::fopen(name.c_str(), "rb"), [](std::FILE* f) {
    if (f) std::fclose(f);
  });
  if (!file) return {};
  const auto member = findMember(directoryOf(file.get()), std::string_view(path).substr(name.size() + 1));
  if (!member || member->flags & kEncrypted || (member->method != kStored && member->method != kDeflated)) return {};
  const std::string local = readAt(file.get(), static_cast<long>(member->offset), kLocalSize);
  if (local.size() < kLocalSize || number(local, 0, 4) != kLocal) return {};
  const long data = static_cast<long>(member->offset + kLocalSize + number(local, 26, 2) + number(local, 28, 2));
  if (std::fseek(file.get(), data, SEEK_SET) != 0) return {};
  if (member->method == kStored) return Parts{file, "", "", member->packed};
  static constexpr char kGzipHeader[] = "\x1f\x8b\x08\0\0\0\0\0\0\xff";  // RFC 1952: deflated, no name, unknown system
  return Parts{file, std::string(kGzipHeader, 10), littleEndian(member->crc) + littleEndian(member->size),
               member->packed};
}

}  // namespace tomales::rib
