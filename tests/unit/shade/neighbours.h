// Answers at points and at the neighbours that a shader with TM_NEIGHBOURS has.
#pragma once
#include <gtest/gtest.h>

#include <vector>

#include "reyes/points.h"
#include "reyes/shader_api.h"

namespace tomales {

/// An array for each component of an answer. No service answers what it holds at first.
struct Answer {
  static constexpr int kUnset = -42;
  explicit Answer(const TmGrid* g) : x(static_cast<size_t>(g->padded), float{kUnset}), y(x), z(x) {}
  TmVec3 array() { return {x.data(), y.data(), z.data()}; }
  std::vector<float> x, y, z;
};

/// The points come first, and then their neighbours on four sides.
template <class T>
void expectCopies(const TmGrid* g, const T* answer, const char* what) {
  const int points = g->count / 5;
  ASSERT_EQ(g->count, 5 * points);
  for (int i = 0; i < g->count; ++i) {
    EXPECT_NE(answer[i], static_cast<T>(Answer::kUnset)) << what << " at " << i;
    EXPECT_EQ(answer[i], answer[i % points]) << what << " at " << i;
  }
}
inline void expectCopies(const TmGrid* g, TmConstVec3 answer, const char* what) {
  for (const float* component : {answer.x, answer.y, answer.z}) expectCopies(g, component, what);
}
inline void expectCopies(const TmGrid* g, const Answer& answer, const char* what) {
  for (const std::vector<float>& component : {answer.x, answer.y, answer.z}) expectCopies(g, component.data(), what);
}

/// Returns the points with steps of 0, so that shaders get neighbours where the points are.
inline ShadePoints withSteps(const ShadePoints& points) {
  ShadePoints out(points.group(), points.primvarFloats(), true);
  for (int i = 0; i < points.count(); ++i) {
    out.add(points.key(i));
    for (int c = 0; c < points.channelCount(); ++c) out.channel(c)[i] = points.channel(c)[i];
  }
  return out;
}

}  // namespace tomales
