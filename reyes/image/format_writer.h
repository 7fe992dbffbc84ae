// Private to reyes/image: one writer for each file format, some rows at a time. Each format's library is used in one
// file.
#pragma once
#include <memory>

#include "reyes/image/image_file.h"

namespace tomales {

/// Every member throws std::exception when the disk, or the format, does not take the picture.
class FormatWriter {
 public:
  virtual ~FormatWriter() = default;
  /// Writes the next rows from the top.
  virtual void write(const Image& rows) = 0;
  virtual void write(const DeepRows& rows);
  virtual void close() = 0;
};

/// `shape`: the whole picture, without pixels. For integer types, pixels hold integers already.
std::unique_ptr<FormatWriter> openExr(const std::string& path, const Image& shape, const FileFormat& format);
std::unique_ptr<FormatWriter> openTiff(const std::string& path, const Image& shape, const FileFormat& format);
/// One to four channels of integers; colour must have been divided by alpha.
std::unique_ptr<FormatWriter> openPng(const std::string& path, const Image& shape, const FileFormat& format);

/// The pixels of `rows` as bytes of `type`, from the first row to the last.
std::vector<std::byte> packed(const Image& rows, SampleType type);

}  // namespace tomales
