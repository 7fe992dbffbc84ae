// A batch of points, and a renderer that answers from what the test has laid out.
#pragma once
#include <functional>
#include <map>
#include <memory>

#include "reyes/base/simd.h"
#include "reyes/rsl/code.h"
#include "reyes/shader.h"

namespace tomales::compiler {

/// u runs from 0 to 1 over the points; the i-th point is at (i, 2 i, 3).
class FakeGrid {
 public:
  explicit FakeGrid(int count) : n(padded(count)) {
    grid.structBytes = sizeof grid;
    grid.count = count;
    grid.padded = n;
    grid.time = 0.25f;
    grid.dtime = 0.5f;
    grid.clip[0] = 1;
    grid.clip[1] = 100;
    grid.P = scattered();
    grid.N = triples();
    grid.Ci = triples();
    grid.Oi = triples();
    grid.L = triples();
    grid.Cl = triples();
    const TmVec3 Ng = triples(), I = triples(), dPdu = triples(), dPdv = triples(), dPdtime = triples(), Cs = triples(),
                 Os = triples();
    grid.Ng = rsl::view(Ng);
    grid.I = rsl::view(I);
    grid.dPdu = rsl::view(dPdu);
    grid.dPdv = rsl::view(dPdv);
    grid.dPdtime = rsl::view(dPdtime);
    grid.Cs = rsl::view(Cs);
    grid.Os = rsl::view(Os);
    float *const u = array(), *const v = array(), *const s = array(), *const t = array(), *const du = array(),
                 *const dv = array();
    grid.u = u;
    grid.v = v;
    grid.s = s;
    grid.t = t;
    grid.du = du;
    grid.dv = dv;
    grid.alpha = array();
    for (int i = 0; i < n; ++i) {
      const auto x = static_cast<float>(i);
      u[i] = x / static_cast<float>(count);
      v[i] = 0.5f;
      s[i] = x;
      t[i] = -x;
      du[i] = 0.25f;
      dv[i] = 0.5f;
      rsl::set(grid.P, i, {x, 2 * x, 3});
      rsl::set(grid.N, i, {0, 0, -1});
      rsl::set(Ng, i, {0, 0, -2});
      rsl::set(I, i, {0, 0, 1});
      rsl::set(Cs, i, {0.25f, 0.5f, 1});
      rsl::set(Os, i, {1, 0.5f, 0.25f});
      rsl::set(grid.Ci, i, kBefore);
      rsl::set(grid.Oi, i, kBefore);
      grid.alpha[i] = 0.125f;
    }
    active.assign(static_cast<size_t>(n), 0);
    std::fill_n(active.begin(), count, uint8_t{1});
    grid.active = active.data();
    setServices();
    grid.call = &services;
    grid.host = this;
  }
  FakeGrid(const FakeGrid&) = delete;

  float* array(int components = 1) {
    arrays_.push_back(std::make_unique<AlignedVector<float>>(static_cast<size_t>(n * components), 0.0f));
    return arrays_.back()->data();
  }
  /// Components lie in one array, as a host's may.
  TmVec3 triples() {
    float* const x = array(3);
    return {x, x + n, x + 2 * n};
  }
  TmVec3 scattered() {
    float *const z = array(), *const y = array();
    return {array(), y, z};
  }

  /// Values for the parameters of a code: defaults; outputs get arrays.
  void bind(const Code& code) {
    params.clear();
    for (const Parameter& p : code.parameters) {
      TmValue v{};
      v.length = std::max(1, p.type.length);
      floats_.push_back(std::make_unique<std::vector<float>>(p.floats));
      const float* const at = floats_.back()->data();
      for (int k = 0; k < 3; ++k) v.c[k] = at + (p.floats.size() >= 3 ? k : 0);
      if (p.output) {
        for (auto& c : v.c) c = array();
        v.step = 1;
      }
      texts_.push_back(std::make_unique<std::string>());
      for (const std::string& t : p.texts) texts_.back()->append(t).push_back('\0');
      v.string = texts_.back()->c_str();
      params.push_back(v);
    }
    grid.params = params.data();
  }
  const float* output(size_t k, int component = 0) const { return params[k].c[component]; }

  static constexpr rsl::Vec3 kBefore{-7, -7, -7};
  struct FakeLight {
    std::function<bool(int i)> lit;
    rsl::Vec3 L, Cl;
    float dimmed = 0;
  };
  struct Answer {
    int32_t type = TM_FLOAT;
    std::vector<float> floats;
    std::string text;
  };

  const int n;
  TmGrid grid{};
  std::vector<uint8_t> active;
  std::vector<TmValue> params;
  TmServices services{};
  std::vector<FakeLight> lights;
  std::map<std::string, Answer> answers;  ///< The key is "whom:name", or for gather() the name alone.
  std::vector<std::string> reports, printed;
  std::vector<std::vector<uint8_t>> masks;  ///< The mask of each call of illuminance, ambient, texture and gather.
  TmTextureOptions textureOptions{};
  std::string filter;  ///< Their filter: the text that they point at is gone when the program has ended.
  TmRayOptions rayOptions{};
  TmOcclusion occlusionOptions{};
  std::string asked;  ///< The name of the last file that was asked for.
  std::vector<std::string> channels;
  std::vector<std::pair<std::string, float>> sent;
  bool hasP = false;

 private:
  static FakeGrid& of(void* host) { return *static_cast<FakeGrid*>(host); }
  void seen(const TmGrid* g) { masks.emplace_back(g->active, g->active + g->padded); }
  template <class Body>
  static void each(const TmGrid* g, const Body& body) {
    for (int i = 0; i < g->count; ++i)
      if (g->active[i]) body(i);
  }
  void setServices();
  std::vector<std::unique_ptr<AlignedVector<float>>> arrays_;
  std::vector<std::unique_ptr<std::vector<float>>> floats_;
  std::vector<std::unique_ptr<std::string>> texts_;
};

}  // namespace tomales::compiler

#include "tests/unit/rsl_machine/fake_services.h"
