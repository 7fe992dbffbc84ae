// A principled surface after Burley 2012 (shaders/burley.h), without anisotropy and subsurface. Highlights combine
// samples of the lights and of its own two lobes; reflected rays are drawn from the lobes. Every parameter may be
// multiplied by a picture.
#include <optional>

#include "reyes/shader/shadeops.h"
#include "shaders/burley.h"
#include "shaders/maps.h"
#include "shaders/reflections.h"

namespace {

using burley::Lobes;
using burley::Material;
using rsl::Color;
using rsl::Vec3;

MappedFloat metallic("metallic", 0, "0: dielectric, 1: metal", "metallicmap", "metallicchannel"),
    specular("specular", 0.5f, "reflection at normal incidence; 0.5: index 1.5", "specularmap", "specularchannel"),
    speculartint("speculartint", 0, "tint of the specular reflection towards the base colour", "speculartintmap",
                 "speculartintchannel"),
    roughness("roughness", 0.5f, "roughness of the diffuse and the specular lobe", "roughnessmap", "roughnesschannel"),
    sheen("sheen", 0, "grazing reflection of cloth", "sheenmap", "sheenchannel"),
    sheentint("sheentint", 0.5f, "tint of the sheen towards the base colour", "sheentintmap", "sheentintchannel"),
    clearcoat("clearcoat", 0, "weight of a second specular lobe, that of a coat", "clearcoatmap", "clearcoatchannel"),
    clearcoatgloss("clearcoatgloss", 1, "gloss of the coat, 1: glossy, 0: satin", "clearcoatglossmap",
                   "clearcoatglosschannel");
rsl::UniformFloatParam reflections("reflections", 0,
                                   "rays that mirror the scene, for each point that the camera sees; more if "
                                   "lights have many samples; 0: lights alone");
rsl::ColorParam emission("emission", {0, 0, 0}, "radiance that it adds");
rsl::StringParam texturename("texturename", "", "picture that multiplies Cs, the base colour"),
    emissionmap("emissionmap", "", "picture that multiplies the emission");
rsl::UniformFloatParam linearize("linearize", 0, "1: texturename and emissionmap are sRGB, and are made linear");
NormalMap normalmap;
SecondSet secondSet;
MappedFloat opacity("opacity", 1, "multiplies Os", "opacitymap", "opacitychannel");
rsl::UniformFloatParam opacitycutoff("opacitycutoff", 0,
                                     "above 0: what is less opaque than this is cut away, and the rest is opaque");
rsl::ColorOutput diffusePart("diffuse", "share of diffuse light and sheen"),
    specularPart("specular", "share of highlights"), reflectionPart("reflection", "share of the mirrored scene"),
    albedo("albedo", "base colour");

/// The parameters of a batch, multiplied by their pictures.
struct Inputs {
  Inputs(const rsl::Batch& b, const Coordinates& at)
      : paint(b, at.of("texturename"), texturename(b.g), linearize(b.g) != 0),
        metallic(b, at, ::metallic),
        specular(b, at, ::specular),
        speculartint(b, at, ::speculartint),
        roughness(b, at, ::roughness),
        sheen(b, at, ::sheen),
        sheentint(b, at, ::sheentint),
        clearcoat(b, at, ::clearcoat),
        clearcoatgloss(b, at, ::clearcoatgloss) {}
  burley::Inputs operator()(const TmGrid* g, int i) const {
    return {rsl::get(g->Cs, i) * paint[i],
            metallic[i],
            specular[i],
            speculartint[i],
            roughness[i],
            sheen[i],
            sheentint[i],
            clearcoat[i],
            clearcoatgloss[i]};
  }

  ColorPicture paint;
  MappedValues metallic, specular, speculartint, roughness, sheen, sheentint, clearcoat, clearcoatgloss;
};

/// One batch of points with their materials.
class Glossy {
  /// A point that shows nothing but its lobes, as metal does, draws this many times the directions that lights want.
  /// With more, only the noise of the lights' own samples would be left.
  static constexpr int kMostTimes = 4;

 public:
  /// Area lights have this many times their samples where the eye sees metal, whose highlights of them are many times
  /// as bright as its mean.
  static constexpr int kTimesOfMetal = 4;

  /// `rays`: least number of directions that mirror the scene; 0: only lights are mirrored.
  Glossy(const rsl::Batch& b, const rsl::Vec3Array& N, const rsl::Vec3Array& V, const Inputs& inputs, int rays)
      : b_(b),
        g_(b.g),
        counted_(static_cast<int>(g_->call->lobeSamples(g_->host, g_))),
        mirrors_(rays > 0),
        least_(b_.rayDepth() > 0 ? std::min(rays, 1) : rays),
        drawn_(directions()),
        L_(g_),
        xi0_(g_),
        xi1_(g_),
        pdf_(g_),
        claimed_(g_),
        cl_(g_) {
    lobes_.reserve(static_cast<size_t>(g_->count));
    number_.reserve(static_cast<size_t>(g_->count));
    mirrored_.reserve(static_cast<size_t>(g_->count));
    for (int i = 0; i < g_->count; ++i) {
      lobes_.emplace_back(N[i], V[i], Material(inputs(g_, i)));
      number_.push_back(directionsOf(lobes_.back()));
      mirrored_.push_back(std::min(number_.back(), mostMirrored()));
    }
  }
  const Lobes& operator[](int i) const { return lobes_[static_cast<size_t>(i)]; }
  bool isAnyMatte() const {
    return std::any_of(lobes_.begin(), lobes_.end(), [](const Lobes& l) { return l.material.matte > 0; });
  }

  /// Adds the part of one sample of the lights, weighted by the power heuristic. addLobeSamples() adds the rest.
  void addLightSample(const TmIlluminance& sample, rsl::Vec3Array& sum) {
    g_->call->lightDensity(g_->host, g_, sample.light, pdf_.data());
    for (int i : b_) {
      const Vec3 L = rsl::get(sample.direction, i);
      if (rsl::dot((*this)[i].N, L) <= 0) continue;
      const float other = pdf_[i] > 0 ? static_cast<float>(counted_) * (*this)[i].pdf(L) / pdf_[i] : 0.0f;
      sum.set(i, sum[i] + rsl::get(sample.Cl, i) * (*this)[i].value(L) / (1 + other * other));
    }
  }
  /// Adds what arrives along directions of the lobes: light, and the scene where it is mirrored. Both come along the
  /// same directions, so that where few directions happen to find the sky, more find what hides it.
  void addLobeSamples(rsl::Vec3Array& ofLights, rsl::Vec3Array& ofScene) {
    Reflections seen(b_, mirrored_, mostMirrored(), least_);
    const int most = number_.empty() ? 0 : *std::max_element(number_.begin(), number_.end());
    for (int k = 0; k < most; ++k) {
      draw(k);
      if (counted_ > 0) addLights(k, ofLights);
      if (!mirrors_) continue;
      for (int i : b_)
        if (const int mirrored = mirrored_[static_cast<size_t>(i)]; k < mirrored && pdf_[i] > 0) {
          const float weight = 1 / (rsl::kPi * pdf_[i] * static_cast<float>(mirrored));
          seen.add(i, L_[i], weight * (*this)[i].value(L_[i]), xi0_[i], xi1_[i]);
        }
      if ((k + 1) % Reflections::kTogether == 0 || k + 1 == most) seen.trace(ofScene);
    }
  }

 private:
  /// Sets L_ and pdf_. Both are 0 where the direction goes below the surface, and for points that draw fewer
  /// directions.
  void draw(int k) {
    g_->call->stratified(g_->host, g_, k, drawn_, xi0_.data(), xi1_.data());
    for (int i : b_) {
      const Vec3 L = (*this)[i].draw(xi0_[i], xi1_[i]);
      pdf_[i] = k < numberOf(i) ? (*this)[i].pdf(L) : 0.0f;
      L_.set(i, pdf_[i] > 0 ? L : Vec3{});
    }
  }

  /// Adds the light along direction k, which is weighted as one of counted_ directions.
  void addLights(int k, rsl::Vec3Array& sum) {
    const float counted = static_cast<float>(counted_);
    for (int i : b_) claimed_[i] = pdf_[i] * counted / static_cast<float>(drawn_);
    g_->call->lightAlong(g_->host, g_, L_, claimed_.data(), k, drawn_, cl_);
    for (int i : b_) sum.set(i, sum[i] + counted / static_cast<float>(numberOf(i)) * cl_[i] * (*this)[i].value(L_[i]));
  }
  int numberOf(int i) const { return number_[static_cast<size_t>(i)]; }

  /// Returns the greatest number of directions. In repeated reflections there are only as many as lights want, because
  /// rays would multiply.
  int directions() const { return std::max(least_, b_.rayDepth() > 0 ? counted_ : kMostTimes * counted_); }
  /// Returns the greatest number of directions along which the scene is mirrored. What they meet costs far more than
  /// light does, so it is not followed along all of them.
  int mostMirrored() const { return std::min(drawn_, std::max(least_, 2 * counted_)); }
  /// Returns the number of directions of one point. The noise of the lobes grows with their share in what is seen, and
  /// the number of directions with its square. A mirrored scene has more detail than lights have.
  int directionsOf(const Lobes& lobes) const {
    if (b_.rayDepth() > 0) return drawn_;
    const float share = lobes.shareOfLobes(), wanted = kMostTimes * share * share * static_cast<float>(counted_);
    return std::clamp(static_cast<int>(std::ceil(wanted)), std::max(least_, mirrors_ ? 2 * counted_ : counted_),
                      drawn_);
  }

  const rsl::Batch& b_;
  const TmGrid* const g_;
  /// The power heuristic counts this many directions of a point, however many it draws: more of them remove noise of
  /// the sky, but small lamps are better found by their own samples.
  const int counted_;
  const bool mirrors_;
  const int least_, drawn_;
  std::vector<Lobes> lobes_;
  std::vector<int> number_;    ///< How many of the drawn_ directions each point has.
  std::vector<int> mirrored_;  ///< How many of these, the first ones, mirror the scene.
  rsl::Vec3Array L_;
  rsl::Array xi0_, xi1_, pdf_, claimed_;
  rsl::Vec3Array cl_;
};

/// `Opacity` of a point is its Oi.
template <class Opacity>
void shadeWith(const rsl::Batch& b, const Coordinates& at, const Opacity& Oi) {
  const TmGrid* g = b.g;
  const rsl::Vec3Array N = normalmap.facingNormals(b, at.of("normalmap")), V = b.towardsViewer(), ambient = b.ambient();
  rsl::Vec3Array diffuse(g), highlight(g), mirrored(g);
  const Inputs inputs(b, at);
  const ColorPicture glow(b, at.of("emissionmap"), emissionmap(g), linearize(g) != 0);
  // Gather rays carry diffuse light alone.
  const bool shiny = b.wantsHighlights();
  Glossy glossy(b, N, V, inputs, shiny ? static_cast<int>(rsl::clamp(reflections(g), 0, 1 << 14)) : 0);
  TmIlluminance sample = tmIlluminanceDefaults();
  if (!glossy.isAnyMatte()) sample.category = "-indirect";  // metal has no diffuse light, which may cost many rays
  if (shiny && b.rayDepth() == 0 && metallic.isEvenlyAbove(1, g)) sample.times = Glossy::kTimesOfMetal;
  while (b.illuminance(sample)) {
    for (int i : b) {
      const Vec3 L = rsl::get(sample.direction, i), H = rsl::normalize(L + V[i]);
      const float nl = rsl::dot(N[i], L);
      if (nl > 0 && !sample.nondiffuse)
        diffuse.set(
            i, diffuse[i] + nl * rsl::get(sample.Cl, i) * glossy[i].material.diffuse(nl, glossy[i].nv, rsl::dot(L, H)));
    }
    // Indirect light is diffuse light: only its main direction is known.
    if (shiny && !sample.nonspecular && !sample.isIndirect) glossy.addLightSample(sample, highlight);
  }
  if (shiny) glossy.addLobeSamples(highlight, mirrored);
  for (int i : b) {
    const Material& m = glossy[i].material;
    const Color matte = m.matte * m.base * ambient[i] + diffuse[i];
    b.output(i, matte + highlight[i] + mirrored[i] + emission(g, i) * glow[i], Oi(i));
    if (diffusePart.wanted(g)) diffusePart.set(g, i, Oi(i) * matte);
    if (specularPart.wanted(g)) specularPart.set(g, i, Oi(i) * highlight[i]);
    if (reflectionPart.wanted(g)) reflectionPart.set(g, i, Oi(i) * mirrored[i]);
    if (albedo.wanted(g)) albedo.set(g, i, Oi(i) * m.base);
  }
}

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  shadeWith(b, Coordinates(b, secondSet), [&](int i) { return b.Os(i); });
}

void shadeCutout(const TmGrid* g) {
  const rsl::Batch b(g);
  const Coordinates at(b, secondSet);
  const MappedValues share(b, at, opacity);
  const float cutoff = opacitycutoff(g);
  const auto cut = [&](float o) { return o >= cutoff ? 1.0f : 0.0f; };
  shadeWith(b, at, [&](int i) {
    const Color o = rsl::clamp(share[i], 0, 1) * b.Os(i);
    return cutoff > 0 ? Color{cut(o.x), cut(o.y), cut(o.z)} : o;
  });
}

/// Returns the parameters of both shaders, which are at the same places in the two lists.
std::vector<rsl::Param*> parameters() {
  return {&metallic.value,
          &specular.value,
          &speculartint.value,
          &roughness.value,
          &sheen.value,
          &sheentint.value,
          &clearcoat.value,
          &clearcoatgloss.value,
          &reflections,
          &emission,
          &texturename,
          &diffusePart,
          &specularPart,
          &reflectionPart,
          &albedo,
          &metallic.map,
          &metallic.channel,
          &specular.map,
          &specular.channel,
          &speculartint.map,
          &speculartint.channel,
          &roughness.map,
          &roughness.channel,
          &sheen.map,
          &sheen.channel,
          &sheentint.map,
          &sheentint.channel,
          &clearcoat.map,
          &clearcoat.channel,
          &clearcoatgloss.map,
          &clearcoatgloss.channel,
          &emissionmap,
          &linearize,
          &normalmap.map,
          &normalmap.scale,
          &secondSet.s,
          &secondSet.t,
          &secondSet.maps};
}

std::vector<rsl::Param*> parametersOfCutout() {
  std::vector<rsl::Param*> out = parameters();
  out.insert(out.end(), {&opacity.value, &opacity.map, &opacity.channel, &opacitycutoff});
  return out;
}
}  // namespace

extern const rsl::Shader disneyShader, disneycutoutShader;
const rsl::Shader disneyShader(TM_SURFACE, "disney", "principled surface of base colour Cs (Burley 2012)",
                               TM_KEEPS_OPACITY | TM_TRACES | TM_TRACES_HIGHLIGHTS | TM_DERIVATIVES, shade,
                               parameters());
const rsl::Shader disneycutoutShader(TM_SURFACE, "disneycutout", "disney with a picture of its opacity",
                                     TM_TRACES | TM_TRACES_HIGHLIGHTS | TM_DERIVATIVES, shadeCutout,
                                     parametersOfCutout());
