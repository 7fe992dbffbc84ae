// The language's rules, each in a small shader with an answer on paper. A body assigns `x` (a number), or `c` (a color)
// and `w` (a vector), whose sum counts. `s` is the number of the point.
#pragma once
#include <functional>
#include <span>
#include <type_traits>

#include "tests/unit/rsl_machine/fake_grid.h"

namespace tomales::compiler {

using rsl::Vec3;

struct CaseOptions {
  const char* outside = "";     ///< Functions before the shader.
  const char* parameters = "";  ///< Further ones, each with a semicolon.
  const char* kind = "surface";
  float tolerance = 4e-6f;        ///< Of the answer's size, or absolute below 1.
  const char* message = nullptr;  ///< A part of what the renderer is told; null: it is told nothing.
};

struct Case {
  /// `answer`: a number or Vec3, or a function of the point's number that gives one.
  template <class Answer>
  Case(const char* rule_, const char* text_, Answer answer, CaseOptions options_ = {})
      : rule(rule_), text(text_), options(options_) {
    if constexpr (std::is_invocable_v<Answer, float>) {
      if constexpr (std::is_same_v<std::invoke_result_t<Answer, float>, Vec3>)
        triple = answer;
      else
        number = answer;
    } else if constexpr (std::is_same_v<Answer, Vec3>) {
      triple = [answer](float) { return answer; };
    } else {
      number = [answer](float) { return static_cast<float>(answer); };
    }
  }
  const char *rule, *text;
  CaseOptions options;
  std::function<float(float)> number;
  std::function<Vec3(float)> triple;
};

/// A point of the grid that the cases run on.
inline Vec3 at(float i) { return {i, 2 * i, 3}; }

using Cases = std::span<const Case>;
Cases operatorCases();
Cases conversionCases();
Cases controlCases();
Cases functionCases();
Cases arrayCases();
Cases textCases();
Cases mathematicsCases();
Cases geometryCases();
Cases colorCases();
Cases matrixCases();
Cases noiseCases();
Cases derivativeCases();
Cases lightCases();
Cases rayCases();
Cases messageCases();
Cases kindCases();
Cases parameterCases();

/// All tables, for what is to be true of them together.
inline std::vector<std::pair<const char*, Cases>> allCases() {
  return {{"operators", operatorCases()},
          {"conversions", conversionCases()},
          {"control", controlCases()},
          {"functions", functionCases()},
          {"arrays", arrayCases()},
          {"texts", textCases()},
          {"mathematics", mathematicsCases()},
          {"geometry", geometryCases()},
          {"colors", colorCases()},
          {"matrices", matrixCases()},
          {"noise", noiseCases()},
          {"derivatives", derivativeCases()},
          {"light", lightCases()},
          {"rays", rayCases()},
          {"messages", messageCases()},
          {"kinds", kindCases()},
          {"parameters", parameterCases()}};
}

}  // namespace tomales::compiler
