// The parts whose sum is Ci, as output parameters of the standard surface shaders; each is premultiplied, as Ci is.
// Indirect light is left out of `diffuse`, so that ambient + diffuse + indirectdiffuse + specular + reflection = Ci.
#pragma once
#include "reyes/shader.h"

struct DiffuseParts {
  rsl::ColorOutput ambient{"ambient", "share of ambient light"};
  rsl::ColorOutput diffuse{"diffuse", "share of direct diffuse light"};
  rsl::ColorOutput indirectdiffuse{"indirectdiffuse", "share of indirect diffuse light"};

  /// `ofAmbient` and `ofDiffuse` return a point's factors on ambient() and diffuse(), opacity included.
  template <class Ambient, class Diffuse>
  void store(const rsl::Batch& b, TmConstVec3 Nf, const rsl::Vec3Array& fromAmbient, const Ambient& ofAmbient,
             const Diffuse& ofDiffuse) const {
    if (ambient.wanted(b.g))
      for (int i : b) ambient.set(b.g, i, ofAmbient(i) * fromAmbient[i]);
    storeOf(b, diffuse, TM_DIRECT_LIGHT, Nf, ofDiffuse);
    storeOf(b, indirectdiffuse, TM_INDIRECT_LIGHT, Nf, ofDiffuse);
  }

 private:
  template <class Diffuse>
  static void storeOf(const rsl::Batch& b, const rsl::ColorOutput& to, TmLightChoice which, TmConstVec3 Nf,
                      const Diffuse& ofDiffuse) {
    if (!to.wanted(b.g)) return;
    const rsl::Vec3Array light = b.diffuse(which, Nf);
    for (int i : b) to.set(b.g, i, ofDiffuse(i) * light[i]);
  }
};
