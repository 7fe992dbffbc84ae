// Properties of transformations and numbers in RIB, for requests that RapidCheck makes up.
#include "tests/unit/made_up.h"
#include "tests/unit/rib/rib_test_tools.h"

namespace tomales {
namespace {

using test::madeUpVector;
using test::numberIn;

/// Transformations as RISpec writes them: a point is a row vector, and the latest request acts on it first.
using Rows = std::array<std::array<double, 4>, 4>;

Rows identity() {
  Rows out{};
  for (size_t i = 0; i < 4; ++i) out[i][i] = 1;
  return out;
}

Rows product(const Rows& a, const Rows& b) {
  Rows out{};
  for (size_t i = 0; i < 4; ++i)
    for (size_t j = 0; j < 4; ++j)
      for (size_t k = 0; k < 4; ++k) out[i][j] += a[i][k] * b[k][j];
  return out;
}

vec3 moved(const vec3& p, const Rows& m) {
  const double row[4] = {p.x, p.y, p.z, 1};
  double out[3] = {};
  for (size_t j = 0; j < 3; ++j)
    for (size_t i = 0; i < 4; ++i) out[j] += row[i] * m[i][j];
  return glm::dvec3(out[0], out[1], out[2]);
}

/// Turns about an axis by Rodrigues' formula, counterclockwise for who looks against the axis of a right-handed space.
Rows rotation(double degrees, const glm::dvec3& axis) {
  const glm::dvec3 k = glm::normalize(axis);
  const double angle = glm::radians(degrees), c = std::cos(angle), s = std::sin(angle);
  Rows out = identity();
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 e(0.0);
    e[i] = 1;
    const glm::dvec3 turned = c * e + s * glm::cross(k, e) + (1 - c) * glm::dot(k, e) * k;
    for (int j = 0; j < 3; ++j) out[static_cast<size_t>(i)][static_cast<size_t>(j)] = turned[j];
  }
  return out;
}

struct Transformation {
  std::string request;
  Rows matrix;
};

std::string words(const char* name, std::initializer_list<float> numbers) {
  std::string out = name;
  for (const float number : numbers) out += " " + std::to_string(number);
  return out + "\n";
}

Transformation madeUpTransformation() {
  Transformation out{"", identity()};
  const vec3 v = madeUpVector(-2, 2);
  switch (*test::wholeIn(0, 4)) {
    case 0:
      out.request = words("Translate", {v.x, v.y, v.z});
      for (int k = 0; k < 3; ++k) out.matrix[3][static_cast<size_t>(k)] = double{v[k]};
      return out;
    case 1: {
      const vec3 scale = v + vec3(2.25f);
      out.request = words("Scale", {scale.x, scale.y, scale.z});
      for (int k = 0; k < 3; ++k) out.matrix[static_cast<size_t>(k)][static_cast<size_t>(k)] = double{scale[k]};
      return out;
    }
    case 2: {
      RC_PRE(dot(v, v) > 0);
      const float degrees = *numberIn(-360, 360);
      out.request = words("Rotate", {degrees, v.x, v.y, v.z});
      out.matrix = rotation(double{degrees}, v);
      return out;
    }
    default: {
      std::string numbers = "[";
      for (size_t i = 0; i < 4; ++i)
        for (size_t j = 0; j < 4; ++j) {
          if (j < 3) out.matrix[i][j] += double{*numberIn(-0.2f, 0.2f)};
          numbers += std::to_string(out.matrix[i][j]) + " ";
          out.matrix[i][j] = std::stod(std::to_string(out.matrix[i][j]));
        }
      out.request = "ConcatTransform " + numbers + "]\n";
      return out;
    }
  }
}

void expectPlacedBy(const Rows& worldFromObject, const Reading& r) {
  RC_ASSERT(r.scene().objects.size() == 1u);
  const mat4 m = r.object(0).worldFromObject.at(0);
  for (const vec3& p : {vec3(0.0f), vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)}) {
    const vec3 expected = moved(p, worldFromObject);
    RC_ASSERT(glm::length(transformPoint(m, p) - expected) <= 1e-4f * (1 + glm::length(expected)));
  }
}

RC_GTEST_PROP(Transformations, ActOnPointsLatestFirst, ()) {
  std::string text;
  Rows all = identity();
  for (int left = *test::wholeIn(0, 7); left > 0; --left) {
    const Transformation t = madeUpTransformation();
    text += t.request;
    all = product(t.matrix, all);
  }
  expectPlacedBy(all, Reading(inWorld(text + kSphere)));
}

RC_GTEST_PROP(Transformations, OfAnInnerBlockEndWithIt, ()) {
  const Transformation outer = madeUpTransformation(), inner = madeUpTransformation();
  const bool attributes = *rc::gen::arbitrary<bool>();
  const std::string begin = attributes ? "AttributeBegin\n" : "TransformBegin\n",
                    end = attributes ? "AttributeEnd\n" : "TransformEnd\n";
  expectPlacedBy(outer.matrix, Reading(inWorld(outer.request + begin + inner.request + end + kSphere)));
}

RC_GTEST_PROP(Transformations, BeforeIdentityAreForgotten, ()) {
  const Transformation lost = madeUpTransformation(), kept = madeUpTransformation();
  expectPlacedBy(kept.matrix, Reading(inWorld(lost.request + "Identity\n" + kept.request + kSphere)));
}

RC_GTEST_PROP(Transformations, ComeBackByTheNameOfACoordinateSystem, ()) {
  const Transformation named = madeUpTransformation(), lost = madeUpTransformation();
  expectPlacedBy(named.matrix, Reading(inWorld(named.request + "CoordinateSystem \"here\"\n" + lost.request +
                                               "CoordSysTransform \"here\"\n" + kSphere)));
}

RC_GTEST_PROP(Numbers, AreReadToTheNearestFloatInEveryWayToWriteThem, ()) {
  const auto mantissa = *test::wholeIn<int64_t>(-9'999'999'999, 9'999'999'999);
  const int exponent = *test::wholeIn(-30, 25), form = *test::wholeIn(0, 4);
  const double value = static_cast<double>(mantissa) * std::pow(10.0, exponent);
  char text[400];
  const char* const forms[] = {"%.17g", "%.12e", "%+.10E", "%f"};
  std::snprintf(text, sizeof(text), forms[form], value);
  const Requests requests("Translate " + std::string(text) + " 0 0\n");
  RC_ASSERT(requests.list.size() == 1u);
  RC_ASSERT(requests.list[0].args.at(0).numbers.at(0) == std::strtof(text, nullptr));
}

}  // namespace
}  // namespace tomales
