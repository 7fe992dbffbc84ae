#include <fmt/format.h>

#include <cmath>

#include "reyes/rsl/parse/parser.h"
#include "reyes/rsl/quote.h"

namespace tomales::compiler {
namespace {

constexpr int32_t kMostElements = 1 << 20;

/// Tells whether the word is a modifier of class members. None of these changes the results.
bool isOfMembers(std::string_view word) { return word == "public" || word == "private" || word == "constant"; }

bool isSpecifier(std::string_view word) {
  return word == "uniform" || word == "varying" || word == "extern" || word == "output" || isOfMembers(word);
}

/// Returns the first sentence of a comment, without the characters that draw its frame.
std::string firstSentence(const std::string& comment) {
  std::string out;
  for (size_t i = 0; i < comment.size(); ++i) {
    const char c = comment[i];
    const bool isFrame = c == '/' || c == '*' || static_cast<unsigned char>(c) <= ' ';
    if (!isFrame) out += c;
    if (isFrame && !out.empty() && out.back() != ' ') out += ' ';
    if (c == '.' && (i + 1 == comment.size() || static_cast<unsigned char>(comment[i + 1]) <= ' ')) break;
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

}  // namespace

File Parser::run() {
  File file;
  try {
    while (!atEnd()) {
      const size_t before = at_;
      try {
        definition(file);
      } catch (const Failed&) {
        if (at_ == before) ++at_;
        skipDefinition();
      }
    }
  } catch (const GaveUp&) {
  }
  return file;
}

void Parser::definition(File& file) {
  const Token& t = here();
  if (takeIf(";")) return;
  if (t.isName("class")) {
    take();
    if (here().kind != TokenKind::Name) fail("expected the name of a class");
    return classShaders(file, t, t.comment ? firstSentence(*t.comment) : std::string());
  }
  if (isRsl2(true)) refuseRsl2(t, inQuotes(t.text));
  const auto kind = t.kind == TokenKind::Name ? shaderKindNamed(t.text) : std::nullopt;
  if (kind) {
    take();
    if (here().kind != TokenKind::Name) fail("expected the name of a shader");
    file.shaders.push_back(shader(*kind, t.comment ? firstSentence(*t.comment) : std::string()));
  } else if (beginsSpecifiers() || isFunctionHere()) {
    const Specifiers s = specifiers();
    if (s.any && !s.hasType) fail("expected a type");
    if (!here(1).is("(")) {
      expectName("the name of a function");
      fail("expected '('");
    }
    file.functions.push_back(function(s));
  } else {
    failNoDefinition();
  }
}

void Parser::failNoDefinition() {
  std::vector<std::string> known = shaderKindNames();
  known.insert(known.end(), typeNames().begin(), typeNames().end());
  known.emplace_back(name(Base::Void));
  fail("expected a shader or a function", known);
}

std::unique_ptr<Shader> Parser::shader(ShaderKind kind, std::string doc) {
  auto out = std::make_unique<Shader>();
  out->kind = kind;
  out->doc = std::move(doc);
  const Token& word = take();
  out->name = word.text;
  out->place = word.place;
  parameters(out->parameters);
  out->body = block();
  return out;
}

std::unique_ptr<Function> Parser::function(const Specifiers& s) {
  const Level level(*this);
  auto out = std::make_unique<Function>();
  const Token& word = take();
  out->name = word.text;
  out->place = word.place;
  out->result = s.type;
  parameters(out->parameters);
  out->body = block();
  return out;
}

bool Parser::beginsSpecifiers() const {
  const Token& t = here();
  if (t.kind != TokenKind::Name) return false;
  if (isSpecifier(t.text)) return here(1).kind == TokenKind::Name;
  if (!baseNamed(t.text) || here(1).kind != TokenKind::Name) return false;
  // "float f(x);" is a cast of a call, "float f(x) {" a function.
  return !here(2).is("(") || tokens_[behindBracket(at_ + 2)].is("{");
}

/// "f(float x) {" or "f() {": a function without a written type.
bool Parser::isFunctionHere() const {
  if (here().kind != TokenKind::Name || !here(1).is("(")) return false;
  const Token& first = here(2);
  const bool isParameter = first.kind == TokenKind::Name && (isSpecifier(first.text) || baseNamed(first.text));
  return (isParameter || first.is(")")) && tokens_[behindBracket(at_ + 1)].is("{");
}

Parser::Specifiers Parser::specifiers() {
  Specifiers s;
  for (;; s.any = true) {
    const Token& t = here();
    if (t.kind != TokenKind::Name || here(1).is("(")) return s;
    if (t.text == "uniform" || t.text == "varying") {
      s.detail = t.text == "uniform" ? Detail::Uniform : Detail::Varying;
    } else if (t.text == "output") {
      s.output = true;
    } else if (t.text == "extern") {
      s.isExtern = true;
    } else if (isOfMembers(t.text)) {
      // nothing to keep
    } else if (const auto base = baseNamed(t.text); base && !s.hasType) {
      s.type.base = *base;
      s.hasType = true;
    } else {
      return s;
    }
    take();
  }
}

/// ( [output] [detail] type name [= value] {, name ...} {; ...} )
void Parser::parameters(std::vector<std::unique_ptr<Variable>>& out) {
  if (!here().is("(")) fail("expected '('");
  const Token& open = take();
  Specifiers s;
  while (!here().is(")")) {
    if (takeIf(";") || takeIf(",")) continue;
    if (isRsl2(false)) refuseRsl2(here(), inQuotes(here().text));
    if (const Specifiers own = specifiers(); own.any) s = own;
    if (!s.hasType) {
      std::vector<std::string> known = typeNames();
      known.insert(known.end(), {"uniform", "varying", "output"});
      fail("expected the type of a parameter", known);
    }
    out.push_back(variable(s));
    if (!here().is(";") && !here().is(",")) break;
  }
  expectClosing(")", open);
}

std::unique_ptr<Variable> Parser::variable(const Specifiers& s) {
  if (!s.hasType) fail("expected a type");
  auto out = std::make_unique<Variable>();
  const Token& word = expectName("a name");
  out->name = word.text;
  out->place = word.place;
  out->type = s.type;
  out->detail = s.detail;
  out->output = s.output;
  out->isExtern = s.isExtern;
  if (here().is("[")) out->type.length = arrayLength();
  if (takeIf("=")) out->initial = assignment();
  return out;
}

int32_t Parser::arrayLength() {
  const Token& open = take();
  int32_t length = kOpenArray;
  if (!here().is("]")) {
    const Token& t = here();
    if (t.kind != TokenKind::Number && !t.is("(") && !t.is("-")) fail("expected the length of the array, a number,");
    const std::optional<float> number = constantOf(*expression());
    if (!number || !(*number >= 1 && *number <= static_cast<float>(kMostElements) && *number == std::floor(*number)))
      failAt(t, fmt::format("the length of an array is a whole number from 1 to {}", kMostElements));
    length = static_cast<int32_t>(*number);
  }
  expectClosing("]", open);
  return length;
}

File parse(const std::vector<Token>& tokens, Messages& messages) {
  static const std::vector<Token> kNone(1);
  return Parser(tokens.empty() ? kNone : tokens, messages).run();
}

}  // namespace tomales::compiler
