// Private to reyes/image: the interface of the writers of file formats, which take some rows at a time. Each format's
// library is used in one source file.
#pragma once
#include <memory>

#include "reyes/image/formats.h"

namespace tomales {

/// Every member throws std::exception if the disk or the format cannot take the picture.
class FormatWriter {
 public:
  virtual ~FormatWriter() = default;
  /// Writes the next rows from the top.
  virtual void write(const Image& rows) = 0;
  virtual void write(const DeepRows& rows);
  virtual void close() = 0;
  virtual std::vector<std::string> unread() const { return {}; }  ///< See PictureFile::unread().
};

/// Returns the pixels of `rows` as bytes of `type`, from the first row to the last.
std::vector<std::byte> packed(const Image& rows, SampleType type);

}  // namespace tomales
