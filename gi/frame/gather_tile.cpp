#include "gi/frame/gather_tile.h"

#include <array>
#include <utility>

#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr size_t kMostInMemory_bytes = size_t{400} << 20;
constexpr uint32_t kNone = ~0U;

/// The points of a tile, numbered over all its batches.
struct Numbers {
  std::vector<uint32_t> firstOfBatch{0};

  explicit Numbers(const DeepTile& tile) {
    for (const ShadePoints& batch : tile.batches)
      firstOfBatch.push_back(firstOfBatch.back() + static_cast<uint32_t>(batch.count()));
  }
  size_t of(size_t batch, int point) const { return firstOfBatch[batch] + static_cast<size_t>(point); }
  size_t count() const { return firstOfBatch.back(); }
};

/// Calls ask(phase, batch, point, pixel) for each point of a tile at which something is gathered, in the order of
/// pixels: for the nearest point of a pixel in the phase of that pixel, and for the further points of pixels once in a
/// later phase.
template <class Ask>
void forEachAskedPoint(const DeepTile& tile, const Numbers& numbers, const std::vector<uint8_t>& gathers,
                       const Ask& ask) {
  const auto width = static_cast<uint32_t>(tile.rect.width());
  std::vector<uint8_t> askedLate(numbers.count(), 0);
  for (uint32_t pixel = 0; pixel < tile.pixels.size(); ++pixel) {
    const DeepPixel& seen = tile.pixels[pixel];
    bool first = true;
    for (uint32_t f = seen.first; f < seen.first + seen.count; ++f) {
      const Facet& facet = tile.facets[tile.fragments[f].facet];
      const auto b = static_cast<size_t>(facet.batch);
      if (!gathers[static_cast<size_t>(tile.batches[b].group())]) continue;
      for (int corner = 0; corner < 4; ++corner) {
        const int point = facet.point[corner];
        if (corner > 0 && point == facet.point[0]) continue;
        if (first)
          ask(latticePhase(tile.rect.x0 + static_cast<int>(pixel % width),
                           tile.rect.y0 + static_cast<int>(pixel / width)),
              b, point, pixel);
        else if (!std::exchange(askedLate[numbers.of(b, point)], 1))
          ask(kLatticePhases + static_cast<int>(hash32(tile.batches[b].key(point)) % kLastPhases), b, point, pixel);
        first = false;
      }
    }
  }
}

}  // namespace

GatherTile::GatherTile(const GiState& state, const DeepTile& tile, const std::vector<uint8_t>& gathers)
    : rect_(tile.rect), end_(kGatherPhases + 1) {
  std::vector<GatherPlaces> placesOf;
  for (const ShadePoints& batch : tile.batches) placesOf.emplace_back(state, batch);
  const Numbers numbers(tile);
  std::vector<uint32_t> placeOf(numbers.count(), kNone);
  std::array<std::vector<Asked>, kGatherPhases> ofPhase;
  forEachAskedPoint(tile, numbers, gathers, [&](int phase, size_t batch, int point, uint32_t pixel) {
    uint32_t& place = placeOf[numbers.of(batch, point)];
    if (place == kNone) {
      place = static_cast<uint32_t>(places_.size());
      keep(placesOf[batch].at(point));
    }
    ofPhase[static_cast<size_t>(phase)].push_back({place, pixel});
  });
  for (size_t phase = 0; phase < ofPhase.size(); ++phase) {
    asked_.insert(asked_.end(), ofPhase[phase].begin(), ofPhase[phase].end());
    end_[phase + 1] = static_cast<uint32_t>(asked_.size());
  }
  places_.shrink_to_fit();
  movements_.shrink_to_fit();
  asked_.shrink_to_fit();
}

void GatherTile::keep(const GatherPoint& p) {
  constexpr Movement kStill{vec3(0), -1};
  if (!movements_.empty() || p.drift != kStill.drift || p.time != kStill.time) {
    movements_.resize(places_.size(), kStill);
    movements_.push_back({p.drift, p.time});
  }
  places_.push_back({p.group, p.key, p.position, p.normal, p.edgeLength});
}

GatherPoint GatherTile::at(const Camera& camera, uint32_t place) const {
  const Place& p = places_[place];
  GatherPoint out{p.group, p.position, p.normal, p.key, projectedPixelSize(camera, p.position, p.normal), p.edgeLength};
  if (!movements_.empty()) {
    out.drift = movements_[place].drift;
    out.time = movements_[place].time;
  }
  return out;
}

size_t GatherTile::bytes() const {
  return places_.capacity() * sizeof(Place) + movements_.capacity() * sizeof(Movement) +
         asked_.capacity() * sizeof(Asked) + end_.capacity() * sizeof(uint32_t);
}

std::shared_ptr<const GatherTile> GatherTiles::read(size_t index) {
  if (kept_[index]) return kept_[index];
  const auto tile = tiles_(index);
  if (!tile) return nullptr;
  auto made = std::make_shared<const GatherTile>(state_, *tile, gathers_);
  if ((kept_bytes_ += made->bytes()) > kMostInMemory_bytes)
    kept_bytes_ -= made->bytes();
  else
    kept_[index] = made;
  return made;
}

}  // namespace tomales
