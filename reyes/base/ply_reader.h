// Reads the numbers of a PLY file, one after the other. Point clouds (gi/ply.h) and models are made from them. Threads:
// none.
#pragma once
#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "reyes/base/chunk_file.h"

namespace tomales {

struct PlyScalar {
  size_t bytes;
  double (*value)(const std::byte*);
  double whole;  ///< The value that means 1 in a colour.
};

struct PlyProperty {
  std::string name;
  PlyScalar type;
  std::optional<PlyScalar> length;  ///< Type of a list's length, for lists.
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

/// The comment of our own files that holds the VertexSum.
constexpr std::string_view kPlySumComment = "comment checksum of Tomales ";

[[noreturn]] void failPly(const std::string& path, const std::string& what);

/// All members throw FileError.
class PlyReader {
 public:
  /// Reads the header.
  explicit PlyReader(const std::string& path);

  const std::vector<PlyElement>& elements() const { return elements_; }
  /// Returns the lines of the header, without that of the sum.
  const std::string& header() const { return header_; }
  /// Returns the sum, which only our own files have.
  const std::optional<std::string>& sum() const { return sum_; }

  double number(const PlyScalar& type);
  void skip(const PlyElement& element);
  /// Fails unless the file ends behind the last element.
  void requireEnd();

 private:
  enum class Encoding { Ascii, Little, Big };

  void readHeader();
  bool getLine(std::string& line);
  void readFormat(std::istringstream& words);
  void readProperty(std::istringstream& words, const std::string& line);

  const std::string path_;
  std::string header_ = "ply\n";
  std::optional<std::string> sum_;
  std::ifstream in_;
  std::optional<Encoding> encoding_;
  std::vector<PlyElement> elements_;
};

}  // namespace tomales
