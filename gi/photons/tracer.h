// Private to gi: photons on their way through the scene, from a light until they are absorbed or reach the greatest
// depth. Space: current. Power: W. The photons are the same for any number of threads. Threads: const members may be
// called concurrently.
#pragma once
#include "gi/photons/emission.h"
#include "gi/photons/medium.h"
#include "gi/photons/surfaces.h"

namespace tomales {

/// Tells whether a light is switched on for the objects of a group.
bool isOnFor(const ShadeGroup& group, int light);

class PhotonTracer {
 public:
  PhotonTracer(const Scene& scene, const RayScene& rays, const ShadingSystem& shading, const PhotonSettings& settings,
               Log& log);

  /// Traces photons `first` .. first + count - 1 of a source, each with this share of its power; stored photons are
  /// added to `out`. Other seeds give independent photons.
  void trace(const PhotonSource& source, uint32_t seed, uint32_t first, size_t count, float share,
             std::vector<StoredPhoton>& out) const;

 private:
  struct Path {
    Ray ray;
    vec3 power;
    uint32_t number;
    int light;
    int depth = 0;
    uint32_t surfacesPassed = 0;  ///< Surfaces that it has passed as if they were not there.
    uint32_t collisions = 0;      ///< Collisions with media.
    int bounces = 0;              ///< The same as StoredPhoton::bounces.
    bool specularFirst = false;   ///< The same as StoredPhoton::specularFirst.
    bool specular = true;         ///< It has met no diffuse surface so far.
    vec3 lift{0.0f};              ///< Offset from the origin to just before the polygon that it leaves.
    /// RayScene::groupsBesideLamp() until its first hit, if its lamp lets it pass; else null.
    const std::vector<uint8_t>* besideLamp = nullptr;
  };
  using Answer = PhotonSurfaces::Answer;
  struct Draw {
    const vec3& direction;  ///< Direction of a cosine-weighted hemisphere around +z.
    float survival;
  };
  struct Scratch {
    std::vector<uint32_t> flying;        ///< Indices of the paths that still fly.
    std::vector<Hit> hits;               ///< The hit of each flying path.
    std::vector<const Answer*> answers;  ///< The answer of the surface at each hit.
    std::vector<Answer> found;           ///< Answers of surfaces that differ from place to place.
    std::vector<uint8_t> scattered;      ///< The photon was scattered before it reached the surface.
    std::vector<uint32_t> number, name;
    std::vector<vec2> xi;
    std::vector<vec3> direction;  ///< Random direction in which each path goes on.
    std::vector<float> survival;  ///< Random number that decides whether it goes on.
  };
  struct Media {
    Medium inside, outside;
  };

  void advance(std::vector<Path>& paths, uint32_t stream, Scratch& s, std::vector<StoredPhoton>& out) const;
  void fly(std::vector<Path>& paths, Scratch& s) const;
  Hit firstHit(Path& path) const;
  static vec3 liftOf(const Ray& ray, const vec3& normal);
  void draw(const std::vector<Path>& paths, uint32_t stream, Scratch& s) const;
  void crossMedia(std::vector<Path>& paths, uint32_t stream, Scratch& s, std::vector<StoredPhoton>& out) const;
  bool collideWith(Path& path, const Medium& medium, bool isLit, float flight, uint32_t name,
                   std::vector<StoredPhoton>& out) const;
  void ask(const std::vector<Path>& paths, uint32_t stream, Scratch& s) const;
  bool landsOn(const Path& path, int group) const;
  bool interact(Path& path, const Hit& hit, const Answer& answer, const Draw& xi, uint32_t stream,
                std::vector<StoredPhoton>& out) const;
  bool passThrough(Path& path, const Hit& hit, const vec3& transmitted, float xi) const;
  bool scatter(Path& path, const Hit& hit, const vec3& reflected, const Draw& xi, uint32_t side) const;
  bool reflectOrRefract(Path& path, const Hit& hit, float survival, float xi) const;
  void leave(Path& path, const Hit& hit, const vec3& direction) const;
  bool countScattering(Path& path) const;
  static bool survive(Path& path, const vec3& left, float xi);
  static uint32_t keyOf(const Path& path, uint32_t stream);
  float timeOf(uint32_t number, uint32_t stream) const;
  int groupOf(const Hit& hit) const { return groups_[static_cast<size_t>(hit.object)]; }

  const Scene& scene_;
  const RayScene& rays_;
  const PhotonSurfaces surfaces_;
  const PhotonSettings& settings_;
  const float worldUnit_;     ///< Length of one unit of the world.
  std::vector<int> groups_;   ///< Shade group of each object.
  std::vector<Media> media_;  ///< Media on both sides of the surfaces of each group.
  bool anyMedium_ = false;
  bool samplesTime_ = false;  ///< Something moves, and some object wants its motion seen.
};

}  // namespace tomales
