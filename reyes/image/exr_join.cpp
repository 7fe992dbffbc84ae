#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStdIO.h>
#include <fmt/format.h>

#include <OpenEXR/ImfVersion.h>
#include <cstring>
#include <map>
#include <set>

#include "reyes/base/chunk_file.h"
#include "reyes/base/unfinished_file.h"
#include "reyes/image/exr_headers.h"
#include "reyes/image_files.h"

namespace tomales {
namespace {

/// Attributes that differ between tiles of one frame: which part of the frame the tile is, and statistics of its
/// rendering.
constexpr const char* kOfTile[] = {"dataWindow", "chunkCount", kStatistics};

/// Messages for attributes that differ between tiles; other attributes are only named.
constexpr std::pair<const char*, const char*> kMeanings[] = {
    {"displayWindow", "the frames are of different sizes"},
    {"channels", "their channels differ"},
    {kGathered,
     "each gathered light for its own window, which leaves seams: make tiles by hide, gather and shade --crop"},
    {kContents, "they show different scenes, shaders or textures, or were rendered with different settings"},
    {kShot, "they are of different shots, caches or edits"}};

struct PictureTile {
  explicit PictureTile(const std::string& file) : path(file) {
    try {
      in = std::make_unique<Imf::MultiPartInputFile>(file.c_str());
    } catch (const std::exception& e) {
      throw FileError(fmt::format("\"{}\" cannot be read as an OpenEXR picture: {}", file, e.what()));
    }
    const Imath::Box2i& data = in->header(0).dataWindow();
    window = {data.min.x, data.min.y, data.max.x + 1, data.max.y + 1};
  }
  std::string path;
  std::unique_ptr<Imf::MultiPartInputFile> in;
  PixelRect window;
};

/// Returns the bytes of all attributes but those of the tile alone.
std::map<std::string, std::string> attributesOf(const Imf::Header& header) {
  std::map<std::string, std::string> out;
  for (auto a = header.begin(); a != header.end(); ++a) {
    Imf::StdOSStream bytes;
    a.attribute().writeValueTo(bytes, Imf::EXR_VERSION);
    out[a.name()] = bytes.str();
  }
  for (const char* name : kOfTile) out.erase(name);
  return out;
}

std::string nameOfDifference(const Imf::Header& a, const Imf::Header& b) {
  const auto left = attributesOf(a), right = attributesOf(b);
  std::set<std::string> names;
  for (const auto& [name, value] : left)
    if (const auto other = right.find(name); other == right.end() || other->second != value) names.insert(name);
  for (const auto& [name, value] : right)
    if (!left.contains(name)) names.insert(name);
  for (const auto& [name, meaning] : kMeanings)
    if (names.contains(name)) return meaning;
  return names.empty() ? "" : fmt::format("their headers \"{}\" differ", *names.begin());
}

void refuseStranger(const PictureTile& first, const PictureTile& tile) {
  std::string why = first.in->parts() == tile.in->parts() ? "" : "they have different parts";
  for (int p = 0; why.empty() && p < first.in->parts(); ++p)
    why = nameOfDifference(first.in->header(p), tile.in->header(p));
  if (!why.empty())
    throw FileError(fmt::format("\"{}\" is no tile of the frame of \"{}\": {}", tile.path, first.path, why));
}

/// Refuses tiles that leave a pixel out. The edges of the tiles divide the window into cells, each of which is covered
/// wholly or not at all.
void refuseGaps(const std::vector<PictureTile>& tiles, const PixelRect& whole) {
  std::set<int> columns{whole.x0}, rows{whole.y0};
  for (const PictureTile& t : tiles)
    for (const int x : {t.window.x0, t.window.x1}) columns.insert(x);
  for (const PictureTile& t : tiles)
    for (const int y : {t.window.y0, t.window.y1}) rows.insert(y);
  for (const int y : rows)
    for (const int x : columns) {
      if (!whole.contains(x, y)) continue;
      if (std::none_of(tiles.begin(), tiles.end(), [&](const PictureTile& t) { return t.window.contains(x, y); }))
        throw FileError(
            fmt::format("no tile has the pixel {},{}: tiles are missing, or the frame has a crop window of "
                        "its own, which --crop tells",
                        x, y));
    }
  for (const PictureTile& t : tiles)
    if (t.window.x0 < whole.x0 || t.window.y0 < whole.y0 || t.window.x1 > whole.x1 || t.window.y1 > whole.y1)
      throw FileError(fmt::format("\"{}\" reaches beyond the window of the frame", t.path));
}

/// Reads raster rows of one kind of picture from the tiles, and finds where two tiles that overlap differ.
class TileRows {
 public:
  TileRows(const std::vector<PictureTile>& tiles, const Image& shape) : tiles_(tiles), shape_(shape) {}

  Image flat(int y0, int height) const {
    Image out = bandOf(y0, height);
    const size_t channels = shape_.channels.size(), width = static_cast<size_t>(shape_.width);
    out.pixels.resize(width * static_cast<size_t>(height) * channels);
    std::vector<bool> known(width * static_cast<size_t>(height));
    for (const PictureTile& t : tiles_) {
      const Image part = flatOf(t, y0, y0 + height);
      for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width; ++x) {
          const int column = part.originX + x - shape_.originX, row = part.originY + y - y0;
          float* to = out.at(column, row);
          const float* from = part.at(x, y);
          std::vector<bool>::reference seen = known[static_cast<size_t>(row) * width + static_cast<size_t>(column)];
          if (seen && std::memcmp(to, from, channels * sizeof(float)) != 0)
            refuse(t, part.originX + x, part.originY + y);
          std::copy_n(from, channels, to);
          seen = true;
        }
    }
    return out;
  }

  DeepRows deep(int y0, int height) const {
    const size_t width = static_cast<size_t>(shape_.width), pixels = width * static_cast<size_t>(height);
    std::vector<std::optional<std::vector<float>>> samples(pixels);
    const size_t channels = shape_.channels.size();
    for (const PictureTile& t : tiles_) {
      const DeepRows part = deepOf(t, y0, y0 + height);
      const float* from = part.values.data();
      for (size_t i = 0; i < part.counts.size(); ++i) {
        const int x = part.x0 + static_cast<int>(i) % part.width, y = part.y0 + static_cast<int>(i) / part.width;
        std::vector<float> values(from, from + part.counts[i] * channels);
        from += values.size();
        auto& known = samples[static_cast<size_t>(y - y0) * width + static_cast<size_t>(x - shape_.originX)];
        if (known && (known->size() != values.size() ||
                      std::memcmp(known->data(), values.data(), values.size() * sizeof(float)) != 0))
          refuse(t, x, y);
        known = std::move(values);
      }
    }
    DeepRows out{shape_.originX, y0, shape_.width, height, {}, {}};
    for (const auto& values : samples) {
      out.counts.push_back(static_cast<uint32_t>(values->size() / channels));
      out.values.insert(out.values.end(), values->begin(), values->end());
    }
    return out;
  }

 private:
  [[noreturn]] static void refuse(const PictureTile& t, int x, int y) {
    throw FileError(fmt::format("\"{}\" differs at pixel {},{} from a tile that has it too", t.path, x, y));
  }

  Image bandOf(int y0, int height) const {
    Image out = shape_;
    out.originY = y0;
    out.height = height;
    return out;
  }

  Image flatOf(const PictureTile& t, int begin, int end) const {
    Image out = bandOf(std::max(begin, t.window.y0), 0);
    out.originX = t.window.x0;
    out.width = t.window.width();
    out.height = std::max(0, std::min(end, t.window.y1) - out.originY);
    const size_t channels = out.channels.size();
    out.pixels.resize(static_cast<size_t>(out.width) * static_cast<size_t>(out.height) * channels);
    if (out.height == 0) return out;
    const Imath::V2i origin(out.originX, out.originY);
    for (int p = 0; p < t.in->parts(); ++p) {
      Imf::FrameBuffer buffer;
      const Imf::ChannelList& list = t.in->header(p).channels();
      for (auto c = list.begin(); c != list.end(); ++c)
        buffer.insert(c.name(), Imf::Slice::Make(Imf::FLOAT, out.pixels.data() + out.channelIndex(c.name()), origin,
                                                 out.width, out.height, channels * sizeof(float),
                                                 channels * sizeof(float) * static_cast<size_t>(out.width)));
      Imf::InputPart part(*t.in, p);
      part.setFrameBuffer(buffer);
      read(t, [&] { part.readPixels(out.originY, out.originY + out.height - 1); });
    }
    return out;
  }

  DeepRows deepOf(const PictureTile& t, int begin, int end) const {
    DeepRows out{t.window.x0, std::max(begin, t.window.y0), t.window.width(), 0, {}, {}};
    out.height = std::max(0, std::min(end, t.window.y1) - out.y0);
    if (out.height == 0) return out;
    out.counts.resize(static_cast<size_t>(out.width) * static_cast<size_t>(out.height));
    const Imath::Box2i window({out.x0, out.y0}, {out.x0 + out.width - 1, out.y0 + out.height - 1});
    const size_t row = static_cast<size_t>(out.width), channels = shape_.channels.size();
    Imf::DeepScanLineInputPart part(*t.in, 0);
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(Imf::Slice::Make(Imf::UINT, out.counts.data(), window));
    std::vector<std::vector<float*>> pointers(channels, std::vector<float*>(out.counts.size()));
    const ptrdiff_t back = out.x0 + static_cast<ptrdiff_t>(out.y0) * static_cast<ptrdiff_t>(row);
    for (size_t c = 0; c < channels; ++c)
      buffer.insert(shape_.channels[c], Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers[c].data() - back),
                                                       sizeof(float*), sizeof(float*) * row, sizeof(float) * channels));
    part.setFrameBuffer(buffer);
    read(t, [&] {
      part.readPixelSampleCounts(out.y0, out.y0 + out.height - 1);
      size_t samples = 0;
      for (const uint32_t count : out.counts) samples += count;
      out.values.resize((samples + 1) * channels);  // one more, so that there is an end to point at
      for (size_t c = 0; c < channels; ++c)
        for (size_t i = 0, first = 0; i < out.counts.size(); first += out.counts[i++])
          pointers[c][i] = out.values.data() + first * channels + c;
      part.readPixels(out.y0, out.y0 + out.height - 1);
      out.values.resize(samples * channels);
    });
    return out;
  }

  template <class Read>
  static void read(const PictureTile& t, const Read& work) {
    try {
      work();
    } catch (const std::exception& e) {
      throw FileError(fmt::format("\"{}\" cannot be read: {}", t.path, e.what()));
    }
  }

  const std::vector<PictureTile>& tiles_;
  const Image& shape_;
};

Image shapeOf(const PictureTile& tile, const PixelRect& whole) {
  const Imath::Box2i& display = tile.in->header(0).displayWindow();
  Image shape{whole.width(), whole.height(), {}, {}, whole.x0, whole.y0, display.max.x + 1, display.max.y + 1};
  for (int p = 0; p < tile.in->parts(); ++p) {
    const Imf::ChannelList& list = tile.in->header(p).channels();
    for (auto c = list.begin(); c != list.end(); ++c) shape.channels.push_back(c.name());
  }
  return shape;
}

std::vector<Imf::Header> headersOf(const PictureTile& tile, const PixelRect& whole) {
  std::vector<Imf::Header> out;
  for (int p = 0; p < tile.in->parts(); ++p) {
    Imf::Header header = tile.in->header(p);
    header.erase("chunkCount");
    header.erase(kStatistics);
    header.dataWindow() = {{whole.x0, whole.y0}, {whole.x1 - 1, whole.y1 - 1}};
    out.push_back(header);
  }
  return out;
}

}  // namespace

void joinPictures(const std::vector<std::string>& files, const std::string& output,
                  const std::optional<std::array<float, 4>>& crop) {
  std::vector<PictureTile> tiles;
  for (const std::string& file : files) tiles.emplace_back(file);
  for (const PictureTile& tile : tiles) refuseStranger(tiles.front(), tile);
  const Imf::Header& first = tiles.front().in->header(0);
  Options options;
  options.xResolution = first.displayWindow().max.x + 1;
  options.yResolution = first.displayWindow().max.y + 1;
  if (crop) options.cropWindow = *crop;
  const PixelRect whole = Camera(options).crop();
  refuseGaps(tiles, whole);

  std::string why;
  const auto unwritten = [&] { return WriteError(fmt::format("\"{}\" could not be written: {}", output, why)); };
  const auto file = UnfinishedFile::create(output, UnfinishedKind::Scratch, why);
  if (!file) throw unwritten();
  const Image shape = shapeOf(tiles.front(), whole);
  const TileRows rows(tiles, shape);
  const bool deep = first.hasType() && first.type() == Imf::DEEPSCANLINE;
  try {
    const auto writer = openExrOf(file->path(), shape, headersOf(tiles.front(), whole));
    for (int y = whole.y0; y < whole.y1; y += PictureFile::kBandRows) {
      const int height = std::min(PictureFile::kBandRows, whole.y1 - y);
      if (deep)
        writer->write(rows.deep(y, height));
      else
        writer->write(rows.flat(y, height));
    }
    writer->close();
  } catch (const FileError&) {
    throw;
  } catch (const std::exception& e) {
    why = e.what();
    throw unwritten();
  }
  if (!file->finish(why)) throw unwritten();
}

}  // namespace tomales
