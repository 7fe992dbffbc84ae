// What shaders ask of point clouds, of a fake that remembers it.
#pragma once
#include "reyes/cloud_services.h"
#include "reyes/sl.h"
#include "tests/unit/shade/neighbours.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

/// Remembers what it is given, and knows of one file.
class FakeClouds : public CloudServices {
 public:
  struct Baked {
    vec3 P, N;
    float radius, value;
  };
  std::vector<Baked> baked;
  float shareOfLarge = 0;  ///< What occlusion() says of the disks.
  float radiusAsked = -1;  ///< That of the last point of occlusion().

  bool bake(const CloudQuery& q, const std::vector<CloudValue>& values, std::string& problem) override {
    if (q.file == "full.ptc") {
      problem = "the disk is full";
      return false;
    }
    if (q.file == "absent.ptc") {
      problem = "cannot be there";
      return false;
    }
    for (int i = 0; i < q.count; ++i)
      if (q.active[i]) baked.push_back({at(q.P, i), at(q.N, i), q.radius[i], values.at(0).c[0][i]});
    return true;
  }
  bool lookUp(const CloudQuery& q, const std::vector<CloudValue>& values, float* found, std::string& problem) override {
    if (q.file != "known.ptc") {
      problem = "is not there";
      return false;
    }
    for (int i = 0; i < q.count; ++i) {
      if (!q.active[i]) continue;
      found[i] = q.P.x[i] > 0.5f ? 1 : 0;
      if (found[i] != 0) values.at(0).c[0][i] = q.P.x[i];
    }
    return true;
  }
  bool photons(const CloudQuery& q, const TmPhotonOptions& lookup, TmVec3 E, std::string& problem) override {
    if (q.file == "absent.ptc") {
      problem = "is not there";
      return false;
    }
    for (int i = 0; i < q.count; ++i)
      if (q.active[i]) {
        E.x[i] = static_cast<float>(lookup.estimator);
        E.y[i] = q.N.z[i];
        E.z[i] = lookup.maxDistance;
      }
    return true;
  }
  /// Tells what it was asked.
  bool occlusion(const CloudQuery& q, const DisksQuery& d, float* covered, TmVec3 radiance, float* coarse,
                 std::string& problem) override {
    if (q.file != "known.ptc") {
      problem = "is not there";
      return false;
    }
    for (int i = 0; i < q.count; ++i) {
      if (!q.active[i]) continue;
      covered[i] = d.clamp ? 0.25f : 0.5f;
      coarse[i] = shareOfLarge;
      radiusAsked = q.radius[i];
      if (d.falloff.maxDistance < 1e30f)
        covered[i] = 100 * d.falloff.maxDistance + 10 * d.falloff.bias + d.falloff.falloff;
      if (radiance.x) {
        radiance.x[i] = d.maxSolidAngle;
        radiance.y[i] = q.P.x[i];
        radiance.z[i] = d.channel == "_radiosity" ? 1.0f : 2.0f;
      }
    }
    return true;
  }

  /// Tells what it was asked.
  bool subsurface(const CloudQuery& q, const TmSubsurfaceOptions& s, TmVec3 out, std::string& problem) override {
    if (q.file != "known.ptc") {
      problem = "is not there";
      return false;
    }
    for (int i = 0; i < q.count; ++i)
      if (q.active[i]) {
        out.x[i] = q.P.x[i];
        out.y[i] = s.unitLength * s.ior;
        out.z[i] = s.material ? 0 : s.scattering[1] + s.absorption[2] + s.albedo[1] * s.meanFreePath[2];
      }
    return true;
  }

 private:
  static vec3 at(TmConstVec3 v, int i) { return {v.x[i], v.y[i], v.z[i]}; }
};

rsl::StringParam file("file", "left.ptc", "");
rsl::StringParam space("space", "world", "");
struct baking : sl::Surface {
  void main() {
    TmCloudOptions object = tmCloudDefaults();
    object.coordSystem = "object";
    sl::If(u < 0.5, [&] { sl::bake3d(file(sl::grid()), P, N, {{"u", u}}, object); });
    Ci = sl::diffuse(N);
    Oi = sl::Color(1.0);
  }
};
struct finding : sl::Surface {
  void main() {
    sl::Float x = -1, found = -1;
    sl::If(u < 0.7, [&] {
      found = sl::texture3d(file(sl::grid()), P, N, {{"x", x}}, "coordsystem", space(sl::grid()));
    });
    Ci = sl::Color(x, found, 0) + sl::photonmap("photons.ptc", P, N, 7) * sl::Color(0, 0, 1);
    Oi = sl::Color(1.0);
    sl::setzcomp(Ci, sl::xcomp(sl::photonmap("photons.ptc", P, N, 7)));
  }
};
struct wax : sl::Surface {
  void main() {
    Ci = sl::Color(-1.0);
    Oi = sl::Color(1.0);
    sl::If(u < 0.7, [&] {
      Ci = sl::subsurface(P, N, file(sl::grid()), "coordsystem", "object", "scattering", rsl::Color{1, 2, 3},
                          "absorption", rsl::Color{4, 5, 6}, "ior", 1.5, "unitlength", 10);
    });
  }
};
struct causticlight : sl::Surface {
  void main() {
    Ci = sl::caustic(P, N);
    Oi = sl::Color(1.0);
  }
};
struct pointbased : sl::Surface {
  void main() {
    Ci = sl::Color(-1.0);
    Oi = sl::Color(1.0);
    sl::If(u < 0.7, [&] {
      const sl::Float covered = sl::occlusion(P, N, 0, "pointbased", 1, "filename", file(sl::grid()), "clamp", 0);
      Ci = sl::indirectdiffuse(P, N, 0, "filename", file(sl::grid()), "pointbased", 1, "maxsolidangle", 0.125,
                               "channel", "_light");
      Ci += sl::Color(covered, 0, 0);
    });
  }
};
/// Lists of texture3d(), bake3d() and photonmap().
struct listing : sl::Surface {
  void main() {
    sl::Float x = 0;
    sl::bake3d("left.ptc", P, N, {{"u", u}}, "coordsystem", "object", "radius", 0.5, "radiusscale", 3);
    const sl::Float found =
        sl::texture3d("known.ptc", P, N, {{"x", x}}, "coordsystem", "object", "filterradius", &radius);
    Ci = sl::photonmap("photons.ptc", P, N, "estimator", 9, "maxdist", 2.5);
    sl::setycomp(Ci, x + 10 * found);
    Oi = sl::Color(1.0);
  }
  sl::Float radius = 1;
};
struct distant : sl::Surface {
  void main() {
    Ci = sl::Color(sl::occlusion(P, N, 0, "pointbased", 1, "filename", "known.ptc", "maxdist", 8, "bias", 0.5,
                                 "falloff", 3, "distribution", "uniform"));
    Oi = sl::Color(1.0);
  }
};
/// What each call answers about its file.
std::string cloudFile;
std::vector<int32_t> answers;
void answering(const TmGrid* g) {
  const TmConstVec3 P = rsl::view(g->P), N = rsl::view(g->N);
  const char* const name = cloudFile.c_str();
  rsl::Array found(g), x(g);
  rsl::Vec3Array light(g);
  const TmChannel value{"x", {x.data(), nullptr, nullptr}};
  TmOcclusion disks = tmOcclusionDefaults();
  disks.pointCloud = name;
  answers = {g->call->texture3d(g->host, g, name, nullptr, P, N, &value, 1, found.data()),
             g->call->photonMap(g->host, g, name, nullptr, P, N, light),
             g->call->subsurface(g->host, g, name, nullptr, P, light),
             g->call->occlusion(g->host, g, nullptr, P, N, &disks),
             g->call->bake3d(g->host, g, name, nullptr, P, N, &value, 1)};
}
/// Looks clouds up where all points find something.
void copying(const TmGrid* g) {
  const TmConstVec3 P = rsl::view(g->P), N = rsl::view(g->N);
  Answer found(g), value(g), E(g), diffused(g);
  const TmChannel channel{"x", {value.x.data(), nullptr, nullptr}};
  EXPECT_TRUE(g->call->texture3d(g->host, g, "known.ptc", nullptr, P, N, &channel, 1, found.x.data()));
  EXPECT_TRUE(g->call->photonMap(g->host, g, "known.ptc", nullptr, P, N, E.array()));
  EXPECT_TRUE(g->call->subsurface(g->host, g, "known.ptc", nullptr, P, diffused.array()));
  expectCopies(g, found.x.data(), "found");
  expectCopies(g, value.x.data(), "value");
  expectCopies(g, E, "photons");
  expectCopies(g, diffused, "diffused light");
}
const rsl::Shader copyingShader(TM_SURFACE, "copying", "", TM_NEIGHBOURS, copying, {});
const rsl::Shader answeringShader(TM_SURFACE, "answering", "", 0, answering, {});
const rsl::Shader distantShader(TM_SURFACE, "distant", "", 0, sl::shade<distant>, {});
const rsl::Shader listingShader(TM_SURFACE, "listing", "", 0, sl::shade<listing>, {});
const rsl::Shader causticShader(TM_SURFACE, "causticlight", "", 0, sl::shade<causticlight>, {});
const rsl::Shader bakingShader(TM_SURFACE, "baking", "", 0, sl::shade<baking>, {&file});
rsl::StringParam file2("file", "known.ptc", "");
const rsl::Shader neighbourShader(TM_SURFACE, "bakingwide", "", TM_NEIGHBOURS, sl::shade<baking>, {&file2});
rsl::StringParam file4("file", "known.ptc", "");
const rsl::Shader pointbasedShader(TM_SURFACE, "pointbased", "", TM_NEIGHBOURS, sl::shade<pointbased>, {&file4});
const rsl::Shader waxShader(TM_SURFACE, "wax", "", TM_NEIGHBOURS, sl::shade<wax>, {&file4});
const rsl::Shader findingShader(TM_SURFACE, "finding", "", 0, sl::shade<finding>, {&file2, &space});

class CloudCalls : public Stage {
 protected:
  CloudCalls() {
    static const TmShader* const shaders[] = {bakingShader,    neighbourShader,  findingShader, waxShader,
                                              causticShader,   pointbasedShader, listingShader, distantShader,
                                              answeringShader, copyingShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
  }
  ShadePoints row() {
    ShadePoints p = points({vec3(0, 0, 5), vec3(1, 0, 5), vec3(2, 0, 5), vec3(3, 0, 5)});
    for (int i = 0; i < 4; ++i) {
      p.set3(kDpduX, i, {3, 0, 0});
      p.set3(kDpdvX, i, {0, 4, 0});
      p.channel(kDu)[i] = p.channel(kDv)[i] = 2;
    }
    return p;
  }
  FakeClouds clouds;
};

}  // namespace
}  // namespace tomales
