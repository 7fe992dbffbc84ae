// Textures and environments (RISpec 15.7).
#include "reyes/rsl/machine/lists.h"

namespace tomales::compiler {
namespace {

/// Returns the arrays for one channel or three, as the result's shape is.
TmVec3 channels(Call& call) {
  if (call.run.reg(call.of.out[0]).shape == Shape::Number) return {call.giveNumber(), nullptr, nullptr};
  return call.giveTriple();
}

int32_t firstChannel(Call& call) { return call.has(1) ? call.whole(1, "channels") : 0; }

void texture(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  TmTextureOptions options = listed(call, tmTextureDefaults());
  options.channel = firstChannel(call);
  for (size_t k = 0; k < 4; ++k)
    if (call.has(4 + k)) options.region[k] = call.number(4 + k);
  call.services.texture(call.host, call.g, call.text(0), &options, call.number(2), call.number(3), channels(call));
}

void environment(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  TmTextureOptions options = listed(call, tmTextureDefaults());
  options.channel = firstChannel(call);
  if (call.has(3)) options.angle = call.number(3);
  call.services.environment(call.host, call.g, call.text(0), &options, call.triple(2), channels(call));
}

void textureInfo(Run& run, const PreparedInstruction& s) {
  Call call(run, s);
  int32_t type = 0;
  TmValue v{};
  const bool told = call.services.textureInfo(call.host, call.g, call.text(0), call.text(1), &type, &v) != 0;
  call.set(told && fill(run, s.of->settings.at(0).value, type, v) ? 1.0f : 0.0f);
}

constexpr Row kPictureRows[] = {{Op::TextureF, texture},
                                {Op::TextureT, texture},
                                {Op::EnvironmentF, environment},
                                {Op::EnvironmentT, environment},
                                {Op::TextureInfo, textureInfo}};

}  // namespace

std::span<const Row> pictureRows() { return kPictureRows; }

}  // namespace tomales::compiler
