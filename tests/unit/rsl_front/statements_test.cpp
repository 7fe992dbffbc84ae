// The tree of every statement and definition.
#include <gtest/gtest.h>

#include "front_test_tools.h"

namespace tomales::compiler {
namespace {

void expectBodies(std::initializer_list<Case> cases) {
  // Trees are those of a body; its own two levels are left out of what is expected.
  for (const Case& c : cases) {
    std::string tree = treeOf(c.text), out;
    for (size_t at = 0; at < tree.size(); at = tree.find('\n', at) + 1)
      out += tree.substr(at + 4, tree.find('\n', at) - at - 4) + '|';
    EXPECT_EQ(out, c.expected) << c.text;
  }
}

/// The dump of a whole file, lines by '|'.
std::string fileOf(const std::string& text) {
  Front front(text);
  std::string out = dump(front.parsed().file);
  for (char& c : out)
    if (c == '\n') c = '|';
  return front.messages.all().empty() ? out : messagesOf(front);
}

TEST(Statements, AreThoseOfTheLanguage) {
  expectBodies(
      {{";", "empty|"},
       {"{ ; { } }", "block|  empty|  block|"},
       {"a;", "expression|  name a|"},
       {"f(1);", "expression|  call f|    number 1|"},
       {"if (a) b;", "if|  name a|  expression|    name b|"},
       {"if (a) ; else ;", "if|  name a|  empty|  empty|"},
       {"if (a) if (b) ; else ;", "if|  name a|  if|    name b|    empty|    empty|"},
       {"while (a) ;", "while|  name a|  empty|"},
       {"for (a; b; c) ;", "for|  name a|  name b|  name c|  empty|"},
       {"for (;;) ;", "for|  none|  none|  none|  empty|"},
       {"for (a, b; c; d, e) ;", "for|  comma|    name a|    name b|  name c|  comma|    name d|    name e|  empty|"},
       {"break; continue;", "break 1|continue 1|"},
       {"break 2; continue 3;", "break 2|continue 3|"},
       {"return; return a;", "return|  none|return|  name a|"}});
}

TEST(Statements, OfLightAndRaysHaveListsInTheirBrackets) {
  expectBodies(
      {{"illuminance(P) ;", "illuminance|  name P|  empty|"},
       {"illuminance(\"c\", P, N, PI / 2, \"send:x\", y) { }",
        "illuminance|  string \"c\"|  name P|  name N|  binary /|    name PI|    number 2|  string \"send:x\"|  "
        "name y|  block|"},
       {"illuminate(P) ;", "illuminate|  name P|  empty|"},
       {"solar() ;", "solar|  empty|"},
       {"solar(A, 0) ;", "solar|  name A|  number 0|  empty|"},
       {"gather(\"\", P, N, 1, 4) a; else b;",
        "gather|  string \"\"|  name P|  name N|  number 1|  number 4|  expression|    name a|  expression|    "
        "name b|"},
       {"illuminance = solar + gather;",
        "expression|  assign =|    name illuminance|    binary +|      name solar|      name gather|"}});
}

TEST(Statements, DeclareVariables) {
  expectBodies(
      {{"float a;", "declare|  variable float a|"},
       {"float a, b = 2, c[3];", "declare|  variable float a|  variable float b|    number 2|  variable float[3] c|"},
       {"uniform color a; varying string b;",
        "declare|  variable uniform color a|declare|  variable varying string b|"},
       {"extern point P;", "declare|  variable extern point P|"},
       {"extern uniform float a, b;", "declare|  variable extern uniform float a|  variable extern uniform float b|"},
       {"float a[2] = {1, 2};", "declare|  variable float[2] a|    tuple|      number 1|      number 2|"},
       {"color a[];", "declare|  variable color[] a|"},
       {"matrix m = 1; normal n; vector v;",
        "declare|  variable matrix m|    number 1|declare|  variable normal n|declare|  variable vector v|"},
       {"{ float a; a = 1; float b; }",
        "block|  declare|    variable float a|  expression|    assign =|      name a|      number 1|  declare|    "
        "variable float b|"}});
}

TEST(Statements, ThatBeginWithATypeMayBeCasts) {
  expectBodies({{"float f(x);", "expression|  cast float|    call f|      name x|"},
                {"color \"hsv\" a;", "expression|  cast color \"hsv\"|    name a|"}});
}

TEST(Statements, DeclareTheVariableOfALoopInABlockAroundIt) {
  expectBodies(
      {{"for (uniform float i = 0; i < 2; i += 1) ;",
        "block|  declare|    variable uniform float i|      number 0|  for|    none|    binary <|      name i|   "
        "   number 2|"
        "    assign +=|      name i|      number 1|    empty|"}});
}

TEST(Statements, DefineFunctions) {
  expectBodies({{"float f(float x) { return x; }",
                 "define|  function float f|    variable float x|    block|      return|        name x|"},
                {"void f() { }", "define|  function void f|    block|"},
                {"f(float x) { }", "define|  function void f|    variable float x|    block|"},
                {"float f() { float g() { } }",
                 "define|  function float f|    block|      define|        function float g|          block|"}});
}

TEST(Definitions, AreShadersOfAllKinds) {
  EXPECT_EQ(fileOf("surface a() {} light b() {} displacement c() {} volume d() {} imager e() {} transformation f() {}"),
            "surface a|  block|light b|  block|displacement c|  block|volume d|  block|imager e|  block|transformation "
            "f|  block|");
}

TEST(Definitions, AreFunctionsBeforeAndBetweenShaders) {
  EXPECT_EQ(fileOf("float f() {} surface a() {} color g(float x) {}; h() {}"),
            "function float f|  block|function color g|  variable float x|  block|function void h|  block|surface a|  "
            "block|");
}

TEST(Definitions, AreClassesWhoseMethodsAreCalledInTheirOrder) {
  EXPECT_EQ(fileOf("class a(float k = 1;) { constant float b = k; public void surface(output color Ci, c) {}\n"
                   "private float f() {} public void begin() {} }"),
            "surface a|  variable float k|    number 1|  block|    declare|      variable float b|        name k|"
            "    define|      function void surface|        variable output color c|        block|"
            "    define|      function float f|        block|    define|      function void begin|        block|"
            "    expression|      call begin|    expression|      call surface|        name Oi|");
  EXPECT_EQ(
      fileOf("class a() { public void lighting(output color Ci, Oi) {} public void surface(output color Ci, Oi) {}\n"
             "public void displacement(output point P; output normal N) {} }"),
      "surface a|  block|    define|      function void lighting|        block|"
      "    define|      function void surface|        variable output color Ci|        variable output color Oi|"
      "        block|"
      "    define|      function void displacement|        block|"
      "    expression|      call displacement|    expression|      call lighting|"
      "displacement a|  block|    empty|    empty|    define|      function void displacement|        block|"
      "    expression|      call displacement|");
}

TEST(Definitions, OfClassesMayCallTheirOwnMethods) {
  EXPECT_EQ(
      fileOf("class a() { public void diffuselighting(output color Ci, o) {} public void opacity(output color Oi) {}\n"
             "public void prelighting(output color Ci, Oi) { color x; opacity(Oi); opacity(x); } }"),
      "surface a|  block|    define|      function void diffuselighting|        variable output color o|"
      "        block|    define|      function void opacity|        block|"
      "    define|      function void prelighting|        block|          declare|            variable color x|"
      "          expression|            call opacity|"
      "          expression|            call opacity|              name x|"
      "    expression|      call opacity|    expression|      call prelighting|"
      "    expression|      call diffuselighting|        name Oi|");
}

TEST(Definitions, HaveParametersInAnyOfTheirSpellings) {
  EXPECT_EQ(fileOf("surface a(float x = 1, y = 2; color z = (1, 2, 3);) {}"),
            "surface a|  variable float x|    number 1|  variable float y|    number 2|  variable color z|    tuple|   "
            "   number 1|"
            "      number 2|      number 3|  block|");
  EXPECT_EQ(fileOf("surface a(float x, color y,) {}"), "surface a|  variable float x|  variable color y|  block|");
  EXPECT_EQ(
      fileOf("surface a(output varying float x; varying output float y, z; uniform string s) {}"),
      "surface a|  variable output varying float x|  variable output varying float y|  variable output varying float z|"
      "  variable uniform string s|  block|");
  EXPECT_EQ(fileOf("float f(float a[]; point b[4]) {}"),
            "function float f|  variable float[] a|  variable point[4] b|  block|");
  EXPECT_EQ(fileOf("surface a(;;float x;;) {}"), "surface a|  variable float x|  block|");
}

TEST(Definitions, MayHaveNamesThatAreWordsElsewhere) {
  EXPECT_EQ(fileOf("surface light(float surface = 1) {}"),
            "surface light|  variable float surface|    number 1|  block|");
}

TEST(Definitions, TakeTheirDocumentationFromTheCommentBefore) {
  const auto docOf = [](const std::string& text) { return Front(text).parsed().file.shaders.at(0)->doc; };
  EXPECT_EQ(docOf("/* A plain\n * surface. It has more. */\nsurface a() {}"), "A plain surface.");
  EXPECT_EQ(docOf("// One.\n// Two.\nlight a() {}"), "One.");
  EXPECT_EQ(docOf("/* no full stop */ surface a() {}"), "no full stop");
  EXPECT_EQ(docOf("/* far */ float f() {} surface a() {}"), "");
  EXPECT_EQ(docOf("surface a() {}"), "");
  EXPECT_EQ(docOf("/****\n * v1.5 of it\n ****/\nsurface a() {}"), "v1.5 of it");
}

TEST(Dumps, ShowTypesThatAreSet) {
  Front front("surface a() { b + 1; }");
  front.parsed();
  front.file.shaders[0]->body->body[0]->exprs[0]->type = {Base::Color, 0};
  front.file.shaders[0]->body->body[0]->exprs[0]->args[0]->type = {Base::Point, 3};
  EXPECT_EQ(
      dump(front.file),
      "surface a\n  block\n    expression\n      binary + : color\n        name b : point[3]\n        number 1\n");
}

}  // namespace
}  // namespace tomales::compiler
