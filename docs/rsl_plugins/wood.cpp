// Layered procedural wood. The RSL that it translates, line by line:
//
//   surface wood(float Kd = .7, Ks = .25, roughness = .12, ringscale = 12, grainscale = 60;
//                color lightwood = (.69, .44, .25), darkwood = (.35, .18, .08), shine = 1) {
//     point Q = transform("shader", P);
//     Q += .08 * (vector noise(4 * Q) - .5);                        /* the trunk is not straight */
//     float r = ringscale * sqrt(xcomp(Q) * xcomp(Q) + ycomp(Q) * ycomp(Q));
//     r += .3 * noise(r);                                           /* nor are all years alike */
//     float ring = mod(r, 1), late = smoothstep(.5, .9, ring) * (1 - smoothstep(.95, 1, ring));
//     float grain = filterstep(.6, noise(grainscale * point(xcomp(Q), ycomp(Q), .1 * zcomp(Q))), .3);
//     color base = mix(lightwood, darkwood, clamp(late + .25 * grain, 0, 1));
//     normal Nf = faceforward(normalize(N), I);
//     Oi = Os;
//     Ci = Os * (base * (ambient() + Kd * diffuse(Nf)) +
//                (1 - .5 * grain) * Ks * shine * specular(Nf, -normalize(I), roughness));
//   }
#include <reyes/sl.h>

using namespace sl;

namespace {
rsl::FloatParam Kd("Kd", 0.7f, "weight of diffuse light"), Ks("Ks", 0.25f, "weight of highlights"),
    roughness("roughness", 0.12f, "width of highlights");
rsl::FloatParam ringscale("ringscale", 12, "rings for each unit"),
    grainscale("grainscale", 60, "fineness of the pores");
rsl::ColorParam lightwood("lightwood", {0.69f, 0.44f, 0.25f}, "early wood"),
    darkwood("darkwood", {0.35f, 0.18f, 0.08f}, "late wood");
rsl::ColorParam shine("shine", {1, 1, 1}, "colour of highlights");

struct wood : Surface {
  void main() {
    Point Q = transform("shader", P);
    Q += 0.08 * (noise3(4 * Q) - 0.5);
    Float r = ringscale * sqrt(xcomp(Q) * xcomp(Q) + ycomp(Q) * ycomp(Q));
    r += 0.3 * noise(r);
    Float ring = mod(r, 1), late = smoothstep(0.5, 0.9, ring) * (1 - smoothstep(0.95, 1, ring));
    Float grain = filterstep(0.6, noise(grainscale * Point(xcomp(Q), ycomp(Q), 0.1 * zcomp(Q))), 0.3);
    Color base = mix(lightwood, darkwood, clamp(late + 0.25 * grain, 0, 1));
    Normal Nf = faceforward(normalize(N), I);
    Oi = Os;
    Ci = Os * (base * (ambient() + Kd * diffuse(Nf)) +
               (1 - 0.5 * grain) * Ks * shine * specular(Nf, -normalize(I), roughness));
  }
};
const rsl::Shader shader(TM_SURFACE, "wood", "rings and pores of a trunk along z of shader space", TM_KEEPS_OPACITY,
                         sl::shade<wood>,
                         {&Kd, &Ks, &roughness, &ringscale, &grainscale, &lightwood, &darkwood, &shine});
}  // namespace

TM_SHADER_LIBRARY(shader)
