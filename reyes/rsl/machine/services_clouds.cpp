// Point clouds, brick maps and photons: bake3d(), texture3d(), photonmap() and their kin, which PRMan added to RSL.
#include "reyes/rsl/machine/lists.h"

namespace tomales::compiler {
namespace {

/// Returns the options, with a radius for all points as an array.
TmCloudOptions optionsOf(Call& call, const rsl::CloudList& list) {
  TmCloudOptions options = list.cloud;
  if (!list.hasRadius) return options;
  float* const radius = call.run.memory.floats(static_cast<size_t>(call.run.padded));
  std::fill_n(radius, call.run.padded, list.radius);
  options.radius = radius;
  return options;
}

/// Takes the file, a description of the channels (which follows from their values anyway), P and N; settings are
/// options and values.
void bake3d(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  std::vector<TmChannel> values;
  const rsl::CloudList list =
      listed(call, rsl::CloudList(), [&](const std::string& name, const Setting& entry, const rsl::Setting&) {
        const Shape shape = run.reg(entry.value).shape;
        if (shape != Shape::Number && shape != Shape::Triple) return false;
        // The channel's type has writable arrays, but bake3d() only reads them.
        const TmConstVec3 v = shape == Shape::Triple ? call.tripleOf(entry.value)
                                                     : TmConstVec3{call.numberOf(entry.value), nullptr, nullptr};
        values.push_back({name.c_str(), {const_cast<float*>(v.x), const_cast<float*>(v.y), const_cast<float*>(v.z)}});
        return true;
      });
  const TmCloudOptions options = optionsOf(call, list);
  call.set(
      static_cast<float>(call.services.bake3d(call.host, call.g, call.text(0), &options, call.triple(2), call.triple(3),
                                              values.data(), static_cast<int32_t>(values.size())) != 0));
}

void texture3d(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  std::vector<TmChannel> values;
  const rsl::CloudList list =
      listed(call, rsl::CloudList(), [&](const std::string& name, const Setting&, const rsl::Setting& value) {
        if (value.fills.x) values.push_back({name.c_str(), value.fills});
        return value.fills.x != nullptr;
      });
  const TmCloudOptions options = optionsOf(call, list);
  call.services.texture3d(call.host, call.g, call.text(0), &options, call.triple(1), call.triple(2), values.data(),
                          static_cast<int32_t>(values.size()), call.giveNumber());
}

void photonMap(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const rsl::PhotonList list = listed(call, rsl::PhotonList());
  const TmVec3 out = call.giveTriple();
  if (!list.radiance) {
    call.services.photonMap(call.host, call.g, call.text(0), &list.photons, call.triple(1), call.triple(2), out);
    return;
  }
  const TmCloudOptions options = tmCloudDefaults();
  const TmChannel channel{"_radiosity", out};
  float* const found = run.memory.floats(static_cast<size_t>(run.padded));
  call.services.texture3d(call.host, call.g, call.text(0), &options, call.triple(1), call.triple(2), &channel, 1,
                          found);
}

/// Gives E/pi from the photon map of Attribute "photon" "causticmap"; black if there is none.
void caustic(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const TmVec3 out = call.giveTriple();
  for (float* const c : {out.x, out.y, out.z}) fillWhere(run.padded, run.mask->on, 0, c);
  int32_t type = 0;
  TmValue v{};
  if (!call.services.ask(call.host, call.g, TM_OF_ATTRIBUTES, -1, "photon:causticmap", &type, &v) ||
      type != TM_STRING || !*v.string)
    return;
  const TmPhotonOptions options = tmPhotonDefaults();
  call.services.photonMap(call.host, call.g, v.string, &options, call.triple(0), call.triple(1), out);
}

/// Takes the file, P and N. The approximation ignores N.
void subsurface(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  const TmSubsurfaceOptions options = listed(call, tmSubsurfaceDefaults());
  call.services.subsurface(call.host, call.g, call.text(0), &options, call.triple(1), call.giveTriple());
}

constexpr Row kCloudRows[] = {{Op::Bake3d, bake3d},
                              {Op::Texture3d, texture3d},
                              {Op::PhotonMap, photonMap},
                              {Op::Caustic, caustic},
                              {Op::Subsurface, subsurface}};

}  // namespace

std::span<const Row> cloudRows() { return kCloudRows; }

}  // namespace tomales::compiler
