// Private to reyes/image: OpenEXR files, some rows at a time; OpenEXR lives behind this file.
#pragma once
#include "reyes/image/image_file.h"

namespace tomales {

/// Everything throws std::exception when the disk does not take it.
class ExrFile {
 public:
  ExrFile(const std::string& path, const Image& shape, const FileFormat& format);
  ~ExrFile();
  void write(const Image& rows);
  void write(const DeepRows& rows);
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales
