#include "reyes/base/ply_reader.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <sstream>

#include "reyes/base/input_file.h"

namespace tomales {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written and read on little-endian machines");

template <class T>
double valueOf(const std::byte* at) {
  T v;
  std::memcpy(&v, at, sizeof v);
  return static_cast<double>(v);
}

template <class T>
PlyScalar scalar() {
  return {sizeof(T), valueOf<T>, std::is_integral_v<T> ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0};
}

std::optional<PlyScalar> scalarNamed(const std::string& type) {
  if (type == "char" || type == "int8") return scalar<int8_t>();
  if (type == "uchar" || type == "uint8") return scalar<uint8_t>();
  if (type == "short" || type == "int16") return scalar<int16_t>();
  if (type == "ushort" || type == "uint16") return scalar<uint16_t>();
  if (type == "int" || type == "int32") return scalar<int32_t>();
  if (type == "uint" || type == "uint32") return scalar<uint32_t>();
  if (type == "float" || type == "float32") return scalar<float>();
  if (type == "double" || type == "float64") return scalar<double>();
  return std::nullopt;
}

}  // namespace

void failPly(const std::string& path, const std::string& what) {
  throw FileError(fmt::format("\"{}\": {}", path, what));
}

PlyReader::PlyReader(const std::string& path) : path_(path) {
  if (const std::string problem = inputProblem(path); !problem.empty()) failPly(path, "cannot be read: " + problem);
  in_.open(path, std::ios::binary);
  readHeader();
}

double PlyReader::number(const PlyScalar& type) {
  if (encoding_ == Encoding::Ascii) {
    std::string word;
    in_ >> word;
    char* end = nullptr;
    const double v = std::strtod(word.c_str(), &end);  // reads "nan" and "inf" too, unlike streams
    if (word.empty()) failPly(path_, "ends too early");
    if (*end != 0) failPly(path_, "holds something that is not a number: " + word.substr(0, 40));
    return v;
  }
  std::byte bytes[8];
  if (!in_.read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(type.bytes)))
    failPly(path_, "ends too early");
  if (encoding_ == Encoding::Big) std::reverse(bytes, bytes + type.bytes);
  return type.value(bytes);
}

void PlyReader::skip(const PlyElement& element) {
  if (element.properties.empty()) return;  // its elements take no bytes, however many
  for (uint64_t i = 0; i < element.count; ++i)
    for (const PlyProperty& p : element.properties) {
      const double count = p.length ? number(*p.length) : 1;
      for (double k = 0; k < count; ++k) number(p.type);
    }
}

void PlyReader::requireEnd() {
  if (encoding_ == Encoding::Ascii) in_ >> std::ws;
  if (in_.peek() != std::ifstream::traits_type::eof())
    failPly(path_, "goes on after the data that its header announces");
}

void PlyReader::readHeader() {
  std::string line;
  if (!getLine(line) || line != "ply") failPly(path_, "is no PLY file");
  while (true) {
    if (!getLine(line)) failPly(path_, "ends within its header");
    if (line.starts_with(kPlySumComment))
      sum_ = line.substr(kPlySumComment.size());
    else
      header_ += line + "\n";
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "end_header") break;
    if (word == "format") readFormat(words);
    if (word == "element") {
      PlyElement e;
      if (!(words >> e.name >> e.count)) failPly(path_, "has a damaged header: " + line);
      elements_.push_back(e);
    }
    if (word == "property") readProperty(words, line);
  }
  if (!encoding_) failPly(path_, "does not say its format");
}

bool PlyReader::getLine(std::string& line) {
  constexpr size_t kLongest = 4096;
  line.clear();
  for (char c; line.size() < kLongest && in_.get(c);) {
    if (c == '\n') {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      return true;
    }
    line += c;
  }
  return false;
}

void PlyReader::readFormat(std::istringstream& words) {
  std::string name;
  words >> name;
  if (name == "ascii") encoding_ = Encoding::Ascii;
  if (name == "binary_little_endian") encoding_ = Encoding::Little;
  if (name == "binary_big_endian") encoding_ = Encoding::Big;
}

void PlyReader::readProperty(std::istringstream& words, const std::string& line) {
  std::string type, name;
  std::optional<PlyScalar> length;
  words >> type;
  if (type == "list") {
    words >> type;
    if (length = scalarNamed(type); !length) failPly(path_, "has a damaged header: " + line);
    words >> type;
  }
  words >> name;
  const std::optional<PlyScalar> scalar = scalarNamed(type);
  if (!scalar || name.empty() || elements_.empty()) failPly(path_, "has a damaged header: " + line);
  elements_.back().properties.push_back({name, *scalar, length});
}

}  // namespace tomales
