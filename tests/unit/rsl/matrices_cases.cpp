// Matrices (RISpec 3.2 section 15.4): rows act on points from the left, the translation is the last row. A number is
// that number times the identity (section 11.4).
#include "reyes/shader/shadeops.h"
#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {
namespace {
#define MOVED "matrix m = matrix (1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 4, 5, 6, 1); "
}  // namespace

Cases matrixCases() {
  static const Case kCases[] = {
      {"a number stands on all of the diagonal",
       "matrix m = 3; x = comp(m, 0, 0) + 10 * comp(m, 2, 2) + 100 * comp(m, 3, 3) + 1000 * comp(m, 0, 1);", 333},
      {"a multiple of the identity moves no point", "matrix m = 2; w = vector transform(m, P);", at},
      {"elements by row and column", MOVED "x = comp(m, 3, 0) * 100 + comp(m, 3, 1) * 10 + comp(m, 3, 2);", 456},
      {"an element is set", MOVED "setcomp(m, 3, 0, s); x = comp(m, 3, 0);", [](float i) { return i; }},
      {"elements that vary", "matrix m = matrix (s, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1); x = determinant(m);",
       [](float i) { return i; }},
      {"determinant", MOVED "x = determinant(m);", 6},
      {"determinant of a rotation",
       "x = determinant(rotate((matrix 1), s, vector (1, 2, 3)));",
       1,
       {.tolerance = 1e-5f}},
      {"the product does the left one first",
       MOVED "matrix n = translate((matrix 1), vector (1, 0, 0)); w = vector transform(m * n, point (s, 0, 0));",
       [](float i) {
         return Vec3{i + 5, 5, 6};
       }},
      {"the quotient is the product with the inverse",
       MOVED "w = vector transform(m / m, P);",
       at,
       {.tolerance = 1e-5f}},
      {"1 over a matrix is its inverse", MOVED "w = vector transform(m * (1 / m), P);", at, {.tolerance = 1e-5f}},
      {"translate comes first",
       "w = vector transform(translate(scale((matrix 1), point (2, 2, 2)), vector (1, 0, 0)), point (s, 0, 0));",
       [](float i) {
         return Vec3{2 * (i + 1), 0, 0};
       }},
      {"scale comes first",
       "w = vector transform(scale(translate((matrix 1), vector (1, 0, 0)), point (2, 2, 2)), point (s, 0, 0));",
       [](float i) {
         return Vec3{2 * i + 1, 0, 0};
       }},
      {"rotate around z by a quarter",
       "w = vector transform(rotate((matrix 1), PI / 2, vector (0, 0, 1)), point (1, 0, 0));", Vec3{0, 1, 0}},
      {"equal matrices", MOVED "if (m == m) x = 1;", 1},
      {"matrices that differ", MOVED "if (m != (matrix 1)) x = 1;", 1},
      {"a matrix without a value", "matrix m; x = 5 + comp(m, 0, 0) + comp(m, 3, 3) * 10;", 5},
      {"a matrix from world", "matrix m = matrix \"world\" 1; w = vector transform(m, P);", at},
      {"a matrix that is assigned at some points", "matrix m = 1; if (s > 2) m = 2; w = vtransform(m, vector P);",
       [](float i) { return i > 2 ? 2 * at(i) : at(i); }},
      {"a parameter",
       "w = vector transform(p, P);",
       [](float i) {
         return at(i) + Vec3{1, 2, 3};
       },
       {.parameters = "matrix p = (1,0,0,0, 0,1,0,0, 0,0,1,0, 1,2,3,1);"}},
      {"transform from a space by a matrix",
       "w = vector transform(\"current\", scale((matrix 1), point (2, 2, 2)), P);", [](float i) { return 2 * at(i); }},
      {"vtransform from a space by a matrix", "w = vtransform(\"current\", (matrix 2), vector P);",
       [](float i) { return 2 * at(i); }},
      {"ntransform from a space by a matrix", "w = ntransform(\"current\", (matrix 2), normal P);",
       [](float i) { return 0.5f * at(i); }},
  };
  return kCases;
}

}  // namespace tomales::compiler
