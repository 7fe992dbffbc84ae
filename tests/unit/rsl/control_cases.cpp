// Conditions and loops under masks, and what leaves them (RISpec 3.2 section 13).
#include <cmath>

#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {
namespace {
bool odd(float i) { return std::fmod(i, 2.0f) == 1; }
/// Sum of the numbers below.
float below(float n) { return n * (n - 1) / 2; }
float least(float a, float b) { return std::min(a, b); }
}  // namespace

Cases controlCases() {
  static const Case kCases[] = {
      {"if without else", "x = 1; if (s > 3) x = 2;", [](float i) { return i > 3 ? 2.0f : 1.0f; }},
      {"else belongs to the nearer if", "if (s > 2) if (s > 4) x = 1; else x = 2;",
       [](float i) { return i > 4   ? 1.0f
                            : i > 2 ? 2.0f
                                    : 0.0f; }},
      {"else if", "if (s < 2) x = 1; else if (s < 4) x = 2; else x = 3;",
       [](float i) { return i < 2   ? 1.0f
                            : i < 4 ? 2.0f
                                    : 3.0f; }},
      {"nested conditions that vary", "if (mod(s, 2) == 1) { if (s > 4) x = 1; else x = 2; } else { x = 3; }",
       [](float i) { return odd(i) ? (i > 4 ? 1.0f : 2.0f) : 3.0f; }},
      {"a uniform condition", "uniform float k = 3; if (k > 2) x = s; else x = -1;", [](float i) { return i; }},
      {"a uniform condition within a varying one", "uniform float k = 1; if (s > 2) { if (k == 1) x = 5; else x = 6; }",
       [](float i) { return i > 2 ? 5.0f : 0.0f; }},
      {"the condition is evaluated once", "float k = 0; if ((k += 1) == 1) k += 10; else k += 100; x = k;", 11},
      {"a variable set in both branches", "float a; if (s > 2) a = s; else a = -s; x = a;",
       [](float i) { return i > 2 ? i : -i; }},
      {"a uniform variable that is set in a varying branch", "uniform float a = 1; if (s > 2) a = 2; x = a;",
       [](float i) { return i > 2 ? 2.0f : 1.0f; }},
      {"a branch changes what the condition read", "float a = s; if (a > 2) { a = 0; x = 1; } else { a = 9; x = 2; }",
       [](float i) { return i > 2 ? 1.0f : 2.0f; }},
      {"while", "float k = 0; while (k < 5) { x += k; k += 1; }", 10},
      {"while that varies", "float k = 0; while (k < mod(s, 7)) { x += k; k += 1; }",
       [](float i) { return below(std::fmod(i, 7.0f)); }},
      {"while that is never true", "while (s < 0) x = 1;", 0},
      {"for", "float k; for (k = 0; k < 4; k += 1) x += s;", [](float i) { return 4 * i; }},
      {"for that varies", "float k; for (k = 0; k < mod(s, 5); k = k + 1) x += k;",
       [](float i) { return below(std::fmod(i, 5.0f)); }},
      {"for whose step is ++", "float k; for (k = 0; k < 4; k++) x += s;", [](float i) { return 4 * i; }},
      {"for whose step is -- before the counter", "float k; for (k = 4; k > 0; --k) x += s;",
       [](float i) { return 4 * i; }},
      {"a step of two parts", "float k, n = 0; for (k = 0; k < 4; n += 2, ++k) x += s; x += n;",
       [](float i) { return 4 * i + 8; }},
      {"the value of ++ is that before", "float k = 3, before = k++; x = 10 * k + before;", 43},
      {"the value of ++ before a variable is that after", "float k = 3, after = ++k; x = 10 * k + after;", 44},
      {"-- before an element", "float a[2] = {1, 5}; x = --a[1] * 10 + a[1];", 44},
      {"two signs between operands stay signs", "x = 7 - -s + +1;", [](float i) { return 8 + i; }},
      {"the counter is known behind the loop", "float k; for (k = 0; k < mod(s, 5); k += 1) x = k; x = k;",
       [](float i) { return std::fmod(i, 5.0f); }},
      {"loops in loops", "float j, k; for (j = 0; j < 3; j += 1) for (k = 0; k <= j; k += 1) x += 1;", 6},
      {"a loop that varies in a loop that does",
       "float j, k; for (j = 0; j < mod(s, 4); j += 1) for (k = 0; k < j; k += 1) x += 1;",
       [](float i) { return below(std::fmod(i, 4.0f)); }},
      {"a loop within a branch", "float k; if (s > 2) for (k = 0; k < 3; k += 1) x += s; else x = -1;",
       [](float i) { return i > 2 ? 3 * i : -1; }},
      {"break", "float k; for (k = 0; k < 10; k += 1) { if (k == 4) break; x += 1; }", 4},
      {"break at some points", "float k; for (k = 0; k < 10; k += 1) { if (k == s) break; x += 1; }",
       [](float i) { return least(i, 10); }},
      {"nothing of the round runs behind a break", "float k; for (k = 0; k < 3; k += 1) { if (s > 2) break; x += 1; }",
       [](float i) { return i > 2 ? 0.0f : 3.0f; }},
      {"the step does not run behind a break", "float k; for (k = 0; k < 10; k += 1) if (k == s) break; x = k;",
       [](float i) { return least(i, 10); }},
      {"continue", "float k; for (k = 0; k < 6; k += 1) { if (mod(k, 2) == 0) continue; x += k; }", 9},
      {"the step runs behind a continue", "float k; for (k = 0; k < 6; k += 1) { if (k == s) continue; x += 1; }",
       [](float i) { return i < 6 ? 5.0f : 6.0f; }},
      {"continue in while", "float k = 0; while (k < 6) { k += 1; if (k > s) continue; x += 1; }",
       [](float i) { return least(i, 6); }},
      {"break 2",
       "float j, k; for (j = 0; j < 5; j += 1) for (k = 0; k < 5; k += 1) { if (j == 2 && k == 3) break 2; x += 1; }",
       13},
      {"break 2 at some points",
       "float j, k; for (j = 0; j < 3; j += 1) { for (k = 0; k < 3; k += 1) { if (j * 3 + k == s) break 2; x += 1; } "
       "x += 100; }",
       [](float i) { return i >= 9 ? 309.0f : i + 100 * std::floor(i / 3); }},
      {"continue 2",
       "float j, k; for (j = 0; j < 3; j += 1) { for (k = 0; k < 3; k += 1) { if (k == s) continue 2; x += 1; } "
       "x += 100; }",
       [](float i) { return i < 3 ? 3 * i : 309.0f; }},
      {"break within a branch within a branch",
       "float k = 0; while (k < 8) { k += 1; if (k > 2) { if (k > s) { x += 1000; break; } } x += k; }",
       [](float i) {
         float x = 0;
         for (float k = 1; k <= 8; ++k) {
           if (k > 2 && k > i) return x + 1000;
           x += k;
         }
         return x;
       }},
      {"continue and break in one loop",
       "float k; for (k = 0; k < 20; k += 1) { if (mod(k, 3) == 0) continue; if (k > s) break; x += k; }",
       [](float i) {
         float x = 0;
         for (float k = 0; k < 20; ++k) {
           if (std::fmod(k, 3.0f) == 0) continue;
           if (k > i) break;
           x += k;
         }
         return x;
       }},
      {"the end of a shader in the middle", "x = 1; if (s > 2) return; x = 2;",
       [](float i) { return i > 2 ? 1.0f : 2.0f; }},
      {"the end of a shader in a loop", "float k; for (k = 0; k < 9; k += 1) { if (k == s) return; x += 1; } x = -1;",
       [](float i) { return i < 9 ? i : -1; }},
      {"a uniform loop of a uniform count under a mask",
       "uniform float k = 0; if (s > 3) { while (k < 3) { x += 2; k += 1; } }",
       [](float i) { return i > 3 ? 6.0f : 0.0f; }},
      {"a variable of an inner block hides the outer one", "float a = 1; { float a = s; x = a; } x += a;",
       [](float i) { return i + 1; }},
      {"the first value of a hiding variable is of the outer one", "float a = s; { float a = a + 1; x = a; }",
       [](float i) { return i + 1; }},
      {"a variable that is declared in a loop starts anew",
       "float k; for (k = 0; k < 3; k += 1) { float a; a += 1; x += a; }", 3},
      {"a variable with a value in a loop gets it each round",
       "float k; for (k = 0; k < 3; k += 1) { float a = s; a += k; x += a; }", [](float i) { return 3 * i + 3; }},
      {"what a loop changes counts in its next round",
       "float a = 1, k; for (k = 0; k < 4; k += 1) a = a * 2 + 0 * s; x = a;", 16},
      {"two variables change places in a loop",
       "float a = 1, b = 2, k; for (k = 0; k < mod(s, 3); k += 1) { float h = a; a = b; b = h; } x = a * 10 + b;",
       [](float i) { return std::fmod(i, 3.0f) == 1 ? 21.0f : 12.0f; }},
      {"Fibonacci's numbers",
       "float a = 0, b = 1, k; for (k = 0; k < mod(s, 12); k += 1) { b += a; a = b - a; } x = a;",
       [](float i) {
         float a = 0, b = 1;
         for (float k = 0; k < std::fmod(i, 12.0f); ++k) {
           b += a;
           a = b - a;
         }
         return a;
       }},
      {"Collatz",
       "float n = mod(s, 12) + 1; while (n != 1) { if (mod(n, 2) == 0) n = n / 2; else n = 3 * n + 1; x += 1; }",
       [](float i) {
         float x = 0;
         for (float n = std::fmod(i, 12.0f) + 1; n != 1; ++x) n = odd(n) ? 3 * n + 1 : n / 2;
         return x;
       }},
      {"empty statements", "; ; if (s > 2) ; else x = 1; { } ;", [](float i) { return i > 2 ? 0.0f : 1.0f; }},
      {"a color in a varying loop", "float k; for (k = 0; k < mod(s, 4); k += 1) c += color (1, k, 2);",
       [](float i) {
         const float n = std::fmod(i, 4.0f);
         return Vec3{n, below(n), 2 * n};
       }},
      {"a condition of and with loops behind it", "float k = 0; while (k < 5 && k < s) { k += 1; } x = k;",
       [](float i) { return least(i, 5); }},
  };
  return kCases;
}

}  // namespace tomales::compiler
