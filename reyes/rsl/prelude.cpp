// Built-in functions whose definitions are simplest in RSL. They are inlined like all functions, so they cost no more
// than their text. Names that begin with two underscores are not meant for users.
#include "reyes/rsl/checker.h"
#include "reyes/rsl/parse.h"

namespace tomales::compiler {
namespace {

constexpr const char* kText = R"RSL(
float radians(float degrees) { return degrees * (PI / 180); }
float degrees(float radians) { return radians * (180 / PI); }
float log(float x, base) { return log(x) / log(base); }
float distance(point a, b) { return length(a - b); }
float depth(point p) { return (zcomp(p) - __near) / (__far - __near); }

/* The width that a value covers across one micropolygon. */
float __width(float x) { return abs(__stepu(x)) + abs(__stepv(x)); }
float filterstep(float edge, x) { return __boxstep(edge, x, __width(x)); }
float filterstep(float edge, x1, x2) { return __boxstep(edge, 0.5 * (x1 + x2), abs(x2 - x1)); }
float filterstep(float edge, x; string name; float value) {
  return __boxstep(edge, x, name == "width" ? value * __width(x) : __width(x));
}
float filterstep(float edge, x; string name, value) { return filterstep(edge, x); }
float filterstep(float edge, x1, x2; string name; float value) {
  return __boxstep(edge, 0.5 * (x1 + x2), name == "width" ? value * abs(x2 - x1) : abs(x2 - x1));
}
float filterstep(float edge, x1, x2; string name, value) { return filterstep(edge, x1, x2); }
float filterstep(float edge, x; string name1, value1, name2; float value2) { return filterstep(edge, x, name2, value2); }
float filterstep(float edge, x; string name1; float value1; string name2, value2) {
  return filterstep(edge, x, name1, value1);
}

/* The area of a micropolygon whose points were at p. */
float area(point p) { return length(__stepu(p) ^ __stepv(p)); }
float area(point p; string strategy) { return area(p); }
/* A direction along which `by` does not change tells nothing. */
float Deriv(float x, by) {
  float a = Du(by), b = Dv(by);
  return (a == 0 ? 0 : Du(x) / a) + (b == 0 ? 0 : Dv(x) / b);
}
color Deriv(color x; float by) {
  float a = Du(by), b = Dv(by);
  return (a == 0 ? color 0 : Du(x) / a) + (b == 0 ? color 0 : Dv(x) / b);
}
vector Deriv(point x; float by) {
  float a = Du(by), b = Dv(by);
  return (a == 0 ? vector 0 : Du(x) / a) + (b == 0 ? vector 0 : Dv(x) / b);
}

vector faceforward(vector n, i) { return faceforward(n, i, Ng); }
void fresnel(vector i, n; float eta; output float Kr, Kt) {
  Kr = __reflected(i, n, eta);
  Kt = 1 - Kr;
}
void fresnel(vector i, n; float eta; output float Kr, Kt; output vector r, t) {
  fresnel(i, n, eta, Kr, Kt);
  r = reflect(i, n);
  t = refract(i, n, eta);
}

float specularbrdf(vector l; normal n; vector v; float roughness) {
  return pow(max(0, normalize(n) . normalize(normalize(l) + normalize(v))), __specularscale() / roughness);
}
color phong(normal n; vector v; float size) {
  color sum = 0;
  float wanted = 1;
  rayinfo("highlights", wanted);
  if (wanted != 0) {
    normal unit = normalize(n);
    vector r = reflect(-normalize(v), unit);
    illuminance (P, unit, PI / 2) {
      float left = 0;
      lightsource("__nonspecular", left);
      if (left == 0) sum += Cl * pow(max(0, r . normalize(L)), size);
    }
  }
  return sum;
}

float raydepth() { float d = 0; rayinfo("depth", d); return d; }
float raylevel() { return raydepth(); }
float isshadowray() { string kind = ""; rayinfo("type", kind); return kind == "transmission"; }
float isindirectray() { string kind = ""; rayinfo("type", kind); return kind == "diffuse"; }

/* Rays of the Blue Moon Rendering Tools. What is not hit lies at 1e30. */
float fulltrace(point from; vector dir; output color seen; output float dist; output point phit; output vector nhit;
                output point pmiss; output vector rmiss) {
  color c = 0;
  float far = 1e30;
  point p = phit;
  normal n = nhit;
  gather("illuminance", from, dir, 0, 1, "surface:Ci", c, "ray:length", far, "primitive:P", p, "primitive:N", n) {
    phit = p;
    nhit = n;
  } else {
    c = 0;
    far = 1e30;
  }
  seen = c;
  dist = far;
  pmiss = from;
  rmiss = dir;
  return far;
}
float rayhittest(point from; vector dir; output point phit; output vector nhit) {
  color seen;
  float dist;
  point pmiss;
  vector rmiss;
  return fulltrace(from, dir, seen, dist, phit, nhit, pmiss, rmiss);
}
/* The same in world space: headers of "Advanced RenderMan" make these of the calls above. */
color rayserver(point from; vector dir) {
  return trace(transform("world", "current", from), vtransform("world", "current", dir));
}
color rayserver(point from, to) {
  return visibility(transform("world", "current", from), transform("world", "current", to));
}
float rayserver(point from; vector dir; output point phit; output vector nhit) {
  return rayhittest(transform("world", "current", from), vtransform("world", "current", dir), phit, nhit);
}
float rayserver(point from; vector dir; output color seen; output float dist; output point phit; output vector nhit;
                output point pmiss; output vector rmiss) {
  return fulltrace(transform("world", "current", from), vtransform("world", "current", dir), seen, dist, phit, nhit,
                   pmiss, rmiss);
}

/* Outputs that nobody wants cost nothing here. */
float isoutput(string name) { return 1; }
)RSL";

Checked readPrelude() {
  Sources sources;
  Messages messages;
  File file = parse(preprocessText("prelude", kText, {}, sources, messages), messages);
  Checked out{std::move(file), {}};
  Checker(out, nullptr, nullptr, messages).file(out.file);
  return out;
}

}  // namespace

const Checked& prelude() {
  static const Checked text = readPrelude();
  return text;
}

}  // namespace tomales::compiler
