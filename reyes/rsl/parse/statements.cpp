#include <fmt/format.h>

#include <map>

#include "reyes/rsl/parse/parser.h"
#include "reyes/rsl/quote.h"

namespace tomales::compiler {
namespace {

StmtPtr begin(StmtKind kind, const Token& token) {
  auto s = std::make_unique<Stmt>();
  s->kind = kind;
  s->place = token.place;
  return s;
}

}  // namespace

StmtPtr Parser::block() {
  if (!here().is("{")) fail("expected '{'");
  const Token& open = take();
  StmtPtr out = begin(StmtKind::Block, open);
  while (!here().is("}") && !atEnd()) statementInto(out->body);
  expectClosing("}", open);
  return out;
}

/// Reads a statement. After an error it continues behind the statement.
void Parser::statementInto(std::vector<StmtPtr>& out) {
  const size_t before = at_;
  try {
    out.push_back(statement());
  } catch (const Failed&) {
    if (at_ == before) ++at_;
    skipStatement();
  }
}

StmtPtr Parser::statement() {
  const Level level(*this);
  const Token& t = here();
  if (t.is("{")) return block();
  if (t.is(";")) return begin(StmtKind::Empty, take());
  if (t.kind != TokenKind::Name) return expressionStatement();
  if (isRsl2(false)) refuseRsl2(t, inQuotes(t.text));
  if (t.text == "if") return ifStatement();
  if (t.text == "while") return whileStatement();
  if (t.text == "for") return forStatement();
  if (t.text == "break") return levels(StmtKind::Break);
  if (t.text == "continue") return levels(StmtKind::Continue);
  if (t.text == "return") return returnStatement();
  if (t.text == "else") failAt(t, "'else' without an 'if' before it");
  if (t.text == "do" && here(1).is("{")) failAt(t, "RSL has no 'do' loop, only 'while' and 'for'");
  if (t.text == "switch" && here(1).is("(")) failAt(t, "RSL has no 'switch', only 'if' and 'else'");
  if (baseNamed(t.text) && here(1).is("["))
    failAt(here(1), fmt::format("the length of an array stands behind its name: '{} x[3]'", t.text));
  if (here(1).is("(")) {
    if (t.text == "illuminance") return lightStatement(StmtKind::Illuminance);
    if (t.text == "illuminate") return lightStatement(StmtKind::Illuminate);
    if (t.text == "solar") return lightStatement(StmtKind::Solar);
    if (t.text == "gather") return lightStatement(StmtKind::Gather);
  }
  if (beginsSpecifiers() || isFunctionHere()) return declaration();
  if (here(1).kind == TokenKind::Name && !baseNamed(t.text)) failNoStatement();
  return expressionStatement();
}

/// Fails on two adjacent words, of which the first cannot begin a statement.
void Parser::failNoStatement() {
  static const std::map<std::string_view, const char*> kOfOtherLanguages{
      {"int", "RSL has no 'int': every number is a 'float'"},
      {"double", "RSL has no 'double': every number is a 'float'"},
      {"half", "RSL has no 'half': every number is a 'float'"},
      {"bool", "RSL has no 'bool': 'float' holds 1 or 0"},
      {"const", "RSL has no 'const'; a name for a value that stays is made by '#define'"},
      {"then", "an 'if' has no 'then': the statement follows the brackets"}};
  const Token& t = here();
  if (const auto it = kOfOtherLanguages.find(t.text); it != kOfOtherLanguages.end()) failAt(t, it->second);
  std::vector<std::string> known = typeNames();
  known.insert(known.end(), {name(Base::Void), "extern", "uniform", "varying", "output", "return"});
  const std::vector<std::string> near = nearNames(t.text, known);
  failAt(t, inQuotes(t.text) + " is no type" + (near.empty() ? "" : "; did you mean '" + near[0] + "'?"));
}

StmtPtr Parser::declaration() {
  StmtPtr out = begin(StmtKind::Declare, here());
  const Specifiers s = specifiers();
  if (here().kind == TokenKind::Name && here(1).is("(")) {
    out->kind = StmtKind::Define;
    out->function = function(s);
    return out;
  }
  do {
    out->variables.push_back(variable(s));
  } while (takeIf(","));
  expect(";");
  return out;
}

void Parser::bracketed(Stmt& out) {
  if (!here().is("(")) fail("expected '('");
  const Token& open = take();
  out.exprs.push_back(expression());
  expectClosing(")", open);
}

StmtPtr Parser::ifStatement() {
  StmtPtr out = begin(StmtKind::If, take());
  bracketed(*out);
  out->body.push_back(statement());
  if (here().isName("else")) {
    take();
    out->body.push_back(statement());
  }
  return out;
}

StmtPtr Parser::whileStatement() {
  StmtPtr out = begin(StmtKind::While, take());
  bracketed(*out);
  out->body.push_back(statement());
  return out;
}

/// A variable that is declared in the brackets, as in C++, belongs to a block around the loop.
StmtPtr Parser::forStatement() {
  StmtPtr out = begin(StmtKind::For, take());
  if (!here().is("(")) fail("expected '('");
  const Token& open = take();
  StmtPtr around;
  if (beginsSpecifiers()) {
    around = begin(StmtKind::Block, open);
    around->body.push_back(declaration());
    out->exprs.push_back(nullptr);
  } else {
    out->exprs.push_back(here().is(";") ? nullptr : expression());
    expect(";");
  }
  out->exprs.push_back(here().is(";") ? nullptr : expression());
  expect(";");
  out->exprs.push_back(here().is(")") ? nullptr : expression());
  expectClosing(")", open);
  out->body.push_back(statement());
  if (!around) return out;
  around->body.push_back(std::move(out));
  return around;
}

StmtPtr Parser::levels(StmtKind kind) {
  const Token& word = take();
  StmtPtr out = begin(kind, word);
  if (here().kind == TokenKind::Number) {
    const Token& count = take();
    if (!(count.number >= 1 && count.number <= kMostNesting &&
          count.number == static_cast<float>(static_cast<int>(count.number))))
      failAt(count, fmt::format("'{}' leaves a whole number of loops, at least 1", word.text));
    out->count = static_cast<int32_t>(count.number);
  }
  expect(";");
  return out;
}

StmtPtr Parser::returnStatement() {
  StmtPtr out = begin(StmtKind::Return, take());
  out->exprs.push_back(here().is(";") ? nullptr : expression());
  expect(";");
  return out;
}

StmtPtr Parser::lightStatement(StmtKind kind) {
  StmtPtr out = begin(kind, take());
  const Token& open = take();
  if (!here().is(")")) list(out->exprs);
  expectClosing(")", open);
  out->body.push_back(statement());
  if (kind == StmtKind::Gather && here().isName("else")) {
    take();
    out->body.push_back(statement());
  }
  return out;
}

StmtPtr Parser::expressionStatement() {
  const Token& word = here();
  StmtPtr out = begin(StmtKind::Expression, word);
  out->exprs.push_back(expression());
  // A word and brackets before a '{' look like "while (...) {".
  if (here().is("{") && out->exprs[0]->kind == ExprKind::Call) {
    static const std::vector<std::string> kKnown{"if", "while", "for", "illuminance", "illuminate", "solar", "gather"};
    const std::vector<std::string> near = nearNames(out->exprs[0]->text, kKnown);
    if (!near.empty())
      failAt(word, fmt::format("{} begins no statement; did you mean '{}'?", inQuotes(word.text), near[0]));
  }
  expect(";");
  return out;
}

}  // namespace tomales::compiler
