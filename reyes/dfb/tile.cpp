#include "reyes/dfb/tile.h"

namespace tomales {
namespace {

/// Packs one member of all elements.
template <class A, class T, class Member>
void column(A& a, std::vector<T>& x, Member T::*member) {
  if constexpr (kIsSchema<A>) {
    a.add(sizeof(Member));
  } else if constexpr (kUnpacks<A>) {
    if (x.size() * sizeof(Member) > a.bytes.size()) return void(a.damaged = true);
    for (size_t i = 0; i < x.size(); ++i)
      std::memcpy(&(x[i].*member), a.bytes.data() + i * sizeof(Member), sizeof(Member));
    a.bytes = a.bytes.subspan(x.size() * sizeof(Member));
  } else {
    const size_t begin = a.bytes.size();
    a.bytes.resize(begin + x.size() * sizeof(Member));
    for (size_t i = 0; i < x.size(); ++i)
      std::memcpy(a.bytes.data() + begin + i * sizeof(Member), &(x[i].*member), sizeof(Member));
  }
}

template <class A, class T, class... Members>
void columns(A& a, std::vector<T>& x, Members... members) {
  x.resize(countField(a, x.size()));
  (column(a, x, members), ...);
}

// The structured bindings stop the compiler at a structure that has gained a member which its list lacks.
template <class A>
void facets(A& a, std::vector<Facet>& x) {
  [[maybe_unused]] const auto& [batch, point, matte, edge] = Facet{};
  columns(a, x, &Facet::batch, &Facet::point, &Facet::matte);
}

template <class A>
void fragments(A& a, std::vector<Fragment>& x) {
  [[maybe_unused]] const auto& [facet, z, samples, word, u, v] = Fragment{};
  columns(a, x, &Fragment::facet, &Fragment::z, &Fragment::samples, &Fragment::word, &Fragment::u, &Fragment::v);
}

template <class A>
void pixels(A& a, std::vector<DeepPixel>& x) {
  [[maybe_unused]] const auto& [first, count] = DeepPixel{};
  columns(a, x, &DeepPixel::first, &DeepPixel::count);
}

template <class A>
void batch(A& a, ShadePoints& x) {
  int group = x.group(), primvarFloats = x.primvarFloats();
  bool steps = x.hasSteps();
  std::vector<SampleName> names;
  names.reserve(static_cast<size_t>(x.count()));
  for (int i = 0; i < x.count(); ++i) names.push_back(x.name(i));
  each(a, group, primvarFloats, steps);
  columns(a, names, &SampleName::key, &SampleName::sequence);
  if constexpr (kIsSchema<A>) {
    a.add(kFixedChannels), a.add(kStepPrimvars);
  } else {
    const size_t bytes = names.size() * sizeof(float);
    if constexpr (kUnpacks<A>) {
      if (primvarFloats < 0 || static_cast<size_t>(primvarFloats) > a.bytes.size()) return void(a.damaged = true);
      x = ShadePoints(group, primvarFloats, steps);
      if (bytes * static_cast<size_t>(x.channelCount()) > a.bytes.size()) return void(a.damaged = true);
      x.reserve(static_cast<int>(names.size()));
      for (const SampleName& name : names) x.add(name);
    }
    for (int c = 0; c < x.channelCount(); ++c) a.raw(x.channel(c), bytes);
  }
}

template <class A>
void tileFields(A& a, DeepTile& x) {
  auto& [rect, batches, facetList, fragmentList, pixelList, shaded, answers] = x;
  each(a, rect.x0, rect.y0, rect.x1, rect.y1);
  const size_t count = countField(a, batches.size());
  if constexpr (kUnpacks<A>) batches.assign(count, ShadePoints(0, 0));
  for (ShadePoints& b : batches) batch(a, b);
  facets(a, facetList), fragments(a, fragmentList), pixels(a, pixelList);
}

/// Detects inconsistency that no checksum shows, for instance in a file made by hand.
bool consistent(const DeepTile& t) {
  const auto fits = [&](const Facet& f) {
    if (f.batch < 0 || f.batch >= static_cast<int>(t.batches.size())) return false;
    const int count = t.batches[static_cast<size_t>(f.batch)].count();
    return std::all_of(std::begin(f.point), std::end(f.point), [&](int p) { return p >= 0 && p < count; });
  };
  return t.pixels.size() == static_cast<size_t>(t.rect.width()) * static_cast<size_t>(t.rect.height()) &&
         std::all_of(t.facets.begin(), t.facets.end(), fits) &&
         std::all_of(t.fragments.begin(), t.fragments.end(),
                     [&](const Fragment& f) { return f.facet < t.facets.size(); }) &&
         std::all_of(t.pixels.begin(), t.pixels.end(), [&](const DeepPixel& p) {
           return p.first <= t.fragments.size() && p.count <= t.fragments.size() - p.first;
         });
}

}  // namespace

Bytes packTile(const DeepTile& tile) {
  Packer packer;
  packer.bytes.reserve(tile.bytes());
  tileFields(packer, const_cast<DeepTile&>(tile));  // packing changes nothing
  return std::move(packer.bytes);
}

std::optional<DeepTile> unpackTile(BytesView bytes) {
  Unpacker unpacker{bytes};
  DeepTile tile;
  tileFields(unpacker, tile);
  if (unpacker.damaged || !unpacker.bytes.empty() || !consistent(tile)) return std::nullopt;
  return tile;
}

uint64_t tileSchema() {
  SchemaSum schema;
  DeepTile tile;
  ShadePoints points(0, 0);
  tileFields(schema, tile);
  batch(schema, points);
  return schema.sum;
}

}  // namespace tomales
