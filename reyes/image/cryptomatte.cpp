#include "reyes/image/cryptomatte.h"

#include <fmt/format.h>

#include <bit>
#include <set>

#include "reyes/base/parallel.h"
#include "reyes/image/deep_rows.h"

namespace tomales {
namespace {

constexpr int kRankedRows = 16;

// A. Appleby's MurmurHash3_x86_32, seed 0 (public domain; the name of the hash is part of the file format).
uint32_t murmur3(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<uint32_t>(static_cast<unsigned char>(text[i])); };
  const auto scrambled = [](uint32_t k) { return std::rotl(k * 0xcc9e2d51U, 15) * 0x1b873593U; };
  uint32_t h = 0, tail = 0;
  const size_t whole = text.size() / 4 * 4;
  for (size_t i = 0; i < whole; i += 4)
    h = std::rotl(h ^ scrambled(byte(i) | byte(i + 1) << 8 | byte(i + 2) << 16 | byte(i + 3) << 24), 13) * 5 +
        0xe6546b64U;
  for (size_t i = text.size(); i > whole; --i) tail = tail << 8 | byte(i - 1);
  h ^= scrambled(tail);
  h ^= static_cast<uint32_t>(text.size());
  h = (h ^ (h >> 16)) * 0x85ebca6bU;
  h = (h ^ (h >> 13)) * 0xc2b2ae35U;
  return h ^ (h >> 16);
}

uint32_t idBits(std::string_view name) {
  const uint32_t hash = murmur3(name), exponent = hash >> 23 & 255;
  return exponent == 0 || exponent == 255 ? hash ^ (1U << 23) : hash;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\u{:04x}", static_cast<int>(c));
    else
      out += c;
  }
  return out + "\"";
}

}  // namespace

float cryptoId(const std::string& name) { return std::bit_cast<float>(idBits(name)); }

void cryptomatte(const DeepFrame& frame, const Options& options, const SampleOffsets& samples,
                 const std::vector<std::string>& names, int first, Image& band) {
  std::vector<float> ids;
  for (const std::string& name : names) ids.push_back(cryptoId(name));
  const WeightTable weights(positiveFilter(options), samples);
  parallelFor(static_cast<size_t>(band.height), kRankedRows, [&](size_t begin, size_t end) {
    const int y0 = band.originY + static_cast<int>(begin), y1 = band.originY + static_cast<int>(end);
    const LayeredRows rows = layersOf(frame, options, y0 - weights.reachY, y1 + weights.reachY);
    struct Share {
      float id, coverage;
    };
    std::vector<Share> shares;
    for (int y = y0; y < y1; ++y)
      for (int x = band.originX; x < band.originX + band.width; ++x) {
        shares.clear();
        float total = 0;
        forNeighbours(rows.rect, weights, samples, x, y, [&](const WeightTable::Cell& cell, const ivec2& pixel) {
          total += weights.sum(cell);
          for (const Layer& l : rows.at(pixel)) {
            const float coverage = weights.sum(cell, l.samples, l.word) * meanOf(l.coverage),
                        id = ids[static_cast<size_t>(l.group)];
            if (!(coverage > 0)) continue;
            const auto known = std::find_if(shares.begin(), shares.end(), [&](const Share& s) { return s.id == id; });
            if (known == shares.end())
              shares.push_back({id, coverage});
            else
              known->coverage += coverage;
          }
        });
        std::sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) {
          return a.coverage != b.coverage ? a.coverage > b.coverage : a.id < b.id;
        });
        float* out = band.at(x - band.originX, y - band.originY) + first;
        for (size_t rank = 0; rank < std::min<size_t>(shares.size(), kCryptoFloats / 2); ++rank) {
          out[2 * rank] = shares[rank].id;
          out[2 * rank + 1] = shares[rank].coverage / total;
        }
      }
  });
}

std::vector<Metadata> cryptoMetadata(const std::string& layer, const std::vector<std::string>& names) {
  const std::string key = "cryptomatte/" + fmt::format("{:08x}", murmur3(layer)).substr(0, 7) + "/";
  std::string manifest = "{";
  for (const std::string& name : std::set<std::string>(names.begin(), names.end()))
    manifest += fmt::format("{}{}:\"{:08x}\"", manifest.size() > 1 ? "," : "", quoted(name), idBits(name));
  return {{key + "name", layer, {}},
          {key + "hash", "MurmurHash3_32", {}},
          {key + "conversion", "uint32_to_float32", {}},
          {key + "manifest", manifest + "}", {}}};
}

}  // namespace tomales
