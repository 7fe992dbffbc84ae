// Lookups through the renderer's texture unit over those of a bare TextureSystem loop on the same points; and how many
// tiles a scan over a picture reads again when little of it fits in memory. Prints ratios of interleaved runs.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/texture.h>
#include <fmt/format.h>

#include <cstdio>
#include <ctime>
#include <filesystem>

#include "reyes/shade/texture.h"

namespace {

using namespace tomales;
constexpr int kEdge = 1024, kBatch = 256;

/// The processor time of the call, so that what else runs on the machine counts little.
template <class Call>
double secondsOf(const Call& call) {
  const std::clock_t start = std::clock();
  call();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// A row of points over a tilted plane: footprints four times as long as wide.
struct Row {
  std::vector<float> s, t, su, tu, sv, tv, r, g, b;
  std::vector<uint8_t> active;
  explicit Row(int y) : r(kBatch), g(kBatch), b(kBatch), active(kBatch, 1) {
    for (int x = 0; x < kBatch; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / kBatch, v = (static_cast<float>(y) + 0.5f) / kBatch;
      s.push_back(0.1f + 0.7f * u + 0.1f * v);
      t.push_back(0.1f + 0.1f * u + 0.7f * v);
      su.push_back(0.7f / kBatch);
      tu.push_back(0.1f / kBatch);
      sv.push_back(0.1f / kBatch);
      tv.push_back(2.8f / kBatch);
    }
  }
};

}  // namespace

int main() {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / "tomales_texture_bench";
  fs::create_directories(folder);
  OIIO::ImageBuf picture(OIIO::ImageSpec(kEdge, kEdge, 3, OIIO::TypeDesc::UINT8));
  for (int y = 0; y < kEdge; ++y)
    for (int x = 0; x < kEdge; ++x) {
      const float c[3] = {static_cast<float>(x * 7 % 256) / 255, static_cast<float>(y * 5 % 256) / 255,
                          static_cast<float>((x ^ y) % 256) / 255};
      picture.setpixel(x, y, c);
    }
  const std::string source = (folder / "source.tif").string(), file = (folder / "picture.tx").string();
  std::string error;
  if (!picture.write(source) || makeTexture({TextureRecipe::Shape::Picture, {source}, file}, error) != Making::Done) {
    std::puts(error.c_str());
    return 1;
  }

  Log log;
  Stats stats;
  const Textures textures({"", (folder / "cache").string()}, log, stats);
  OIIO::TextureSystem* bare = OIIO::TextureSystem::create(false);
  OIIO::TextureSystem::TextureHandle* handle = bare->get_texture_handle(OIIO::ustring(file));
  OIIO::TextureSystem::Perthread* thread = bare->get_perthread_info();
  std::vector<Row> rows;
  for (int y = 0; y < kBatch; ++y) rows.emplace_back(y);
  const auto ours = [&] {
    for (Row& row : rows) {
      TextureQuery q{file.c_str()};
      q.count = kBatch;
      q.active = row.active.data();
      q.s = row.s.data();
      q.t = row.t.data();
      q.su = row.su.data();
      q.tu = row.tu.data();
      q.sv = row.sv.data();
      q.tv = row.tv.data();
      textures.lookup(q, {}, "bench", {row.r.data(), row.g.data(), row.b.data()});
    }
  };
  const auto theirs = [&] {
    OIIO::TextureOpt options;
    options.interpmode = OIIO::TextureOpt::InterpBilinear;
    for (Row& row : rows)
      for (size_t i = 0; i < kBatch; ++i) {
        float c[3];
        bare->texture(handle, thread, options, row.s[i], row.t[i], row.su[i], row.tu[i], row.sv[i], row.tv[i], 3, c);
        row.r[i] = c[0];
        row.g[i] = c[1];
        row.b[i] = c[2];
      }
  };
  ours();
  theirs();
  for (int run = 0; run < 5; ++run) {
    const double a = secondsOf(ours), b = secondsOf(theirs);
    std::puts(fmt::format("{:.0f} ns a lookup, bare loop {:.0f} ns, ratio {:.2f}", 1e9 * a / (kBatch * kBatch),
                          1e9 * b / (kBatch * kBatch), a / b)
                  .c_str());
  }
  OIIO::TextureSystem::destroy(bare, true);

  // Scanline order over 256 pictures, of whose texels 1 % fits.
  Stats small;
  {
    constexpr int kPictures = 256;  // OpenImageIO holds 10 MB at least
    const int64_t total = kPictures * int64_t{kEdge} * kEdge * 4;
    for (int k = 0; k < kPictures; ++k)
      fs::copy_file(file, folder / fmt::format("{}.tx", k), fs::copy_options::overwrite_existing);
    const Textures little({folder.string(), (folder / "cache").string(), total / 100}, log, small);
    for (int y = 0; y < kBatch; ++y)
      for (int k = 0; k < kPictures; ++k) {
        Row row(y);
        const std::string name = fmt::format("{}.tx", k);
        TextureQuery q{name.c_str()};
        q.count = kBatch;
        q.active = row.active.data();
        q.s = row.s.data();
        q.t = row.t.data();
        q.su = row.su.data();
        q.tu = row.tu.data();
        q.sv = row.sv.data();
        q.tv = row.tv.data();
        little.lookup(q, {}, "bench", {row.r.data(), row.g.data(), row.b.data()});
      }
  }
  const int64_t requests = small.textures.tileRequests, misses = small.textures.tileMisses;
  std::puts(fmt::format("cache of 1 %: {} tile requests, {} misses, hit rate {:.4f}", requests, misses,
                        1 - static_cast<double>(misses) / static_cast<double>(requests))
                .c_str());
  fs::remove_all(folder);
  return 0;
}
