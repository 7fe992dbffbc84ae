// Tests the messages about texts that are wrong: line, column and words.
#include <gtest/gtest.h>

#include "front_test_tools.h"

namespace tomales::compiler {
namespace {

void expectErrors(std::initializer_list<Case> cases) {
  for (const Case& c : cases) {
    Front front(c.text);
    EXPECT_EQ(messagesOf(front.parsed()), c.expected) << c.text;
  }
}

/// The cases are lines in the body of a shader that begins on line 0.
void expectInBody(std::initializer_list<Case> cases) {
  for (const Case& c : cases) {
    Front front(std::string("surface x() {\n") + c.text + "\n}");
    EXPECT_EQ(messagesOf(front.parsed()), c.expected) << c.text;
  }
}

TEST(Errors, OfWordsAreToldWithTheirPlace) {
  expectErrors(
      {{"surface a() {} \"b",
        "1:16: this string is not closed on its line\n1:16: expected a shader or a function before the string 'b'"},
       {"surface a() {}\n/* b\n\n", "2:1: this comment is not closed: there is no '*/' after it"},
       {"surface a() {}\n  @", "2:3: a stray byte 0x40: '@'"},
       {"surface a() {} 1x", "1:16: '1x' is not a number\n1:16: expected a shader or a function before '1x'"},
       {"surface a() {} 1.2.3", "1:16: '1.2.3' is not a number\n1:16: expected a shader or a function before '1.2.3'"},
       {"surface a() {} 'b'", "1:16: ''b'' is not of the language: strings stand in double quotes"}});
}

TEST(Errors, OfMacrosAreToldWithTheirPlace) {
  expectErrors(
      {{"#define", "1:1: '#define' needs a name"},
       {"#define 1 2", "1:9: '#define' needs a name"},
       {"#define defined 1", "1:9: 'defined' cannot be a macro"},
       {"#define f(x,x) x", "1:13: macro 'f' has two parameters 'x'"},
       {"#define f(x y) x", "1:13: expected ')' after the parameters of macro 'f'\n1:10: note: to match this '('"},
       {"#define f(1) x", "1:11: expected the name of a parameter of macro 'f'"},
       {"#define f(..., x) x", "1:14: expected ')' after the parameters of macro 'f'\n1:10: note: to match this '('"},
       {"#define f(x) #y", "1:14: '#' is not followed by a parameter of the macro"},
       {"#define a ## b", "1:11: '##' has nothing before it"},
       {"#define a b ##", "1:13: '##' has nothing after it"},
       {"#define f(x, y) x\n  f(1)", "2:3: macro 'f' takes 2 arguments, and 1 is given\n1:9: note: it is defined here"},
       {"#define f(x) x\nf(1, 2)", "2:1: macro 'f' takes 1 argument, and 2 are given\n1:9: note: it is defined here"},
       {"#define f(x) x\n f(1, (2)\n", "2:2: the arguments of macro 'f' are not closed"},
       {"#define p(x) x ## ;\np(+)",
        "2:3: '##' makes '+;', which is not one word\n2:3: expected a shader or a function before '+'"},
       {"#undef", "1:1: '#undef' needs the name of a macro"}});
}

TEST(Errors, OfConditionsAreToldWithTheirPlace) {
  expectErrors(
      {{"\n#if 1\n#if 0\n#endif", "2:1: this condition is not closed: there is no '#endif' after it"},
       {"#endif", "1:1: '#endif' without an '#if' before it"},
       {"#else", "1:1: '#else' without an '#if' before it"},
       {"#if 0\n#else\n#else\n#endif",
        "3:1: '#else' after the '#else' of the same '#if'\n1:1: note: the '#if' is here"},
       {"#if 0\n#else\n#elif 1\n#endif",
        "3:1: '#elif' after the '#else' of the same '#if'\n1:1: note: the '#if' is here"},
       {"#if\n#endif", "1:1: expected a value in this condition"},
       {"#if 1 +\n#endif", "1:1: expected a value in this condition"},
       {"#if (1\n#endif", "1:1: expected ')' in this condition"},
       {"#if 1 2\n#endif", "1:7: expected an operator before '2' in this condition"},
       {"#if 1 / 0\n#endif", "1:7: division by zero in this condition"},
       {"#if 1.5\n#endif", "1:5: '1.5' is not an integer in this condition"},
       {"#if \"a\"\n#endif", "1:5: expected a value before '\"a\"' in this condition"},
       {"#if 1 ? 2\n#endif", "1:1: expected ':' in this condition"},
       {"#if defined 1\n#endif", "1:5: 'defined' needs the name of a macro, or one in brackets"},
       {"#if defined(a\n#endif", "1:5: 'defined' needs the name of a macro, or one in brackets"},
       {"#ifdef\n#endif", "1:1: '#ifdef' needs the name of a macro"},
       {"#includ \"a\"", "1:2: 'includ' is no directive; 'include'?"},
       {"#include a", "1:1: '#include' needs \"NAME\" or <NAME>"},
       {"#include \"none.h\"",
        "1:10: cannot include 'none.h': there is no such file beside the file or in the folders for headers"}});
}

TEST(Errors, OfDefinitionsAreToldWithTheirPlace) {
  expectErrors(
      {{"surfce a() {}", "1:1: expected a shader or a function before 'surfce'; did you mean 'surface'?"},
       {"dispalcement a() {}",
        "1:1: expected a shader or a function before 'dispalcement'; did you mean 'displacement'?"},
       {"surface () {}", "1:9: expected the name of a shader before '('"},
       {"surface a {}", "1:11: expected '(' before '{'"},
       {"surface a(\n", "1:11: expected the type of a parameter before the end of the file"},
       {"surface a(float) {}", "1:16: expected a name before ')'"},
       {"surface a(flaot x) {}", "1:11: expected the type of a parameter before 'flaot'; did you mean 'float'?"},
       {"surface a(float x y) {}", "1:19: expected ')' before 'y'\n1:10: note: to match this '('"},
       {"surface a(float x = ) {}", "1:21: expected an expression before ')'"},
       {"surface a(float x[0]) {}", "1:19: the length of an array is a whole number from 1 to 1048576"},
       {"surface a(float x[1.5]) {}", "1:19: the length of an array is a whole number from 1 to 1048576"},
       {"surface a(float x[n]) {}", "1:19: expected the length of the array, a number, before 'n'"},
       {"surface a()\n", "1:12: expected '{' before the end of the file"},
       {"surface a() {\n", "1:14: expected '}' before the end of the file\n1:13: note: to match this '{'"},
       {"surface a() {} }", "1:16: expected a shader or a function before '}'"},
       {"float x = 1;", "1:9: expected '(' before '='"},
       {"uniform x() {}", "1:9: expected a type before 'x'"}});
}

TEST(Errors, OfStatementsAreToldWithTheirPlace) {
  expectInBody({{"a = 1\nb = 2;", "2:6: expected ';' before 'b'"},
                {"a = 1 b = 2;", "2:7: expected ';' before 'b'"},
                {"flaot a;", "2:1: 'flaot' is no type; did you mean 'float'?"},
                {"foo a;", "2:1: 'foo' is no type"},
                {"whlie (a) { }", "2:1: 'whlie' begins no statement; did you mean 'while'?"},
                {"illuminence(P) { }", "2:1: 'illuminence' begins no statement; did you mean 'illuminance'?"},
                {"if a) ;", "2:4: expected '(' before 'a'"},
                {"if (a ;", "2:7: expected ')' before ';'\n2:4: note: to match this '('"},
                {"while (a;", "2:9: expected ')' before ';'\n2:7: note: to match this '('"},
                {"else ;", "2:1: 'else' without an 'if' before it"},
                {"for (a; b) ;", "2:10: expected ';' before ')'"},
                {"break 0;", "2:7: 'break' leaves a whole number of loops, at least 1"},
                {"break 1.5;", "2:7: 'break' leaves a whole number of loops, at least 1"},
                {"continue a;", "2:10: expected ';' before 'a'"},
                {"return a", "2:9: expected ';' before '}'"},
                {"illuminance(P { }", "2:15: expected ')' before '{'\n2:12: note: to match this '('"},
                {"int a;", "2:1: RSL has no 'int': every number is a 'float'"},
                {"const float a = 1;", "2:1: RSL has no 'const'; a name for a value that stays is made by '#define'"},
                {"if (a) then b;", "2:8: an 'if' has no 'then': the statement follows the brackets"},
                {"switch (a) { }", "2:1: RSL has no 'switch', only 'if' and 'else'"},
                {"float[3] a;", "2:6: the length of an array stands behind its name: 'float x[3]'"},
                {"a = b & c;", "2:7: RSL has no '&'; '&&' joins conditions"},
                {"a = b % c;", "2:7: RSL has no '%'; mod(x, y) is the remainder"},
                {"a = b ** 2;", "2:8: RSL has no '**'; pow(x, y) is the power"},
                {"do { a; } while (b);", "2:1: RSL has no 'do' loop, only 'while' and 'for'"},
                {"float;", "2:6: expected an expression before ';'"},
                {"float a[;", "2:9: expected the length of the array, a number, before ';'"},
                {"float a = ;", "2:11: expected an expression before ';'"},
                {"float a, ;", "2:10: expected a name before ';'"}});
}

TEST(Errors, OfExpressionsAreToldWithTheirPlace) {
  expectInBody({{"a = ;", "2:5: expected an expression before ';'"},
                {"a = (1, 2);", "2:5: 2 values in brackets; a triple has 3, and a matrix 16"},
                {"a = (1 + 2;", "2:11: expected ')' before ';'\n2:5: note: to match this '('"},
                {"a = f(1, 2;", "2:11: expected ')' before ';'\n2:6: note: to match this '('"},
                {"a = f(1, );", "2:10: expected an expression before ')'"},
                {"a = b[1;", "2:8: expected ']' before ';'\n2:6: note: to match this '['"},
                {"a = b * / c;", "2:9: expected an expression before '/'"},
                {"a = b ? c;", "2:10: expected ':' before ';'\n2:7: note: to match this '?'"},
                {"1 = a;", "2:3: only a variable or an element of an array can be assigned"},
                {"f(a) = 1;", "2:6: only a variable or an element of an array can be assigned"},
                {"a = i++ < 3;", "2:6: RSL has no '++'; '+= 1' does the same"},
                {"a = 2--;", "2:6: only a variable or an element of an array can be assigned"},
                {"a[i++] += 1;", "2:8: the index before '+=' changes a variable; do that before"},
                {"a[b = 1]++;", "2:9: the index before '+' changes a variable; do that before"},
                {"a = {1, 2;", "2:10: expected '}' before ';'\n2:5: note: to match this '{'"},
                {"a = color \"hsv\";", ""}});
}

TEST(Errors, OfRsl2AreOneEach) {
  const auto said = [](const char* what) {
    return std::string(what) + " is of RSL 2, of which only classes that stand alone are supported";
  };
  const auto messages = [](const char* text) { return messagesOf(Front(text).parsed()); };
  EXPECT_EQ(messages("class a(float x = 1) { public float f() { return x; } }"),
            said("1:1: a class that is no surface, displacement, light or volume by its methods"));
  EXPECT_EQ(messages("class a() { public void surface(output color Ci, Oi; float x) {} }"),
            "1:25: the renderer calls 'surface' with Ci and Oi alone");
  EXPECT_EQ(messages("class a() { public void surface(output color Ci; output float o) {} }"),
            "1:25: the renderer gives Oi to 'surface', a color, but this is a float");
  EXPECT_EQ(messages("class a() { public void surface() {} public void surface(output color Ci) {} }"),
            "1:50: the renderer calls one 'surface' alone");
  EXPECT_EQ(messages("class (float x = 1) {}"), "1:7: expected the name of a class before '('");
  EXPECT_EQ(messages("class a() { public void opacity(output color Oi) {} }"),
            said("1:1: a class that is no surface, displacement, light or volume by its methods"));
  EXPECT_EQ(messages("class a() { public void displacement(output point P; output normal N) {}\n"
                     "public void surface(output color Ci, Oi) { x = ; } }"),
            "2:48: expected an expression before ';'")
      << "once";
  EXPECT_EQ(messages("struct a { float b; }\nsurface c() {}"), said("1:1: 'struct'"));
  EXPECT_EQ(messages("surface a(shader b[] = {}) { }"), said("1:11: 'shader'"));
  EXPECT_EQ(messages("surface a() { shader b = getshader(\"c\"); b->d(); }"), said("1:15: 'shader'"));
  EXPECT_EQ(messages("surface a() { b->c(); d->e(); }"), said("1:16: '->'"));
  EXPECT_EQ(messages("public float f() {}"), said("1:1: 'public'"));
}

TEST(Errors, AreFoundInSeveralPlaces) {
  expectErrors(
      {{"surface a() {\n  b = ;\n  c = (1, 2);\n  if (x { y = 1; }\n  d = 1;\n}\nsurface e( {}\nsurfac f() {}\nlight "
        "g() { h = ]; }",
        "2:7: expected an expression before ';'\n"
        "3:7: 2 values in brackets; a triple has 3, and a matrix 16\n"
        "4:9: expected ')' before '{'\n"
        "4:6: note: to match this '('\n"
        "7:12: expected the type of a parameter before '{'\n"
        "8:1: expected a shader or a function before 'surfac'; did you mean 'surface'?\n"
        "9:17: expected an expression before ']'"}});
}

TEST(Errors, KeepWhatIsRightAroundThem) {
  Front front("float f() { a = ; return 1; }\nsurface b() { c = ; d = 1; }\nlight e( {}\nvolume g() {}");
  front.parsed();
  EXPECT_EQ(dump(front.file),
            "function float f\n  block\n    return\n      number 1\n"
            "surface b\n  block\n    expression\n      assign =\n        name d\n        number 1\n"
            "volume g\n  block\n");
}

TEST(Errors, EndAtTheMost) {
  std::string text = "surface a() {\n";
  for (int i = 0; i < 1000; ++i) text += "b = ;\n";
  EXPECT_EQ(Front(text + "}").parsed().messages.errorCount(), Messages::kMostErrors);
}

TEST(Errors, OfNestingAreOne) {
  for (const char* text : {"(", "{", "[", "if(a)", "f(", "float ", "-", "a=", "a?b:", "a?", "float f(){", "else ",
                           "for(;;)", "{;", "a[b"}) {
    std::string all = "surface x() {";
    for (int i = 0; i < 10000; ++i) all += text;
    Front front(all);
    front.parsed();
    EXPECT_TRUE(front.messages.hasErrors()) << text;
    EXPECT_LE(front.messages.errorCount(), Messages::kMostErrors) << text;
  }
}

}  // namespace
}  // namespace tomales::compiler
