#include "gi/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include "reyes/base/input_file.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written and read on little-endian machines");

enum class Encoding { Ascii, Little, Big };

struct Scalar {
  size_t bytes;
  double (*value)(const std::byte*);
  double whole;  ///< The value that stands for 1 in a colour.
};

template <class T>
double valueOf(const std::byte* at) {
  T v;
  std::memcpy(&v, at, sizeof v);
  return static_cast<double>(v);
}

template <class T>
Scalar scalar() {
  return {sizeof(T), valueOf<T>, std::is_integral_v<T> ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0};
}

std::optional<Scalar> scalarNamed(const std::string& type) {
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

struct Property {
  std::string name;
  Scalar type;
  std::optional<Scalar> length;  ///< Type of a list's length, for lists.
};

struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
};

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw FileError(fmt::format("\"{}\": {}", path, what));
}

/// Reads a file after its header, number by number.
class PlyReader {
 public:
  explicit PlyReader(const std::string& path) : path_(path) {
    if (const std::string problem = inputProblem(path); !problem.empty()) fail(path, "cannot be read: " + problem);
    in_.open(path, std::ios::binary);
    readHeader();
  }

  const std::vector<Element>& elements() const { return elements_; }

  double number(const Scalar& type) {
    if (encoding_ == Encoding::Ascii) {
      std::string word;
      in_ >> word;
      char* end = nullptr;
      const double v = std::strtod(word.c_str(), &end);  // takes "nan" and "inf", unlike streams
      if (word.empty()) fail(path_, "ends too early");
      if (*end != 0) fail(path_, "holds what is no number: " + word.substr(0, 40));
      return v;
    }
    std::byte bytes[8];
    if (!in_.read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(type.bytes)))
      fail(path_, "ends too early");
    if (encoding_ == Encoding::Big) std::reverse(bytes, bytes + type.bytes);
    return type.value(bytes);
  }

  void skip(const Element& element) {
    if (element.properties.empty()) return;  // its elements take no bytes, however many
    for (uint64_t i = 0; i < element.count; ++i)
      for (const Property& p : element.properties) {
        const double count = p.length ? number(*p.length) : 1;
        for (double k = 0; k < count; ++k) number(p.type);
      }
  }

 private:
  void readHeader() {
    std::string line;
    if (!getLine(line) || line != "ply") fail(path_, "is no PLY file");
    while (true) {
      if (!getLine(line)) fail(path_, "ends within its header");
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (word == "end_header") break;
      if (word == "format") readFormat(words);
      if (word == "element") {
        Element e;
        if (!(words >> e.name >> e.count)) fail(path_, "has a damaged header: " + line);
        elements_.push_back(e);
      }
      if (word == "property") readProperty(words, line);
    }
    if (!encoding_) fail(path_, "does not say its format");
  }

  bool getLine(std::string& line) {
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

  void readFormat(std::istringstream& words) {
    std::string name;
    words >> name;
    if (name == "ascii") encoding_ = Encoding::Ascii;
    if (name == "binary_little_endian") encoding_ = Encoding::Little;
    if (name == "binary_big_endian") encoding_ = Encoding::Big;
  }

  void readProperty(std::istringstream& words, const std::string& line) {
    std::string type, name;
    std::optional<Scalar> length;
    words >> type;
    if (type == "list") {
      words >> type;
      if (length = scalarNamed(type); !length) fail(path_, "has a damaged header: " + line);
      words >> type;
    }
    words >> name;
    const std::optional<Scalar> scalar = scalarNamed(type);
    if (!scalar || name.empty() || elements_.empty()) fail(path_, "has a damaged header: " + line);
    elements_.back().properties.push_back({name, *scalar, length});
  }

  const std::string path_;
  std::ifstream in_;
  std::optional<Encoding> encoding_;
  std::vector<Element> elements_;
};

/// Offset of each property of a vertex among its kFixed floats and the channels after them.
class VertexLayout {
 public:
  enum Fixed { X, Y, Z, Nx, Ny, Nz, Radius, kFixed };

  explicit VertexLayout(const std::vector<Property>& properties) {
    static constexpr std::string_view kNames[kFixed] = {"x", "y", "z", "nx", "ny", "nz", "radius"};
    for (const Property& p : properties) {
      const auto* fixed = std::find(kNames, kNames + kFixed, p.name);
      if (fixed != kNames + kFixed) {
        const auto place = static_cast<size_t>(fixed - kNames);
        has_[place] = true;
        places_.push_back({place, 1});
      } else {
        places_.push_back({kFixed + addToChannel(p.name), colorPart(p.name) >= 0 ? 1 / p.type.whole : 1});
      }
    }
  }

  bool has(Fixed f) const { return has_[f]; }
  const std::vector<CloudChannel>& channels() const { return channels_; }
  size_t width() const { return kFixed + width_; }
  size_t place(size_t property) const { return places_[property].at; }
  double scale(size_t property) const { return places_[property].scale; }

 private:
  struct Place {
    size_t at;
    double scale;
  };

  static int colorPart(const std::string& name) {
    return name == "red" ? 0 : name == "green" ? 1 : name == "blue" ? 2 : -1;
  }

  /// Returns the property's offset among the floats of all channels.
  size_t addToChannel(const std::string& name) {
    const size_t bar = name.rfind('_');
    const int part = colorPart(name);
    const std::string stem = part >= 0 ? "Cs" : bar == std::string::npos ? name : name.substr(0, bar);
    const std::string number = part >= 0                  ? std::to_string(part)
                               : bar == std::string::npos ? std::string()
                                                          : name.substr(bar + 1);
    if (!channels_.empty() && channels_.back().name == stem && number == std::to_string(channels_.back().width))
      ++channels_.back().width;
    else
      channels_.push_back({number == "0" ? stem : name, 1});
    return width_++;
  }

  bool has_[kFixed] = {};
  std::vector<Place> places_;
  std::vector<CloudChannel> channels_;
  size_t width_ = 0;
};

PlyFigures readVertices(PlyReader& in, const Element& element, const std::string& path, const std::string& out,
                        float radius) {
  for (const Property& p : element.properties)
    if (p.length) fail(path, fmt::format("vertices with a list (\"{}\") are not supported", p.name));
  const VertexLayout layout(element.properties);
  if (!layout.has(VertexLayout::X) || !layout.has(VertexLayout::Y) || !layout.has(VertexLayout::Z))
    fail(path, "its vertices have no x, y and z");
  PointFileWriter writer(out, layout.channels());
  std::vector<float> values(layout.width(), 0.0f);
  PlyFigures figures;
  for (uint64_t i = 0; i < element.count; ++i) {
    for (size_t p = 0; p < element.properties.size(); ++p)
      values[layout.place(p)] = static_cast<float>(in.number(element.properties[p].type) * layout.scale(p));
    const vec3 P(values[VertexLayout::X], values[VertexLayout::Y], values[VertexLayout::Z]);
    const vec3 N(values[VertexLayout::Nx], values[VertexLayout::Ny], values[VertexLayout::Nz]);
    const float r = layout.has(VertexLayout::Radius) ? values[VertexLayout::Radius] : radius;
    const bool finite = std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
    if (!finite || !(r >= 0)) {
      ++figures.dropped;
      continue;
    }
    writer.add(P, normalizeOr(N, vec3(0.0f)), r, values.data() + VertexLayout::kFixed);
    ++figures.points;
  }
  writer.finish();
  return figures;
}

std::string headerOf(const PointFile& cloud) {
  std::string h = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment point cloud of Tomales\nelement vertex {}\n", cloud.count());
  const auto property = [&](const std::string& name) { h += "property float " + name + "\n"; };
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "radius"}) property(name);
  for (const CloudChannel& c : cloud.channels())
    for (int k = 0; k < c.width; ++k) property(c.width == 1 ? c.name : fmt::format("{}_{}", c.name, k));
  return h + "end_header\n";
}

void writeRows(const PointFile& cloud, size_t chunk, const std::function<void(const void* data, size_t size)>& write) {
  PointCloud points;
  cloud.read(chunk, points);
  std::vector<float> rows;
  for (size_t i = 0; i < points.count(); ++i) {
    const vec3 p = points.position[i], n = points.normal[i];
    rows.insert(rows.end(), {p.x, p.y, p.z, n.x, n.y, n.z, points.radius[i]});
    rows.insert(rows.end(), points.at(i), points.at(i) + points.width());
  }
  write(rows.data(), rows.size() * sizeof(float));
}

}  // namespace

void writePly(const PointFile& cloud, const std::string& path) {
  std::string why;
  const auto file = UnfinishedFile::create(path, UnfinishedKind::Stream, why);
  const auto failed = [&](const std::string& problem) {
    throw WriteError(fmt::format("\"{}\" cannot be written: {}", path, problem));
  };
  const auto write = [&](const void* data, size_t size) {
    if (std::fwrite(data, 1, size, file->stream()) != size) failed(std::strerror(errno));
  };
  if (!file) failed(why);
  const std::string header = headerOf(cloud);
  write(header.data(), header.size());
  for (size_t chunk = 0; chunk < cloud.chunkCount(); ++chunk) writeRows(cloud, chunk, write);
  if (!file->finish(why)) failed(why);
}

PlyFigures convertPly(const std::string& path, const std::string& out, float radius) {
  PlyReader in(path);
  for (const Element& element : in.elements()) {
    if (element.name == "vertex") return readVertices(in, element, path, out, radius);
    in.skip(element);
  }
  fail(path, "has no vertices");
}

}  // namespace tomales
