// Private to reyes/image: one file format each, some rows at a time; each format's library lives behind its own file.
#pragma once
#include <memory>

#include "reyes/image/image_file.h"

namespace tomales {

/// Everything throws std::exception when the disk, or the format, does not take it.
class FormatWriter {
 public:
  virtual ~FormatWriter() = default;
  /// The next rows from the top.
  virtual void write(const Image& rows) = 0;
  virtual void write(const DeepRows& rows);
  virtual void close() = 0;
};

/// `shape`: the whole picture, without pixels. Integer types: pixels hold integers already.
std::unique_ptr<FormatWriter> openExr(const std::string& path, const Image& shape, const FileFormat& format);
std::unique_ptr<FormatWriter> openTiff(const std::string& path, const Image& shape, const FileFormat& format);
/// One to four channels of integers; colour must have been divided by alpha.
std::unique_ptr<FormatWriter> openPng(const std::string& path, const Image& shape, const FileFormat& format);

/// The pixels of `rows` as bytes of `type`, from the first row to the last.
std::vector<std::byte> packed(const Image& rows, SampleType type);

}  // namespace tomales
