// A ball of milk or smoke: light that was scattered any number of times, from the photons in it. The ray is marched
// from where it enters to where it leaves, through the fluence that `tomales render --gi atlas --atlas maps` leaves of
// what the ball's Interior scatters. In RSL:
//
//   surface milk(color scattering = 1, absorption = 0; float steps = 32, radius = 0;
//                string map = "maps/scene.volume.bkm") {
//     /* The ball has radius 1 around the origin. */
//     vector In = normalize(I), Ib = vtransform("object", In);
//     float chord = -2 * (vector(transform("object", P)) . Ib) / (Ib . Ib);
//     float stepsize = length(vtransform("world", chord * In)) / steps;
//     color extinction = scattering + absorption, clear = 1, Cv = 0;
//     float i;
//     for (i = 0; i < steps; i += 1) {
//       color fluence = 0;
//       texture3d(map, P + (i + .5) / steps * chord * In, normal 0, "fluence", fluence, "filterradius", radius);
//       color depth = extinction * stepsize;
//       color seen = color(exp(-comp(depth, 0)), exp(-comp(depth, 1)), exp(-comp(depth, 2)));
//       /* Light is scattered evenly in all directions. */
//       Cv += clear * (1 - seen) * scattering / extinction * fluence / (4 * PI);
//       clear *= seen;
//     }
//     Ci = Cv;  Oi = 1 - clear;
//   }
#include <reyes/sl.h>

using namespace sl;

namespace {
rsl::ColorParam scattering("scattering", {1, 1, 1}, "of the Interior, for each unit of the world"),
    absorption("absorption", {0, 0, 0}, "likewise");
rsl::UniformFloatParam steps("steps", 32, "of the march"),
    radius("radius", 0, "of the mean that a step takes of the map: photons are noisy");
rsl::StringParam map("map", "maps/scene.volume.bkm", "brick map of the fluence");

struct milk : Surface {
  void main() {
    const float n = uniform(steps);
    const std::string file = uniform(map);
    Vector In = normalize(I), Ib = vtransform("object", In);
    Float chord = max(0, -2 * dot(Vector(transform("object", P)), Ib) / dot(Ib, Ib));
    Float stepsize = length(vtransform("world", chord * In)) / n;
    Color clear(1), Cv, seen, share;
    for (int c = 0; c < 3; ++c) {
      Float extinction = comp(scattering, c) + comp(absorption, c);
      setcomp(seen, c, exp(-extinction * stepsize));
      setcomp(share, c, comp(scattering, c) / max(extinction, 1e-9) / (4 * rsl::kPi));
    }
    for (int i = 0; i < n; ++i) {
      Color fluence;
      texture3d(file.c_str(), P + ((i + 0.5) / n) * chord * In, Normal(), {{"fluence", fluence}}, "filterradius",
                uniform(radius));
      Cv += clear * (Color(1) - seen) * share * fluence;
      clear *= seen;
    }
    Ci = Cv;
    Oi = Color(1) - clear;
  }
};
const rsl::Shader shader(TM_SURFACE, "milk", "a ball that scatters light any number of times, by a volume photon map",
                         0, sl::shade<milk>, {&scattering, &absorption, &steps, &radius, &map});
}  // namespace

TM_SHADER_LIBRARY(shader)
