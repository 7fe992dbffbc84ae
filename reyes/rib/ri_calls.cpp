// The functions of reyes/ri.h. They are in one file with recordRiCalls(), so that its users link them for plugins.
#include "reyes/rib/ri_calls.h"

#include <fmt/format.h>

#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <mutex>

#include "reyes/rib/ri_recorder.h"

namespace tomales::rib {
namespace {

/// The tokens and values of a variadic call.
struct Arrays {
  explicit Arrays(std::va_list& list) {
    for (RtToken token = va_arg(list, RtToken); token; token = va_arg(list, RtToken)) {
      tokens.push_back(token);
      values.push_back(va_arg(list, RtPointer));
    }
  }
  RtInt n() const { return static_cast<RtInt>(tokens.size()); }
  std::vector<RtToken> tokens;
  std::vector<RtPointer> values;
};

thread_local Recorder* recorder = nullptr;

/// Returns null, and says so once, if nothing records in this thread.
Recorder* listening() {
  static std::once_flag said;
  if (!recorder)
    std::call_once(said, [] {
      std::fputs("tomales: warning: a plugin calls Ri functions outside of Subdivide, or in another thread; ignored\n",
                 stderr);
    });
  return recorder;
}

void say(const char* name, std::vector<RibArg> args = {}) {
  if (Recorder* r = listening()) r->say(name, std::move(args));
}

void say(const char* name, std::vector<RibArg> args, RI_ARRAYS, const ValueCounts& counts = {},
         const std::string& category = "") {
  if (Recorder* r = listening()) r->say(name, std::move(args), r->params(name, n, tokens, values, counts, category));
}

std::array<int, 2> steps() { return recorder ? recorder->steps() : std::array{3, 3}; }

// Handles are numbers, so that those of another call do no harm.
RtPointer newHandle() {
  static std::atomic<uintptr_t> last{0};
  return reinterpret_cast<RtPointer>(++last);  // NOLINT(performance-no-int-to-ptr)
}
RibArg handle(RtPointer p) { return text(fmt::format("of a plugin: {}", reinterpret_cast<uintptr_t>(p)).c_str()); }

RtLightHandle light(const char* request, RtToken name, RI_ARRAYS) {
  const RtPointer h = newHandle();
  say(request, {text(name), handle(h)}, n, tokens, values);
  return h;
}

}  // namespace

std::recursive_mutex& pluginMutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

void recordRiCalls(RiContext context, Log& log, const std::function<void()>& program, std::vector<RiCall>& calls) {
  Recorder own(std::move(context), log, calls);
  struct Restore {
    Recorder* outer = recorder;
    ~Restore() { recorder = outer; }
  } restore;
  recorder = &own;
  program();
}

}  // namespace tomales::rib

using namespace tomales::rib;

// Defines the variadic form of a function by its V form. `last` precedes the tokens; the rest is all that does.
#define VARIADIC(last, call, ...) \
  std::va_list list;              \
  va_start(list, last);           \
  const Arrays a(list);           \
  va_end(list);                   \
  return call(__VA_ARGS__, a.n(), a.tokens.data(), a.values.data())

// Defines requests of one name and parameters: Ri<Request>(name, ...) and Ri<Request>V.
#define NAMED(request)                                                            \
  RtVoid Ri##request(RtToken name, ...) { VARIADIC(name, Ri##request##V, name); } \
  RtVoid Ri##request##V(RtToken name, RI_ARRAYS) { say(#request, {text(name)}, n, tokens, values); }
#define NAMED_LIGHT(request)                                                             \
  RtLightHandle Ri##request(RtToken name, ...) { VARIADIC(name, Ri##request##V, name); } \
  RtLightHandle Ri##request##V(RtToken name, RI_ARRAYS) { return light(#request, name, n, tokens, values); }
#define PLAIN(request) \
  RtVoid Ri##request(void) { say(#request); }
#define WITH_TEXT(request) \
  RtVoid Ri##request(RtToken name) { say(#request, {text(name)}); }
#define WITH_SWITCH(request, type) \
  RtVoid Ri##request(type on) { say(#request, {number(static_cast<RtFloat>(on))}); }
#define WITH_BOX(request) \
  RtVoid Ri##request(const RtBound bound) { say(#request, {numbers(bound, 6)}); }
#define WITH_MATRIX(request) \
  RtVoid Ri##request(RtMatrix transform) { say(#request, {numbers(&transform[0][0], 16)}); }

extern "C" {

RtBasis RiBezierBasis = {{-1, 3, -3, 1}, {3, -6, 3, 0}, {-3, 3, 0, 0}, {1, 0, 0, 0}};
RtBasis RiBSplineBasis = {{-1.f / 6, 3.f / 6, -3.f / 6, 1.f / 6},
                          {3.f / 6, -1, 3.f / 6, 0},
                          {-3.f / 6, 0, 3.f / 6, 0},
                          {1.f / 6, 4.f / 6, 1.f / 6, 0}};
RtBasis RiCatmullRomBasis = {{-.5f, 1.5f, -1.5f, .5f}, {1, -2.5f, 2, -.5f}, {-.5f, 0, .5f, 0}, {0, 1, 0, 0}};
RtBasis RiHermiteBasis = {{2, 1, -2, 1}, {-3, -2, 3, -1}, {0, 1, 0, 0}, {1, 0, 0, 0}};
RtBasis RiPowerBasis = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

// Blocks and archives
RtToken RiDeclare(RtToken name, RtToken declaration) {
  if (Recorder* r = listening()) r->declare(name, declaration);
  return name;
}
PLAIN(AttributeBegin)
PLAIN(AttributeEnd)
PLAIN(TransformBegin)
PLAIN(TransformEnd)
WITH_TEXT(SolidBegin)
PLAIN(SolidEnd)
RtObjectHandle RiObjectBegin(void) {
  const RtPointer h = newHandle();
  say("ObjectBegin", {handle(h)});
  return h;
}
PLAIN(ObjectEnd)
RtVoid RiObjectInstance(RtObjectHandle h) { say("ObjectInstance", {handle(h)}); }
RtVoid RiMotionBegin(RtInt n, ...) {
  std::vector<float> times;
  times.reserve(count(n));
  std::va_list list;
  va_start(list, n);
  for (RtInt i = 0; i < n; ++i) times.push_back(static_cast<float>(va_arg(list, double)));
  va_end(list);
  RiMotionBeginV(n, times.data());
}
RtVoid RiMotionBeginV(RtInt n, const RtFloat times[]) { say("MotionBegin", {numbers(times, count(n))}); }
PLAIN(MotionEnd)
RtVoid RiReadArchive(RtToken name, void (*callback)(RtToken, char*, ...), ...) {
  VARIADIC(callback, RiReadArchiveV, name, callback);
}
RtVoid RiReadArchiveV(RtToken name, void (*)(RtToken, char*, ...), RI_ARRAYS) {
  say("ReadArchive", {text(name)}, n, tokens, values);
}

// Attributes
RtVoid RiAttribute(RtToken name, ...) { VARIADIC(name, RiAttributeV, name); }
RtVoid RiAttributeV(RtToken name, RI_ARRAYS) {
  say("Attribute", {text(name)}, n, tokens, values, {}, name ? name : "");
}
RtVoid RiColor(const RtFloat c[]) {
  if (Recorder* r = listening()) r->say("Color", {r->color(c)});
}
RtVoid RiOpacity(const RtFloat c[]) {
  if (Recorder* r = listening()) r->say("Opacity", {r->color(c)});
}
RtVoid RiTextureCoordinates(RtFloat s1, RtFloat t1, RtFloat s2, RtFloat t2, RtFloat s3, RtFloat t3, RtFloat s4,
                            RtFloat t4) {
  say("TextureCoordinates", {numbers({s1, t1, s2, t2, s3, t3, s4, t4})});
}
NAMED(Surface)
NAMED(Displacement)
NAMED(Atmosphere)
NAMED(Interior)
NAMED(Exterior)
NAMED_LIGHT(LightSource)
NAMED_LIGHT(AreaLightSource)
RtVoid RiIlluminate(RtLightHandle h, RtBoolean on) { say("Illuminate", {handle(h), number(static_cast<RtFloat>(on))}); }
WITH_SWITCH(ShadingRate, RtFloat)
WITH_TEXT(ShadingInterpolation)
WITH_SWITCH(Matte, RtBoolean)
WITH_BOX(Bound)
WITH_BOX(Detail)
RtVoid RiDetailRange(RtFloat minvisible, RtFloat lower, RtFloat upper, RtFloat maxvisible) {
  say("DetailRange", {numbers({minvisible, lower, upper, maxvisible})});
}
RtVoid RiGeometricApproximation(RtToken type, RtFloat value) {
  say("GeometricApproximation", {text(type), number(value)});
}
WITH_TEXT(Orientation)
PLAIN(ReverseOrientation)
WITH_SWITCH(Sides, RtInt)

// Transformations
PLAIN(Identity)
WITH_MATRIX(Transform)
WITH_MATRIX(ConcatTransform)
RtVoid RiPerspective(RtFloat fov) { say("Perspective", {number(fov)}); }
RtVoid RiTranslate(RtFloat dx, RtFloat dy, RtFloat dz) { say("Translate", {numbers({dx, dy, dz})}); }
RtVoid RiRotate(RtFloat angle, RtFloat dx, RtFloat dy, RtFloat dz) { say("Rotate", {numbers({angle, dx, dy, dz})}); }
RtVoid RiScale(RtFloat sx, RtFloat sy, RtFloat sz) { say("Scale", {numbers({sx, sy, sz})}); }
RtVoid RiSkew(RtFloat angle, RtFloat dx1, RtFloat dy1, RtFloat dz1, RtFloat dx2, RtFloat dy2, RtFloat dz2) {
  say("Skew", {numbers({angle, dx1, dy1, dz1, dx2, dy2, dz2})});
}
WITH_TEXT(CoordinateSystem)
WITH_TEXT(ScopedCoordinateSystem)
WITH_TEXT(CoordSysTransform)

// Polygons
RtVoid RiPolygon(RtInt nvertices, ...) { VARIADIC(nvertices, RiPolygonV, nvertices); }
RtVoid RiPolygonV(RtInt nvertices, RI_ARRAYS) {
  const size_t c = count(nvertices);
  say("Polygon", {}, n, tokens, values, {1, c, c, c});
}
RtVoid RiGeneralPolygon(RtInt nloops, const RtInt nvertices[], ...) {
  VARIADIC(nvertices, RiGeneralPolygonV, nloops, nvertices);
}
RtVoid RiGeneralPolygonV(RtInt nloops, const RtInt nvertices[], RI_ARRAYS) {
  const size_t c = sum(nvertices, nloops);
  say("GeneralPolygon", {integers(nvertices, count(nloops))}, n, tokens, values, {1, c, c, c});
}
RtVoid RiPointsPolygons(RtInt npolys, const RtInt nvertices[], const RtInt vertices[], ...) {
  VARIADIC(vertices, RiPointsPolygonsV, npolys, nvertices, vertices);
}
RtVoid RiPointsPolygonsV(RtInt npolys, const RtInt nvertices[], const RtInt vertices[], RI_ARRAYS) {
  const size_t corners = sum(nvertices, npolys);
  say("PointsPolygons", {integers(nvertices, count(npolys)), integers(vertices, corners)}, n, tokens, values,
      faceCounts(npolys, corners, vertices));
}
RtVoid RiPointsGeneralPolygons(RtInt npolys, const RtInt nloops[], const RtInt nvertices[], const RtInt vertices[],
                               ...) {
  VARIADIC(vertices, RiPointsGeneralPolygonsV, npolys, nloops, nvertices, vertices);
}
RtVoid RiPointsGeneralPolygonsV(RtInt npolys, const RtInt nloops[], const RtInt nvertices[], const RtInt vertices[],
                                RI_ARRAYS) {
  const size_t loops = sum(nloops, npolys), corners = sum(nvertices, static_cast<RtInt>(loops));
  say("PointsGeneralPolygons",
      {integers(nloops, count(npolys)), integers(nvertices, loops), integers(vertices, corners)}, n, tokens, values,
      faceCounts(npolys, corners, vertices));
}

// Patches
RtVoid RiBasis(RtBasis ubasis, RtInt ustep, RtBasis vbasis, RtInt vstep) {
  say("Basis", {numbers(&ubasis[0][0], 16), integer(ustep), numbers(&vbasis[0][0], 16), integer(vstep)});
  if (recorder) recorder->steps() = {ustep, vstep};
}
RtVoid RiPatch(RtToken type, ...) { VARIADIC(type, RiPatchV, type); }
RtVoid RiPatchV(RtToken type, RI_ARRAYS) {
  say("Patch", {text(type)}, n, tokens, values, {1, 4, size_t{isCubic(type) ? 16u : 4u}, 4});
}
RtVoid RiPatchMesh(RtToken type, RtInt nu, RtToken uwrap, RtInt nv, RtToken vwrap, ...) {
  VARIADIC(vwrap, RiPatchMeshV, type, nu, uwrap, nv, vwrap);
}
RtVoid RiPatchMeshV(RtToken type, RtInt nu, RtToken uwrap, RtInt nv, RtToken vwrap, RI_ARRAYS) {
  say("PatchMesh", {text(type), integer(nu), text(uwrap), integer(nv), text(vwrap)}, n, tokens, values,
      meshCounts(type, nu, uwrap, nv, vwrap, steps()));
}
RtVoid RiNuPatch(RtInt nu, RtInt uorder, const RtFloat uknot[], RtFloat umin, RtFloat umax, RtInt nv, RtInt vorder,
                 const RtFloat vknot[], RtFloat vmin, RtFloat vmax, ...) {
  VARIADIC(vmax, RiNuPatchV, nu, uorder, uknot, umin, umax, nv, vorder, vknot, vmin, vmax);
}
RtVoid RiNuPatchV(RtInt nu, RtInt uorder, const RtFloat uknot[], RtFloat umin, RtFloat umax, RtInt nv, RtInt vorder,
                  const RtFloat vknot[], RtFloat vmin, RtFloat vmax, RI_ARRAYS) {
  const size_t u = count(nu - uorder + 1), v = count(nv - vorder + 1), ends = (u + 1) * (v + 1);
  say("NuPatch",
      {integer(nu), integer(uorder), numbers(uknot, count(nu + uorder)), number(umin), number(umax), integer(nv),
       integer(vorder), numbers(vknot, count(nv + vorder)), number(vmin), number(vmax)},
      n, tokens, values, {u * v, ends, count(nu) * count(nv), ends});
}
RtVoid RiTrimCurve(RtInt nloops, const RtInt ncurves[], const RtInt order[], const RtFloat knot[], const RtFloat min[],
                   const RtFloat max[], const RtInt n[], const RtFloat u[], const RtFloat v[], const RtFloat w[]) {
  const size_t curves = sum(ncurves, nloops), points = sum(n, static_cast<RtInt>(curves));
  const size_t knots = points + sum(order, static_cast<RtInt>(curves));
  say("TrimCurve",
      {integers(ncurves, count(nloops)), integers(order, curves), numbers(knot, knots), numbers(min, curves),
       numbers(max, curves), integers(n, curves), numbers(u, points), numbers(v, points), numbers(w, points)});
}
RtVoid RiSubdivisionMesh(RtToken scheme, RtInt nfaces, const RtInt nvertices[], const RtInt vertices[], RtInt ntags,
                         const RtToken tags[], const RtInt nargs[], const RtInt intargs[], const RtFloat floatargs[],
                         ...) {
  VARIADIC(floatargs, RiSubdivisionMeshV, scheme, nfaces, nvertices, vertices, ntags, tags, nargs, intargs, floatargs);
}
RtVoid RiSubdivisionMeshV(RtToken scheme, RtInt nfaces, const RtInt nvertices[], const RtInt vertices[], RtInt ntags,
                          const RtToken tags[], const RtInt nargs[], const RtInt intargs[], const RtFloat floatargs[],
                          RI_ARRAYS) {
  size_t ints = 0, floats = 0;
  for (size_t i = 0; i < count(ntags); ++i) {
    ints += count(nargs[2 * i]);
    floats += count(nargs[2 * i + 1]);
  }
  const size_t corners = sum(nvertices, nfaces);
  say("SubdivisionMesh",
      {text(scheme), integers(nvertices, count(nfaces)), integers(vertices, corners), texts(tags, count(ntags)),
       integers(nargs, 2 * count(ntags)), integers(intargs, ints), numbers(floatargs, floats)},
      n, tokens, values, faceCounts(nfaces, corners, vertices));
}

// Quadrics
#define QUADRIC(request, last, parameters, ...)                                                   \
  RtVoid Ri##request(PARAMETERS parameters, ...) { VARIADIC(last, Ri##request##V, __VA_ARGS__); } \
  RtVoid Ri##request##V(PARAMETERS parameters, RI_ARRAYS) {                                       \
    say(#request, {numbers({__VA_ARGS__})}, n, tokens, values, kQuadric);                         \
  }
#define PARAMETERS(...) __VA_ARGS__
QUADRIC(Sphere, thetamax, (RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax), radius, zmin, zmax, thetamax)
QUADRIC(Cone, thetamax, (RtFloat height, RtFloat radius, RtFloat thetamax), height, radius, thetamax)
QUADRIC(Cylinder, thetamax, (RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax), radius, zmin, zmax,
        thetamax)
QUADRIC(Paraboloid, thetamax, (RtFloat rmax, RtFloat zmin, RtFloat zmax, RtFloat thetamax), rmax, zmin, zmax, thetamax)
QUADRIC(Disk, thetamax, (RtFloat height, RtFloat radius, RtFloat thetamax), height, radius, thetamax)
QUADRIC(Torus, thetamax, (RtFloat major, RtFloat minor, RtFloat phimin, RtFloat phimax, RtFloat thetamax), major, minor,
        phimin, phimax, thetamax)
RtVoid RiHyperboloid(const RtPoint p, const RtPoint q, RtFloat thetamax, ...) {
  VARIADIC(thetamax, RiHyperboloidV, p, q, thetamax);
}
RtVoid RiHyperboloidV(const RtPoint p, const RtPoint q, RtFloat thetamax, RI_ARRAYS) {
  say("Hyperboloid", {numbers({p[0], p[1], p[2], q[0], q[1], q[2], thetamax})}, n, tokens, values, kQuadric);
}

// Points, curves and others
RtVoid RiPoints(RtInt npoints, ...) { VARIADIC(npoints, RiPointsV, npoints); }
RtVoid RiPointsV(RtInt npoints, RI_ARRAYS) {
  const size_t c = count(npoints);
  say("Points", {}, n, tokens, values, {1, c, c, c});
}
RtVoid RiCurves(RtToken type, RtInt ncurves, const RtInt nvertices[], RtToken wrap, ...) {
  VARIADIC(wrap, RiCurvesV, type, ncurves, nvertices, wrap);
}
RtVoid RiCurvesV(RtToken type, RtInt ncurves, const RtInt nvertices[], RtToken wrap, RI_ARRAYS) {
  say("Curves", {text(type), integers(nvertices, count(ncurves)), text(wrap)}, n, tokens, values,
      curveCounts(type, ncurves, nvertices, wrap, steps()[1]));
}
RtVoid RiBlobby(RtInt nleaf, RtInt ncode, const RtInt code[], RtInt nfloats, const RtFloat floats[], RtInt nstrings,
                const RtString strings[], ...) {
  VARIADIC(strings, RiBlobbyV, nleaf, ncode, code, nfloats, floats, nstrings, strings);
}
RtVoid RiBlobbyV(RtInt nleaf, RtInt ncode, const RtInt code[], RtInt nfloats, const RtFloat floats[], RtInt nstrings,
                 const RtString strings[], RI_ARRAYS) {
  const size_t c = count(nleaf);
  say("Blobby",
      {integer(nleaf), integers(code, count(ncode)), numbers(floats, count(nfloats)), texts(strings, count(nstrings))},
      n, tokens, values, {1, c, c, c});
}
NAMED(Geometry)

// Procedurals
RtVoid RiProcDelayedReadArchive(RtPointer, RtFloat) {}
RtVoid RiProcRunProgram(RtPointer, RtFloat) {}
RtVoid RiProcDynamicLoad(RtPointer, RtFloat) {}
RtVoid RiProcedural(RtPointer data, const RtBound bound, RtProcSubdivFunc subdivide, RtProcFreeFunc release) {
  const auto free = [release](RtPointer p) {
    const std::lock_guard lock(pluginMutex());
    if (release) release(p);
  };
  const std::shared_ptr<void> owner(data, free);
  const std::pair<RtProcSubdivFunc, const char*> own[] = {{RiProcDelayedReadArchive, "DelayedReadArchive"},
                                                          {RiProcRunProgram, "RunProgram"},
                                                          {RiProcDynamicLoad, "DynamicLoad"}};
  for (const auto& [function, name] : own)
    if (function == subdivide) {
      const size_t n = function == RiProcDelayedReadArchive ? 1 : 2;
      return say("Procedural", {text(name), texts(static_cast<const RtString*>(data), n), numbers(bound, 6)});
    }
  if (Recorder* r = listening(); r && subdivide) r->procedural({owner, subdivide}, bound);
}

}  // extern "C"
