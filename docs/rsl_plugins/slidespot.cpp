// A spotlight with soft shadows that projects a slide. In RSL:
//
//   light slidespot(float intensity = 1, coneangle = radians(30), conedeltaangle = radians(5), shadowsamples = 16,
//                         samplecone = 0;
//                   color lightcolor = 1; point from = (0, 0, 0), to = (0, 0, 1); vector up = (0, 1, 0);
//                   string slidename = "") {
//     vector A = normalize(to - from);
//     /* The slide is placed in the space of the light. In the space of a camera that mirrors, the cross product
//        would point the other way, and the slide would be mirrored. */
//     vector axis = normalize(vtransform("shader", A)), right = normalize(axis ^ vtransform("shader", up));
//     vector top = right ^ axis;
//     illuminate (from, A, coneangle) {
//       float c = normalize(L) . A, width = tan(coneangle);
//       Cl = intensity * lightcolor * smoothstep(cos(coneangle), cos(coneangle - conedeltaangle), c) / (L . L);
//       if (slidename != "") {
//         vector Ls = vtransform("shader", L);
//         float depth = Ls . axis;
//         float ss = .5 - (Ls . right) / (2 * width * depth), tt = .5 - (Ls . top) / (2 * width * depth);
//         Cl *= color texture(slidename, ss, tt);
//       }
//       Cl *= transmission(Ps, from, "samples", shadowsamples, "samplecone", samplecone);
//     }
//   }
#include <reyes/sl.h>

using namespace sl;

namespace {
rsl::FloatParam intensity("intensity", 1, "scale: the light at distance 1"),
    coneangle("coneangle", 0.523598776f, "half angle of the cone, radians");
rsl::FloatParam conedeltaangle("conedeltaangle", 0.0872664626f, "width of the soft edge inside the cone, radians");
rsl::UniformFloatParam shadowsamples("shadowsamples", 16, "shadow rays a point");
rsl::UniformFloatParam samplecone("samplecone", 0,
                                  "half angle of the lamp as points see it, radians: softness of shadows");
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "colour");
rsl::PointParam from("from", {0, 0, 0}, "position"), to("to", {0, 0, 1}, "a point on the axis");
rsl::VectorParam up("up", {0, 1, 0}, "which way the slide stands");
rsl::StringParam slidename("slidename", "", "picture in the lamp; none: white");

struct slidespot : Light {
  void main() {
    Vector A = normalize(to - from), axis = normalize(vtransform("shader", A)),
           right = normalize(cross(axis, vtransform("shader", up))), top = cross(right, axis);
    illuminate(from, A, coneangle, [&] {
      Float c = dot(normalize(L), A), width = tan(coneangle);
      Cl = intensity * lightcolor * smoothstep(cos(coneangle), cos(coneangle - conedeltaangle), c) / dot(L, L);
      if (slidename != "") {
        Vector Ls = vtransform("shader", L);
        Float depth = dot(Ls, axis);
        Float ss = 0.5 - dot(Ls, right) / (2 * width * depth), tt = 0.5 - dot(Ls, top) / (2 * width * depth);
        Cl *= texture(uniform(slidename), ss, tt);
      }
      Cl *= transmission(Ps, from, "samples", shadowsamples, "samplecone", samplecone);
    });
  }
};
const rsl::Shader shader(TM_LIGHT, "slidespot", "a spotlight with a slide and soft shadows", TM_TRACES,
                         sl::shade<slidespot>,
                         {&intensity, &coneangle, &conedeltaangle, &shadowsamples, &samplecone, &lightcolor, &from, &to,
                          &up, &slidename});
}  // namespace

TM_SHADER_LIBRARY(shader)
