#include "raytrace/embree_buffers.h"

#include <algorithm>
#include <span>

namespace tomales {
namespace {

const std::vector<vec3>& positions(const CoarseGroup& g, size_t step) { return step == 0 ? g.P : g.laterP[step - 1]; }

}  // namespace

void shareBuffers(RTCGeometry geometry, const CoarseGroup& g, const Geometry::Run& run) {
  for (unsigned step = 0; step <= g.laterP.size(); ++step)
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT3, positions(g, step).data(), 0,
                               sizeof(vec3), positions(g, step).size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, g.quads.data(),
                             sizeof(Quad) * run.firstQuad, sizeof(Quad), run.count);
}

// Embree pads the vertex buffer that it allocates, because it reads 16 bytes at the last vertex.
void copyBuffers(RTCGeometry geometry, std::vector<Geometry::Run> runs, Geometry& out) {
  const size_t steps = out.meshes[runs.front().mesh].laterP.size() + 1;
  size_t vertexCount = 0, quadCount = 0;
  for (const Geometry::Run& r : runs) {
    vertexCount += out.meshes[r.mesh].P.size();
    quadCount += r.count;
  }
  std::vector<vec3*> vertices;
  for (unsigned step = 0; step < steps; ++step)
    vertices.push_back(static_cast<vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT3, sizeof(vec3), vertexCount)));
  auto* quads = static_cast<Quad*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, sizeof(Quad), quadCount));
  uint32_t firstVertex = 0;
  out.runOfQuad.reserve(quadCount);
  for (size_t r = 0; r < runs.size(); ++r) {
    if (!vertices.back() || !quads) break;
    const CoarseGroup& g = out.meshes[runs[r].mesh];
    runs[r].firstPrimitive = static_cast<uint32_t>(out.runOfQuad.size());
    out.runOfQuad.insert(out.runOfQuad.end(), runs[r].count, static_cast<uint32_t>(r));
    for (size_t step = 0; step < steps; ++step)
      vertices[step] = std::copy(positions(g, step).begin(), positions(g, step).end(), vertices[step]);
    for (const Quad& q : std::span(g.quads).subspan(runs[r].firstQuad, runs[r].count))
      *quads++ = {q[0] + firstVertex, q[1] + firstVertex, q[2] + firstVertex, q[3] + firstVertex};
    firstVertex += static_cast<uint32_t>(g.P.size());
  }
  out.runs = std::move(runs);
}

void filterAbsent(RTCGeometry geometry) {
  rtcSetGeometryIntersectFilterFunction(geometry, rejectAbsent);
  rtcSetGeometryOccludedFilterFunction(geometry, rejectAbsent);
}

}  // namespace tomales
