#include "gi/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <span>

#include "reyes/base/checksum.h"
#include "reyes/base/ply_reader.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

/// The limit of lengths: the square of a larger one would be infinite.
constexpr float kLargest = 1e18f;

/// The checksum of the header and all vertices, in the order of the file. It can be taken while they are streamed.
class VertexSum {
 public:
  explicit VertexSum(std::string_view header) : sum_(checksum(std::as_bytes(std::span(header)))) {}
  void add(std::span<const float> vertex) {
    bytes_.resize(sizeof sum_ + vertex.size_bytes());
    std::memcpy(bytes_.data(), &sum_, sizeof sum_);
    std::memcpy(bytes_.data() + sizeof sum_, vertex.data(), vertex.size_bytes());
    sum_ = checksum(bytes_);
  }
  std::string text() const { return fmt::format("{:016x}", sum_); }

 private:
  uint64_t sum_;
  Bytes bytes_;
};

constexpr const char* kEndOfHeader = "end_header\n";

/// Finds the offset of each property of a vertex among its kFixed floats and the channels after them.
class VertexLayout {
 public:
  enum Fixed { X, Y, Z, Nx, Ny, Nz, Radius, kFixed };

  explicit VertexLayout(const std::vector<PlyProperty>& properties) {
    static constexpr std::string_view kNames[kFixed] = {"x", "y", "z", "nx", "ny", "nz", "radius"};
    for (const PlyProperty& p : properties) {
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

PlyFigures readVertices(PlyReader& in, const PlyElement& element, const std::string& path, const std::string& out,
                        float radius, const std::function<void()>& readRest) {
  for (const PlyProperty& p : element.properties)
    if (p.length) failPly(path, fmt::format("vertices with a list (\"{}\") are not supported", p.name));
  const VertexLayout layout(element.properties);
  if (!layout.has(VertexLayout::X) || !layout.has(VertexLayout::Y) || !layout.has(VertexLayout::Z))
    failPly(path, "its vertices have no x, y and z");
  PointFileWriter writer(out, layout.channels());
  std::vector<float> values(layout.width(), 0.0f), asWritten(element.properties.size());
  VertexSum sum(in.header());
  PlyFigures figures;
  for (uint64_t i = 0; i < element.count; ++i) {
    for (size_t p = 0; p < element.properties.size(); ++p) {
      const double number = in.number(element.properties[p].type);
      asWritten[p] = static_cast<float>(number);
      values[layout.place(p)] = static_cast<float>(number * layout.scale(p));
    }
    if (in.sum()) sum.add(asWritten);
    for (int k = 0; k < VertexLayout::kFixed; ++k)
      if (std::abs(values[static_cast<size_t>(k)]) > kLargest && std::isfinite(values[static_cast<size_t>(k)]))
        failPly(path, fmt::format("is damaged: {:g} in vertex {} is more than any length",
                                  values[static_cast<size_t>(k)], i + 1));
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
  if (in.sum() && *in.sum() != sum.text()) failPly(path, "is damaged: its checksum is that of other vertices");
  readRest();
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
  return h + kEndOfHeader;
}

void forEachVertex(const PointFile& cloud, const std::function<void(std::span<const float>)>& take) {
  PointCloud points;
  std::vector<float> vertex;
  for (size_t chunk = 0; chunk < cloud.chunkCount(); ++chunk) {
    points = PointCloud();
    cloud.read(chunk, points);
    for (size_t i = 0; i < points.count(); ++i) {
      const vec3 p = points.position[i], n = points.normal[i];
      vertex = {p.x, p.y, p.z, n.x, n.y, n.z, points.radius[i]};
      vertex.insert(vertex.end(), points.at(i), points.at(i) + points.width());
      take(vertex);
    }
  }
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
  std::string header = headerOf(cloud);
  VertexSum sum(header);
  forEachVertex(cloud, [&](std::span<const float> vertex) { sum.add(vertex); });
  header.insert(header.rfind(kEndOfHeader), fmt::format("{}{}\n", kPlySumComment, sum.text()));
  write(header.data(), header.size());
  forEachVertex(cloud, [&](std::span<const float> vertex) { write(vertex.data(), vertex.size_bytes()); });
  if (!file->finish(why)) failed(why);
}

PlyFigures convertPly(const std::string& path, const std::string& out, float radius) {
  PlyReader in(path);
  const auto& elements = in.elements();
  const auto isVertex = [](const PlyElement& e) { return e.name == "vertex"; };
  const auto vertices = std::find_if(elements.begin(), elements.end(), isVertex);
  if (vertices == elements.end()) failPly(path, "has no vertices");
  std::for_each(elements.begin(), vertices, [&](const PlyElement& e) { in.skip(e); });
  return readVertices(in, *vertices, path, out, radius, [&] {
    std::for_each(vertices + 1, elements.end(), [&](const PlyElement& e) { in.skip(e); });
    in.requireEnd();
  });
}

}  // namespace tomales
