// The bytes of one RIB stream: a file, standard input, memory or a program. Gzip is detected by its magic bytes (1f 8b)
// and unpacked on the way. Threads: one reader.
#pragma once
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace tomales::rib {

class ByteStream {
 public:
  using Source = std::function<size_t(char* buffer, size_t size)>;  ///< Returns 0 at the end.
  static constexpr int kEnd = -1;
  /// Compressed data is a bomb if it unpacks to more than kHarmless_bytes, and to more than kLargestRatio times its own
  /// size.
  static constexpr size_t kHarmless_bytes = size_t{64} << 20, kLargestRatio = 200;

  /// Returns null if `path` cannot be opened or is a folder. "-" is standard input, "a.zip!b.rib" a member of a zip
  /// file.
  static std::unique_ptr<ByteStream> open(const std::string& path);
  /// Returns a message about a path that open() refuses.
  static std::string refusal(const std::string& path);
  /// `text` must outlive the stream.
  static std::unique_ptr<ByteStream> fromMemory(const std::string& text);
  /// Reads the answer of a program: the byte 0377 in place of a token closes it (RISpec 3.2 appendix C).
  static std::unique_ptr<ByteStream> fromProgram(Source source);
  ~ByteStream();

  /// Returns the next byte, or kEnd.
  int get() { return next_ < end_ || fill() ? static_cast<unsigned char>(*next_++) : kEnd; }
  int peek() { return next_ < end_ || fill() ? static_cast<unsigned char>(*next_) : kEnd; }
  /// Returns the buffered bytes: at least one, if peek() gave one.
  const char* begin() const { return next_; }
  const char* end() const { return end_; }
  /// Pre: begin() <= position <= end().
  void skipTo(const char* position) { next_ = position; }

  bool isProgram() const { return isProgram_; }
  void close() {
    next_ = end_;
    closed_ = true;
  }
  bool closed() const { return closed_; }
  /// Returns true if the compressed data was cut off, invalid or a bomb; the bytes before that have been read.
  bool damaged() const { return damaged_; }
  /// Says which of these it was. Pre: damaged().
  std::string damage() const;

 private:
  struct Inflater;
  explicit ByteStream(Source source);
  bool fill();
  bool inflateMore();

  Source source_;
  std::unique_ptr<char[]> raw_;
  std::unique_ptr<Inflater> inflater_;
  const char *next_ = nullptr, *end_ = nullptr;
  bool started_ = false, damaged_ = false, isProgram_ = false, closed_ = false;
};

/// Returns the text as one gzip member; members may be concatenated.
std::string gzip(std::string_view text);

}  // namespace tomales::rib
