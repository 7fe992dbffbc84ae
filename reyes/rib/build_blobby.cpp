// Builds Prims of Blobby requests, and of Points of type "blobby".
#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include "reyes/pictures.h"
#include "reyes/rib/collapsed.h"
#include "reyes/rib/geometry_builders.h"
#include "reyes/rib/handlers.h"

namespace tomales::rib {
namespace {

constexpr int kAdd = 0, kConstant = 1000, kEllipsoid = 1001;

constexpr int kStretches = 4;  ///< Number of parts into which the time between two keys of a Blobby is divided.

bool isOfBlobs(const Request& points) {
  const Param* type = points.name == "Points" ? findParam(points.params, "type") : nullptr;
  return type && !type->strings.empty() && type->strings[0] == "blobby";
}

/// Tells whether the requests differ in numbers alone.
bool differInNumbers(const Request& a, const Request& b) {
  const auto sameArg = [](const RibArg& x, const RibArg& y) {
    return x.integers == y.integers && x.numbers.size() == y.numbers.size();
  };
  const auto sameParam = [](const Param& x, const Param& y) {
    return x.name == y.name && x.floats.size() == y.floats.size();
  };
  return a.name == b.name && std::ranges::equal(a.args, b.args, sameArg) &&
         std::ranges::equal(a.params, b.params, sameParam);
}

RibArg integers(std::vector<int> list) { return {.kind = RibArg::Kind::Integers, .integers = std::move(list)}; }

}  // namespace

// Only the leaf that repels (1003) takes one of the strings.
bool hasGround(const Request& r) { return r.name == "Blobby" && r.args.size() > 3 && !r.args[3].strings.empty(); }

PrimPtr blobby(const Request& r, const Prim* first, const GroundReader& grounds, Problems& problems) {
  const int leaves = r.args[0].integer();
  const std::vector<int>& code = r.args[1].integers;
  const std::vector<float>& floats = r.args[2].numbers;
  return first ? makeBlobbyKey(*first, leaves, code, floats, grounds, r.params, problems)
               : makeBlobby(leaves, code, floats, grounds, r.params, problems);
}

GroundPicture readGround(const std::string& path, const mat4& worldFromObject) {
  std::string error;
  const auto in = openPicture(path, error);
  if (!in) throw PrimError(error);
  const std::optional<DepthCamera> camera = depthCameraOf(*in);
  if (!camera || in->deep()) throw PrimError("it is no picture of depth with the matrices of its camera");
  const PictureShape& shape = in->shape();
  GroundPicture out{shape.width,
                    shape.height,
                    std::vector<float>(static_cast<size_t>(shape.width) * static_cast<size_t>(shape.height)),
                    {},
                    {}};
  if (!in->read(camera->depth, camera->depth + 1, out.depth.data())) throw PrimError(in->error());
  const vec3 half(0.5f * static_cast<float>(shape.fullWidth), -0.5f * static_cast<float>(shape.fullHeight), 1);
  const mat4 texelFromNdc = glm::scale(
      glm::translate(mat4(1.0f), vec3(half.x - static_cast<float>(shape.x), -half.y - static_cast<float>(shape.y), 0)),
      half);
  out.cameraFromObject = camera->cameraFromWorld * worldFromObject;
  out.texelFromObject = texelFromNdc * camera->ndcFromWorld * worldFromObject;
  return out;
}

// A single ellipsoid shows at half its radius, so the radius of each is the width of its point. A point without width
// makes no leaf.
std::optional<Request> blobbyOfPoints(const Request& r) {
  if (!isOfBlobs(r)) return std::nullopt;
  const Param* place = findParam(r.params, "P");
  if (!place) return std::nullopt;
  const Param* width = findParam(r.params, "width");
  if (!width) width = findParam(r.params, "constantwidth");
  const size_t n = place->floats.size() / 3;
  if (width && width->floats.size() != 1 && width->floats.size() != n)
    throw PrimError(fmt::format("{} has {} values for {} points", width->name, width->floats.size(), n));
  std::vector<int> code, sum{kAdd, static_cast<int>(n)};
  std::vector<float> floats;
  for (size_t i = 0; i < n; ++i) {
    const float w = width ? width->floats[width->floats.size() > 1 ? i : 0] : 1;
    const float* p = &place->floats[3 * i];
    if (!(w >= 0)) throw PrimError(fmt::format("{} is {} somewhere", width->name, w));
    code.insert(code.end(), {w > 0 ? kEllipsoid : kConstant, static_cast<int>(floats.size())});
    floats.insert(floats.end(), {w, 0, 0, 0, 0, w, 0, 0, 0, 0, w, 0, p[0], p[1], p[2], 1});
    sum.push_back(static_cast<int>(i));
  }
  code.insert(code.end(), sum.begin(), sum.end());
  Request out{.name = "Blobby",
              .args = {integers({static_cast<int>(n)}), integers(std::move(code))},
              .params = r.params,
              .where = r.where};
  out.args.push_back({.kind = RibArg::Kind::Numbers, .numbers = std::move(floats)});
  std::erase_if(out.params, [](const Param& p) {
    return p.name == "P" || p.name == "type" || p.name == "width" || p.name == "constantwidth";
  });
  return out;
}

void addKeysOfBlobby(std::vector<Request>& keys, std::vector<float>& times) {
  if (keys[0].name != "Blobby" && !isOfBlobs(keys[0])) return;
  std::vector<Request> all;
  std::vector<float> when;
  for (size_t k = 0; k < keys.size(); ++k) {
    for (int i = 1; k > 0 && i < kStretches && differInNumbers(keys[k - 1], keys[k]); ++i) {
      const float share = static_cast<float>(i) / kStretches;
      Request& added = all.emplace_back(between(keys[k - 1], keys[k], share));
      for (size_t p = 0; p < added.params.size(); ++p)
        for (size_t n = 0; n < added.params[p].floats.size(); ++n)
          added.params[p].floats[n] = lerp(keys[k - 1].params[p].floats[n], keys[k].params[p].floats[n], share);
      when.push_back(lerp(times[k - 1], times[k], share));
    }
    all.push_back(keys[k]);
    when.push_back(times[k]);
  }
  keys = std::move(all);
  times = std::move(when);
}

}  // namespace tomales::rib
