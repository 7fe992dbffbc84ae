// Message passing (RISpec 3.2 section 15.8): what nobody answers leaves the variable alone and gives 0.
#include "tests/unit/rsl/cases.h"

namespace tomales::compiler {

Cases messageCases() {
  static const Case kCases[] = {
      {"surface", "float a = 7; x = surface(\"other\", a) * 10 + a;", 7},
      {"displacement", "float a = 7; x = displacement(\"other\", a) * 10 + a;", 7},
      {"atmosphere", "color a = s; x = atmosphere(\"other\", a) * 10 + comp(a, 0);", [](float i) { return i; }},
      {"incident", "float a = 7; x = incident(\"other\", a) * 10 + a;", 7},
      {"opposite", "float a = 7; x = opposite(\"other\", a) * 10 + a;", 7},
      {"attribute", "float a = 7; x = attribute(\"user:a\", a) * 10 + a;", 7},
      {"option", "float a = 7; x = option(\"user:a\", a) * 10 + a;", 7},
      {"rendererinfo", "string a = \"b\"; x = rendererinfo(\"other\", a);", 0},
      {"rayinfo", "float a = 7; x = rayinfo(\"type\", a) * 10 + a;", 12},
      {"raylabel", "if (raylabel() == \"mirror\") x = 1;", 1},
      {"raydepth of the eye's rays", "x = raydepth() + raylevel();", 0},
      {"isshadowray", "x = isshadowray() + isindirectray();", 0},
      {"isoutput", "x = isoutput(\"a\");", 1},
      {"shadername", "if (shadername() == \"test\") x = 1;", 1},
      {"shadername of another kind", "if (shadername(\"displacement\") == \"\") x = 1;", 1},
      {"an answer at some points", "float a = 7; if (s > 2) rayinfo(\"type\", a); x = a;",
       [](float i) { return i > 2 ? 2.0f : 7.0f; }},
  };
  return kCases;
}

}  // namespace tomales::compiler
