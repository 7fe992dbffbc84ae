// Operators and precedence (RISpec 3.2 section 14.1), by value.
#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {

Cases operatorCases() {
  static const Case kCases[] = {
      {"products before sums", "x = 2 + 3 * s;", [](float i) { return 2 + 3 * i; }},
      {"quotients before differences", "x = 20 - s / 4;", [](float i) { return 20 - i / 4; }},
      {"differences associate to the left", "x = 10 - s - 3;", [](float i) { return 7 - i; }},
      {"quotients associate to the left", "x = s / 4 / 2;", [](float i) { return i / 8; }},
      {"a quotient and a product go from the left", "x = s / 4 * 2;", [](float i) { return i / 2; }},
      {"a product and a quotient go from the left", "x = 2 * s / 4;", [](float i) { return i / 2; }},
      {"brackets come first", "x = (2 + 3) * (s - 1);", [](float i) { return 5 * (i - 1); }},
      {"minus binds tighter than products", "x = -s * 2;", [](float i) { return -2 * i; }},
      {"minus of minus", "x = - -s;", [](float i) { return i; }},
      {"minus behind an operator", "x = 3 * -s;", [](float i) { return -3 * i; }},
      {"division is that of real numbers", "x = 7 / 2;", 3.5f},
      {"the dot product binds tighter than products", "vector a = (1, 2, 3); vector b = (4, 5, 6); x = 2 * a . b;", 64},
      {"the dot product before sums", "vector a = (1, 2, 3); vector b = (4, 5, 6); x = 1 + a . b;", 33},
      {"the cross product", "vector a = (1, 0, 0); vector b = (0, s, 0); w = a ^ b;",
       [](float i) {
         return Vec3{0, 0, i};
       }},
      {"the cross product changes its sign with its order", "vector a = (1, 0, 0); vector b = (0, 1, 0); w = b ^ a;",
       Vec3{0, 0, -1}},
      {"the cross product before sums", "vector a = (1, 0, 0); vector b = (0, 1, 0); w = a + a ^ b;", Vec3{1, 0, 1}},
      {"dot of a cross product in brackets",
       "vector a = (1, 0, 0); vector b = (0, 1, 0); vector d = (0, 0, s); x = (a ^ b) . d;", [](float i) { return i; }},
      {"sums of triples by components", "w = vector (1, 2, s) + vector (10, 20, 30);",
       [](float i) {
         return Vec3{11, 22, 30 + i};
       }},
      {"products of triples by components", "c = color (1, 2, s) * color (2, 3, 4);",
       [](float i) {
         return Vec3{2, 6, 4 * i};
       }},
      {"quotients of triples by components", "c = color (4, 9, s) / color (2, 3, 4);",
       [](float i) {
         return Vec3{2, 3, i / 4};
       }},
      {"a number before a triple", "c = 2 * color (1, 2, s);",
       [](float i) {
         return Vec3{2, 4, 2 * i};
       }},
      {"a number behind a triple", "c = color (1, 2, s) / 2;",
       [](float i) {
         return Vec3{0.5f, 1, i / 2};
       }},
      {"a number over a triple", "c = 12 / color (1, 2, 4);", Vec3{12, 6, 3}},
      {"a number and a triple in a sum", "c = 1 + color (1, 2, s);",
       [](float i) {
         return Vec3{2, 3, 1 + i};
       }},
      {"a triple less a number", "c = color (1, 2, s) - 1;",
       [](float i) {
         return Vec3{0, 1, i - 1};
       }},
      {"minus of a triple", "w = -vector (1, -2, s);",
       [](float i) {
         return Vec3{-1, 2, -i};
       }},
      {"point less point is a vector", "w = P - point (0, 0, 3);",
       [](float i) {
         return Vec3{i, 2 * i, 0};
       }},
      {"point and vector is a point", "point Q = P + vector (1, 1, 1); w = vector Q;",
       [](float i) {
         return Vec3{i + 1, 2 * i + 1, 4};
       }},
      {"less", "if (s < 3) x = 1; else x = 2;", [](float i) { return i < 3 ? 1.0f : 2.0f; }},
      {"less or equal", "if (s <= 3) x = 1; else x = 2;", [](float i) { return i <= 3 ? 1.0f : 2.0f; }},
      {"greater", "if (s > 3) x = 1; else x = 2;", [](float i) { return i > 3 ? 1.0f : 2.0f; }},
      {"greater or equal", "if (s >= 3) x = 1; else x = 2;", [](float i) { return i >= 3 ? 1.0f : 2.0f; }},
      {"equal", "if (s == 3) x = 1; else x = 2;", [](float i) { return i == 3 ? 1.0f : 2.0f; }},
      {"not equal", "if (s != 3) x = 1; else x = 2;", [](float i) { return i != 3 ? 1.0f : 2.0f; }},
      {"triples are equal if all components are", "if (color (s, 1, 2) == color (3, 1, 2)) x = 1;",
       [](float i) { return i == 3 ? 1.0f : 0.0f; }},
      {"triples differ if one component does", "if (vector (s, 1, 2) != vector (3, 1, 2)) x = 1;",
       [](float i) { return i != 3 ? 1.0f : 0.0f; }},
      {"a triple is equal to a number if all components are", "if (color (s, s, s) == 2) x = 1;",
       [](float i) { return i == 2 ? 1.0f : 0.0f; }},
      {"and", "if (s > 2 && s < 5) x = 1;", [](float i) { return i > 2 && i < 5 ? 1.0f : 0.0f; }},
      {"or", "if (s < 2 || s > 5) x = 1;", [](float i) { return i < 2 || i > 5 ? 1.0f : 0.0f; }},
      {"and before or", "if (s == 1 || s > 2 && s < 5) x = 1;",
       [](float i) { return i == 1 || (i > 2 && i < 5) ? 1.0f : 0.0f; }},
      {"not", "if (!(s < 3)) x = 1;", [](float i) { return i < 3 ? 0.0f : 1.0f; }},
      {"not before and", "if (!(s == 0) && s < 3) x = 1;", [](float i) { return i != 0 && i < 3 ? 1.0f : 0.0f; }},
      {"comparisons after sums", "if (s + 1 < 2 * 3) x = 1;", [](float i) { return i + 1 < 6 ? 1.0f : 0.0f; }},
      {"what is not 0 is true", "float f = s - 2; if (f != 0) x = 1;", [](float i) { return i != 2 ? 1.0f : 0.0f; }},
      {"a choice", "x = s < 3 ? 10 : 20;", [](float i) { return i < 3 ? 10.0f : 20.0f; }},
      {"choices associate to the right", "x = s < 2 ? 1 : s < 4 ? 2 : 3;",
       [](float i) { return i < 2   ? 1.0f
                            : i < 4 ? 2.0f
                                    : 3.0f; }},
      {"a choice after comparisons and sums", "x = s + 1 < 3 ? s + 10 : s - 10;",
       [](float i) { return i + 1 < 3 ? i + 10 : i - 10; }},
      {"a choice of triples", "c = s < 3 ? color (1, 2, 3) : color (4, 5, 6);",
       [](float i) {
         return i < 3 ? Vec3{1, 2, 3} : Vec3{4, 5, 6};
       }},
      {"a choice evaluates one side alone", "float a = 0; x = s < 3 ? (a = 1) : (a = 2); x = x * 10 + a;",
       [](float i) { return i < 3 ? 11.0f : 22.0f; }},
      {"an assignment has a value", "float a; x = 1 + (a = s); x += a;", [](float i) { return 1 + 2 * i; }},
      {"assignments associate to the right", "float a, b; a = b = s + 1; x = a * b;",
       [](float i) { return (i + 1) * (i + 1); }},
      {"+=", "x = 3; x += s;", [](float i) { return 3 + i; }},
      {"-=", "x = 3; x -= s;", [](float i) { return 3 - i; }},
      {"*=", "x = 3; x *= s + 1;", [](float i) { return 3 * (i + 1); }},
      {"/=", "x = s; x /= 2 + 2;", [](float i) { return i / 4; }},
      {"+= of a triple and a number", "c = color (1, 2, 3); c += s;",
       [](float i) {
         return Vec3{1 + i, 2 + i, 3 + i};
       }},
      {"*= of a triple and a triple", "c = color (1, 2, 3); c *= color (2, s, 4);",
       [](float i) {
         return Vec3{2, 2 * i, 12};
       }},
      {"operands go from left to right", "float a = 1; x = a + (a = s) * 10 + a;", [](float i) { return 1 + 11 * i; }},
      {"an assignment within a product", "float a = 2; x = a * (a = 5) * a;", 50},
      {"PI", "x = PI;", 3.14159265f},
      {"numbers with points and exponents", "x = .5 + 1. + 2.5e1 + 1e-1;", 26.6f},
      {"a long sum", "x = s+1+2+3+4+5+6+7+8+9+10+11+12+13+14+15+16;", [](float i) { return i + 136; }},
      {"quotient of 0 and a number", "x = 0 / (s + 1);", 0},
  };
  return kCases;
}

}  // namespace tomales::compiler
