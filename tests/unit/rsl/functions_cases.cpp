// Functions (RISpec 3.2 section 12): arguments by reference, results, scopes, overloads.
#include <cmath>

#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {

Cases functionCases() {
  static const Case kCases[] = {
      {"a result", "x = twice(s);", [](float i) { return 2 * i; }, {"float twice(float a) { return 2 * a; }"}},
      {"a function within the shader", "float twice(float a) { return 2 * a; } x = twice(s + 1);",
       [](float i) { return 2 * i + 2; }},
      {"two calls in one expression", "float f(float a) { float b = a * a; return b; } x = f(s) - f(2);",
       [](float i) { return i * i - 4; }},
      {"a call of a call", "float f(float a) { return a + 1; } x = f(f(f(s)));", [](float i) { return i + 3; }},
      {"functions that call functions",
       "x = g(s);",
       [](float i) { return 2 * (i + 1); },
       {"float f(float a) { return a + 1; } float g(float a) { return 2 * f(a); }"}},
      {"an output", "void f(float a; output float b) { b = a + 1; } float y = 0; f(s, y); x = y;",
       [](float i) { return i + 1; }},
      {"an output of the shader itself", "void f(output float b) { b = 7; } f(x);", 7},
      {"several outputs",
       "void f(output float a, b; output color d) { a = 1; b = 2; d = 3; } float p, q; f(p, q, c); x = p + q;", 3},
      {"an output keeps what it holds where nothing is assigned",
       "void f(output float b) { if (s > 2) b = 7; } x = 1; f(x);", [](float i) { return i > 2 ? 7.0f : 1.0f; }},
      {"an output that is an element of an array",
       "void f(output float b) { b = 7; } float a[3] = {1, 2, 3}; f(a[1]); x = a[0] * 100 + a[1] * 10 + a[2];", 173},
      {"an output and a result", "float f(output float b) { b = 5; return 2; } float y; x = f(y); x = x * 10 + y;", 25},
      {"a parameter that is assigned leaves the variable alone, but for outputs",
       "float f(float a) { float b = a; b += 1; return b; } float y = s; x = f(y) * 1000 + y;",
       [](float i) { return (i + 1) * 1000 + i; }},
      {"an argument and an output that are one variable",
       "void f(float a; output float b) { b = 2; b = a + b; } float y = 5; f(y, y); x = y;", 4},
      {"a variable of the caller has another's name",
       "float f(float a) { float y = a; return y; } float y = 3; x = f(s) + y;", [](float i) { return i + 3; }},
      {"return in the middle", "float f(float a) { if (a > 2) return 1; return 2; } x = f(s);",
       [](float i) { return i > 2 ? 1.0f : 2.0f; }},
      {"return in the middle of a loop",
       "float f(float a) { float k; for (k = 0; k < 10; k += 1) if (k * k > a) return k; return -1; } x = f(mod(s, "
       "50));",
       [](float i) { return std::floor(std::sqrt(std::fmod(i, 50.0f))) + 1; }},
      {"return in nested branches",
       "float f(float a) { if (a > 1) { if (a > 3) return 3; x += 10; } else { return 1; } return 2; } float y = f(s); "
       "x += y;",
       [](float i) { return i > 3   ? 3.0f
                            : i > 1 ? 12.0f
                                    : 1.0f; },
       {.parameters = ""}},
      {"return of a color in the middle",
       "color f() { if (s > 2) return color (1, 2, 3); return color (4, 5, 6); } c = f();",
       [](float i) {
         return i > 2 ? Vec3{1, 2, 3} : Vec3{4, 5, 6};
       }},
      {"return from nothing", "void f(output float a) { a = 1; if (s > 2) return; a = 2; } f(x);",
       [](float i) { return i > 2 ? 1.0f : 2.0f; }},
      {"a return leaves the function alone", "float f(float a) { if (a > 2) return 1; return 2; } x = f(s); x += 10;",
       [](float i) { return i > 2 ? 11.0f : 12.0f; }},
      {"a call in a branch", "float f(float a) { if (a > 4) return 1; return 2; } if (s > 2) x = f(s);",
       [](float i) { return i > 4   ? 1.0f
                            : i > 2 ? 2.0f
                                    : 0.0f; }},
      {"a call in a loop's condition",
       "float f(float a) { if (a > 3) return 0; return 1; } float k = 0; while (f(k) == 1) { k += 1; } x = k;", 4},
      {"extern", "float a = 1; void f() { extern float a; a = s; } f(); x = a;", [](float i) { return i; }},
      {"extern of a shader's parameter",
       "float f() { extern float p; return p + 1; } x = f();",
       4,
       {.parameters = "float p = 3;"}},
      {"extern of a global", "float f() { extern float s; return s + 1; } x = f();", [](float i) { return i + 1; }},
      {"functions see globals", "x = f();", [](float i) { return i + 1; }, {"float f() { return s + 1; }"}},
      {"extern through two functions",
       "float a = 1; void f() { extern float a; void g() { extern float a; a = 5; } g(); a += 1; } f(); x = a;", 6},
      {"a function within a function",
       "float f(float a) { float g(float b) { return b * 3; } return g(a) + 1; } x = f(s);",
       [](float i) { return 3 * i + 1; }},
      {"a function within a shader before its definition",
       "float f() { return g() + 1; } float g() { return s; } x = f();", [](float i) { return i + 1; }},
      {"overloads by the argument",
       "x = f(1) + f(color (1, 2, 3)) * 10;",
       21,
       {"float f(float a) { return 1; } float f(color a) { return 2; }"}},
      {"overloads by the result",
       "color a = f(); float b = f(); x = comp(a, 1) + b * 10; x += comp(f(1), 0) * 100;",
       913,
       {"float f() { return 1; } color f() { return color (2, 3, 4); }"
        " color f(color a) { return 7; } float f(float a) { return 9; }"}},
      {"overloads of points and vectors",
       "x = f(P) + f(N) * 10 + f(I) * 100;",
       321,
       {"float f(point a) { return 1; } float f(normal a) { return 2; } float f(vector a) { return 3; }"}},
      {"overloads by the number of arguments",
       "x = f(s) + f(s, 2);",
       [](float i) { return 2 * i + 2; },
       {"float f(float a) { return a; } float f(float a, b) { return a + b; }"}},
      {"a function has a built-in one's name",
       "x = smoothstep(0, 1, s);",
       42,
       {"float smoothstep(float a, b, d) { return 42; }"}},
      {"a built-in function where an own one of its name does not suit",
       "x = length(vector (3, 4, 0)) + length(\"a\");",
       47,
       {"float length(string a) { return 42; }"}},
      {"a number is given to a color", "color f(color a) { return a; } c = f(s);",
       [](float i) {
         return Vec3{i, i, i};
       }},
      {"an array", "float f(float a[3]) { return a[0] + a[1] * a[2]; } float b[3] = {1, 2, 3}; x = f(b);", 7},
      {"an array of open length",
       "x = f(b2());",
       6,
       {"float f(float a[]) { float k, n = 0; for (k = 0; k < arraylength(a); k += 1) n += a[k]; return n; } "
        "float b2() { float b[3] = {1, 2, 3}; return f(b); } float f(float a) { return a; }"}},
      {"an output array", "void f(output float a[2]) { a[0] = 3; a[1] = 4; } float b[2]; f(b); x = b[0] * 10 + b[1];",
       34},
      {"a text", "float f(string a) { if (a == \"one\") return 1; return 2; } x = f(\"one\") * 10 + f(\"two\");", 12},
      {"a call in an early return",
       "x = f(s);",
       [](float i) { return i > 4 ? 2 * i : 0; },
       {.outside = "float h(float a) { if (a > 1) return a; return 0; } float g(float a) { if (a > 2) return 2 * h(a);"
                   " return 0; } float f(float a) { if (a > 4) return g(a); return 0; }"}},
      {"a number that is returned early as a matrix",
       "x = determinant(unit(s));",
       [](float i) { return i > 4 ? 1.0f : 16.0f; },
       {.outside = "matrix unit(float k) { if (k > 4) return 1; return 2; }"}},
      {"a matrix", "vector f(matrix m) { return vtransform(m, vector P); } w = f(2);",
       [](float i) {
         return Vec3{2 * i, 4 * i, 6};
       }},
      {"results of functions in a triplet keep their order",
       "float n = 0; float f() { extern float n; n += 1; return n; } c = color (f(), f(), f());", Vec3{1, 2, 3}},
      {"arguments are evaluated from left to right",
       "float n = 0; float f() { extern float n; n += 1; return n; } float g(float a, b) { return a * 10 + b; } x = "
       "g(f(), f());",
       12},
      {"an argument that a later one changes",
       "float n = 1; float f() { extern float n; n = 9; return 2; } float g(float a, b) { return a * 10 + b; } x = "
       "g(n, f());",
       12},
      {"the shader's own result within a function", "void f() { extern float x; x = s * 2; } f();",
       [](float i) { return 2 * i; }},
      {"a function that nobody calls", "x = 1;", 1, {"float f(float a) { return a / 0; }"}},
      {"a uniform parameter that is given what varies", "float f(uniform float a) { return a + 1; } x = f(s);",
       [](float i) { return i + 1; }},
      {"parameters without commas",
       "x = f(1, 2, color (3, 4, 5));",
       6,
       {"float f(float a, b; color d) { return a + b + comp(d, 0); }"}},
      {"deep nesting of calls",
       "float f(float a) { return a + 1; } float g(float a) { return f(f(a)); } float h(float a) { return g(g(a)); } x "
       "= h(h(s));",
       [](float i) { return i + 8; }},
  };
  return kCases;
}

}  // namespace tomales::compiler
