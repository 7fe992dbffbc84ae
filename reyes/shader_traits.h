// What the renderer knows of the bound shaders of a scene without running them. ShadingSystem returns these views; they
// must not outlive it. Threads: any.
#pragma once
#include <span>

#include "reyes/shade_services.h"

namespace tomales {

struct BoundGroup;
struct BoundLight;
struct BoundScene;

/// The shaders of a shade group.
class GroupTraits {
 public:
  GroupTraits(const BoundScene& scene, const BoundGroup& group) : scene_(scene), group_(group) {}

  /// Tells whether it hides what is behind it (Os = 1 everywhere and a shader that keeps opacity).
  bool opaque() const;
  /// Tells whether a shader asks how values change over the surface (ShadePoints::hasSteps).
  bool wantsSteps() const;
  /// Tells whether its surface shader leaves Oi = Os.
  bool keepsOpacity() const;
  /// Tells whether its surface shader traces rays for anything besides occlusion() and highlights.
  bool tracesRays() const;
  /// Tells whether a shader may call occlusion() or indirectdiffuse() so that answers may be interpolated.
  bool asksHemispheres() const;
  /// Returns the indirect light that is switched on, if any: the gather pass must prepare it.
  const IndirectQuery* indirectQuery() const;
  /// Tells whether its surface adds radiance of its own.
  bool emits() const;
  /// Tells whether its surface reflects the same share of Illumination::Unit everywhere (TM_EVEN, and no primitive
  /// variable makes it differ).
  bool reflectsEvenly() const;
  /// Tells whether a volume shader stands inside (Interior) or outside (Exterior) of its surfaces.
  bool hasVolume(bool inside) const;
  /// Returns the medium that photons meet inside or outside of its surfaces, as that shader says.
  MediumColors medium(bool inside) const;

 private:
  const BoundScene& scene_;
  const BoundGroup& group_;
};

/// The kind of a light, as far as the renderer can tell without running its shader.
enum class LightKind { None, Ambient, Point, Distant, Sky, Area, Indirect };

/// Cells of the brightness of a sky's picture, from pole to pole and around: a cell is a third of a degree high, and
/// the sun half a degree wide.
constexpr int kSkyRows = 512, kSkyColumns = 1024;

/// An opening through which a sky lights a room, in current space.
struct Portal {
  vec3 corner, u, v;  ///< u and v are edges.
  vec3 normal;        ///< Its length is the portal's area.
};

/// The shader of a light.
class LightTraits {
 public:
  /// Null: its shader is missing.
  explicit LightTraits(const BoundLight* light) : light_(light) {}

  /// Returns LightKind::None if its shader is missing, or if it lights nothing diffuse that gather rays see.
  LightKind kind() const;
  /// Tells whether an area light shines from both sides of its geometry.
  bool shinesAllRound() const;
  /// Returns null if it is missing.
  const TmShader* shader() const;
  /// Returns the product of the light's parameters that are factors (isFactor()), as if its request gave `params`.
  vec3 factor(const std::vector<Param>& params) const;
  /// Returns its LightGroup; empty if its shader is missing or it is an indirect light.
  std::string group() const;
  /// Tells whether it is a sky that uses the openings which the program finds by itself.
  bool takesFoundPortals() const;
  /// Returns the portals of a light of LightKind::Sky: those that it names and that have a place and an area, or those
  /// that were found for it.
  std::span<const Portal> portals() const;

 private:
  const BoundLight* light_;
};

}  // namespace tomales
