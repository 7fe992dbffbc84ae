// Bytes of one RIB stream: a file, standard input or memory. Gzip is detected by its magic bytes (1f 8b) and
// unpacked on the way. Threads: one reader.
#pragma once
#include <cstdio>
#include <functional>
#include <memory>
#include <string>

namespace tomales::rib {

class ByteStream {
 public:
  static constexpr int kEnd = -1;

  /// Null if `path` cannot be opened or is a folder; "-" is standard input.
  static std::unique_ptr<ByteStream> open(const std::string& path);
  /// `text` must outlive the stream.
  static std::unique_ptr<ByteStream> fromMemory(const std::string& text);
  ~ByteStream();

  /// The next byte, or kEnd.
  int get() { return next_ < end_ || fill() ? static_cast<unsigned char>(*next_++) : kEnd; }
  int peek() { return next_ < end_ || fill() ? static_cast<unsigned char>(*next_) : kEnd; }
  /// The compressed data broke off or made no sense; what came before it has been read.
  bool damaged() const { return damaged_; }

 private:
  using Source = std::function<size_t(char* buffer, size_t size)>;  ///< 0: the end
  struct Inflater;
  explicit ByteStream(Source source);
  bool fill();

  Source source_;
  std::unique_ptr<char[]> raw_;
  std::unique_ptr<Inflater> inflater_;
  const char *next_ = nullptr, *end_ = nullptr;
  bool started_ = false, damaged_ = false;
};

}  // namespace tomales::rib
