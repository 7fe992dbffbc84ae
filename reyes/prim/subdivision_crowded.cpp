#include "reyes/prim/subdivision_crowded.h"

#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>

namespace tomales {
namespace {

namespace Far = OpenSubdiv::Far;

/// Number of corners of the faces around a face, above which the face is crowded. A regular face has 32. Up to this
/// limit Bfr, which caches nothing, is as fast.
constexpr int kCrowd = 96;
/// The surface that remains around an irregular vertex, the 2^-8th part of a face, is flat.
constexpr int kLevel = 8;

/// One component of adjacent points, in the form that OpenSubdiv takes.
struct Component {
  struct Value {
    float* x;
    void Clear() { *x = 0; }
    void AddWithWeight(const Value& other, float weight) { *x += weight * *other.x; }
  };
  float* first;
  int width;
  Value operator[](int i) const { return {first + static_cast<ptrdiff_t>(i) * width}; }
};

}  // namespace

bool CrowdedFaces::isCrowd(const Far::TopologyLevel& level, int face) const {
  int corners = 0;
  for (const int vertex : level.GetFaceVertices(face))
    for (const int other : level.GetVertexFaces(vertex)) corners += level.GetFaceVertices(other).size() - 2;
  return corners > kCrowd;
}

CrowdedFaces::CrowdedFaces(const Coarse& mesh, const Far::TopologyLevel& level, const std::vector<int>& candidates) {
  if (mesh.scheme == OpenSubdiv::Sdc::SCHEME_BILINEAR) return;  // no face has a neighbourhood
  for (const int face : candidates)
    if (isCrowd(level, face)) faces_.push_back(face);
  if (faces_.empty()) return;

  using Factory = Far::PatchTableFactory;
  Factory::Options options(kLevel);
  options.SetEndCapType(Factory::Options::ENDCAP_BILINEAR_BASIS);
  options.generateVaryingTables = false;
  options.generateFVarTables = !mesh.channels.empty();
  options.generateFVarLegacyLinearPatches = false;
  options.generateLegacySharpCornerPatches = false;
  const Far::ConstIndexArray selected(faces_.data(), static_cast<int>(faces_.size()));
  refiner_ = makeRefiner(mesh);
  refiner_->RefineAdaptive(options.GetRefineAdaptiveOptions(), selected);
  table_.reset(Factory::Create(*refiner_, options, selected));
  map_ = std::make_unique<Far::PatchMap>(*table_);
  ptex_ = std::make_unique<Far::PtexIndices>(*refiner_);
  regularSize_ = mesh.scheme == OpenSubdiv::Sdc::SCHEME_LOOP ? 3 : 4;
}

CrowdedFaces::Values CrowdedFaces::refine(const float* meshValues, int width, int channel) const {
  if (faces_.empty()) return {};
  const bool faceVarying = channel >= 0;
  const auto count = [&](const Far::TopologyLevel& level) {
    return faceVarying ? level.GetNumFVarValues(channel) : level.GetNumVertices();
  };
  const int local = faceVarying ? table_->GetNumLocalPointsFaceVarying(channel) : table_->GetNumLocalPoints();
  const int refined = faceVarying ? refiner_->GetNumFVarValuesTotal(channel) : refiner_->GetNumVerticesTotal();
  Values out{width, channel, std::vector<float>(static_cast<size_t>(refined + local) * static_cast<size_t>(width))};
  const int coarse = count(refiner_->GetLevel(0));
  std::copy_n(meshValues, static_cast<size_t>(coarse) * static_cast<size_t>(width), out.points.begin());

  const Far::PrimvarRefiner refine(*refiner_);
  for (int c = 0; c < width; ++c) {
    const auto from = [&](int point) {
      return Component{out.points.data() + static_cast<ptrdiff_t>(point) * width + c, width};
    };
    int first = 0;
    for (int k = 1; k <= refiner_->GetMaxLevel(); ++k) {
      const Component source = from(first);
      first += count(refiner_->GetLevel(k - 1));
      Component target = from(first);
      if (faceVarying)
        refine.InterpolateFaceVarying(k, source, target, channel);
      else
        refine.Interpolate(k, source, target);
    }
    if (local == 0) continue;
    Component target = from(refined);
    // Without <float> Far casts down to a class that its tables do not have.
    const Far::StencilTableReal<float>* stencils = faceVarying
                                                       ? table_->GetLocalPointFaceVaryingStencilTable<float>(channel)
                                                       : table_->GetLocalPointStencilTable<float>();
    stencils->UpdateValues(from(0), target);
  }
  return out;
}

void CrowdedFaces::evaluate(const Values& values, int face, int corner, float u, float v, float* value, float* byU,
                            float* byV) const {
  const bool whole = refiner_->GetLevel(0).GetFaceVertices(face).size() == regularSize_;
  const Far::PatchTable::PatchHandle* handle = map_->FindPatch(ptex_->GetFaceId(face) + (whole ? 0 : corner), u, v);
  constexpr int kMostControls = 20;
  float weight[kMostControls], weightByU[kMostControls], weightByV[kMostControls];
  const bool faceVarying = values.faceVaryingChannel >= 0;
  if (faceVarying)
    table_->EvaluateBasisFaceVarying(*handle, u, v, weight, weightByU, weightByV, nullptr, nullptr, nullptr,
                                     values.faceVaryingChannel);
  else
    table_->EvaluateBasis(*handle, u, v, weight, weightByU, weightByV);
  const Far::ConstIndexArray controls =
      faceVarying ? table_->GetPatchFVarValues(*handle, values.faceVaryingChannel) : table_->GetPatchVertices(*handle);
  const auto sum = [&](const float* weights, float scale, float* out) {
    if (!out) return;
    std::fill_n(out, values.width, 0.0f);
    for (int k = 0; k < controls.size(); ++k)
      for (int c = 0; c < values.width; ++c)
        out[c] +=
            scale * weights[k] *
            values
                .points[static_cast<size_t>(controls[k]) * static_cast<size_t>(values.width) + static_cast<size_t>(c)];
  };
  // Far measures a corner's part of a face in halves of its coordinates.
  const float scale = whole ? 1 : 0.5f;
  sum(weight, 1, value);
  sum(weightByU, scale, byU);
  sum(weightByV, scale, byV);
}

size_t CrowdedFaces::bytes() const {
  if (faces_.empty()) return 0;
  // Estimate of the memory of Far's patch table and refined topology for a patch.
  return static_cast<size_t>(table_->GetNumPatchesTotal()) * 600;
}

}  // namespace tomales
