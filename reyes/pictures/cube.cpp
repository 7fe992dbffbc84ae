// Makes one latitude-longitude picture of six views along the axes.
#include "reyes/base/math.h"
#include "reyes/pictures/convert.h"

namespace tomales {
namespace {

/// The orientation of a face's picture in space: RISpec's cross of a left-handed world, +y up, +x right of +z.
struct Face {
  vec3 forward, right, down;
};
const Face kFaces[6] = {{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                        {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},   {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                        {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}};

int faceOf(const vec3& d) {
  const vec3 a = glm::abs(d);
  if (a.x >= a.y && a.x >= a.z) return d.x > 0 ? 0 : 1;
  if (a.y >= a.z) return d.y > 0 ? 2 : 3;
  return d.z > 0 ? 4 : 5;
}

}  // namespace

std::optional<OIIO::ImageBuf> unfoldCube(const TextureRecipe& recipe, std::string& error) {
  std::vector<OIIO::ImageBuf> faces(6);
  int edge = 0, channels = 0;
  for (size_t k = 0; k < 6; ++k) {
    if (!readWhole(recipe.pictures[k], faces[k], error)) {
      error = "\"" + recipe.pictures[k] + "\": " + error;
      return std::nullopt;
    }
    edge = std::max(edge, faces[k].spec().width);
    channels = k == 0 ? faces[k].nchannels() : std::min(channels, faces[k].nchannels());
  }
  // Each face gets a quarter of the equator.
  const int width = 4 * edge, height = 2 * edge;
  OIIO::ImageBuf out(OIIO::ImageSpec(width, height, channels, OIIO::TypeDesc::FLOAT));
  const float perSlope = 1 / std::tan(recipe.fov_degrees * kPi / 360);
  std::vector<float> texel(static_cast<size_t>(channels)), sum(texel.size());
  constexpr int kSide = 2;  // samples along a side of a texel
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::fill(sum.begin(), sum.end(), 0.0f);
      for (int k = 0; k < kSide * kSide; ++k) {
        const float px = static_cast<float>(x) + (static_cast<float>(k % kSide) + 0.5f) / kSide;
        const float py = static_cast<float>(y) + (static_cast<float>(k / kSide) + 0.5f) / kSide;
        const float phi = 2 * kPi * px / static_cast<float>(width), theta = kPi * py / static_cast<float>(height);
        const vec3 d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
        const int f = faceOf(d);
        const Face& face = kFaces[f];
        const OIIO::ImageBuf& picture = faces[static_cast<size_t>(f)];
        const vec2 slope = vec2(dot(d, face.right), dot(d, face.down)) * (perSlope / dot(d, face.forward));
        const vec2 at = (0.5f * slope + 0.5f) * vec2(picture.spec().width, picture.spec().height);
        picture.interppixel(at.x + static_cast<float>(picture.xbegin()), at.y + static_cast<float>(picture.ybegin()),
                            texel.data(), OIIO::ImageBuf::WrapClamp);
        for (size_t c = 0; c < sum.size(); ++c) sum[c] += texel[c] / (kSide * kSide);
      }
      out.setpixel(x, y, sum.data());
    }
  return out;
}

}  // namespace tomales
