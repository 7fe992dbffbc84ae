#include <fmt/format.h>

#include <algorithm>

#include "reyes/rsl/parse/parser.h"
#include "reyes/rsl/quote.h"

namespace tomales::compiler {
namespace {

int32_t lengthOf(const Token& t) { return static_cast<int32_t>(t.text.size()) + (t.kind == TokenKind::String ? 2 : 0); }

std::string described(const Token& t) {
  if (t.kind == TokenKind::End) return "the end of the file";
  if (t.kind == TokenKind::String) return "the string " + inQuotes(t.text);
  return inQuotes(t.text);
}

bool isOpening(const Token& t) { return t.is("(") || t.is("{") || t.is("["); }
bool isClosing(const Token& t) { return t.is(")") || t.is("}") || t.is("]"); }

}  // namespace

const Token& Parser::take() {
  const Token& t = here();
  if (!atEnd()) ++at_;
  return t;
}

bool Parser::takeIf(std::string_view punctuator) {
  const bool there = here().is(punctuator);
  if (there) ++at_;
  return there;
}

void Parser::deeper() {
  if (++depth_ <= kMostNesting) return;
  error(here(), fmt::format("nested more than {} levels deep", kMostNesting));
  throw GaveUp{};
}

void Parser::error(const Token& token, std::string text) {
  messages_.error(token.place, std::move(text), lengthOf(token));
  if (messages_.errorCount() >= Messages::kMostErrors) throw GaveUp{};
}

void Parser::failAt(const Token& token, std::string text) {
  error(token, std::move(text));
  throw Failed{};
}

/// If the token begins a line, the error is placed at the end of the previous line.
void Parser::fail(std::string text, const std::vector<std::string>& known) {
  const Token& t = here();
  if (t.kind == TokenKind::Name && (t.text == "class" || t.text == "struct")) refuseRsl2(t, inQuotes(t.text));
  if (t.is("->")) refuseRsl2(t, "'->'");
  if (t.is("&") || t.is("|")) failAt(t, fmt::format("RSL has no '{0}'; '{0}{0}' joins conditions", t.text));
  if (t.is("%")) failAt(t, "RSL has no '%'; mod(x, y) is the remainder");
  if (t.is("*") && at_ > 0 && tokens_[at_ - 1].is("*")) failAt(t, "RSL has no '**'; pow(x, y) is the power");
  text += " before " + described(t);
  const std::vector<std::string> near =
      t.kind == TokenKind::Name ? nearNames(t.text, known) : std::vector<std::string>();
  if (!near.empty()) text += "; did you mean '" + near[0] + "'?";
  const Token* before = at_ > 0 ? &tokens_[at_ - 1] : nullptr;
  const bool isLineBefore = before && before->place.file == t.place.file && before->place.line != t.place.line &&
                            before->place.expansion < 0 && t.place.expansion < 0;
  if (!isLineBefore || !near.empty()) failAt(t, std::move(text));
  Place behind = before->place;
  behind.column += lengthOf(*before);
  messages_.error(behind, std::move(text));
  if (messages_.errorCount() >= Messages::kMostErrors) throw GaveUp{};
  throw Failed{};
}

void Parser::expect(std::string_view punctuator) {
  if (!takeIf(punctuator)) fail(fmt::format("expected '{}'", punctuator));
}

void Parser::expectClosing(std::string_view punctuator, const Token& open) {
  if (takeIf(punctuator)) return;
  try {
    fail(fmt::format("expected '{}'", punctuator));
  } catch (const Failed&) {
    messages_.note(open.place, fmt::format("to match this '{}'", open.text));
    throw;
  }
}

const Token& Parser::expectName(std::string_view what) {
  if (here().kind != TokenKind::Name) fail(fmt::format("expected {}", what));
  return take();
}

/// Returns the index behind the bracket that closes the one at `index`; that of the last token if none does.
size_t Parser::behindBracket(size_t index) const {
  int open = 0;
  for (; index + 1 < tokens_.size(); ++index) {
    if (isOpening(tokens_[index])) ++open;
    if (isClosing(tokens_[index]) && --open <= 0) return index + 1;
  }
  return index;
}

/// Skips to behind the next ';' or '}' block that belongs to the statement, or to the '}' around it.
void Parser::skipStatement() {
  while (!atEnd() && !here().is("}")) {
    if (here().is("{")) {
      at_ = behindBracket(at_);
      return;
    }
    if (take().is(";")) return;
  }
}

/// Skips to what looks like the beginning of a shader or of a function, outside of braces.
void Parser::skipDefinition() {
  while (!atEnd()) {
    if (here().is("{")) {
      at_ = behindBracket(at_);
      return;
    }
    if (here().kind == TokenKind::Name && shaderKindNamed(here().text) && here(1).kind == TokenKind::Name &&
        here(2).is("("))
      return;
    ++at_;
  }
}

bool Parser::isRsl2(bool atFileLevel) const {
  const Token& t = here();
  if (t.kind != TokenKind::Name || here(1).kind != TokenKind::Name) return false;
  constexpr std::string_view kAnywhere[] = {"shader"};
  constexpr std::string_view kOfFiles[] = {"struct", "public", "private", "constant"};
  return std::ranges::find(kAnywhere, t.text) != std::end(kAnywhere) ||
         (atFileLevel && std::ranges::find(kOfFiles, t.text) != std::end(kOfFiles));
}

void Parser::refuseRsl2(const Token& token, std::string_view what) {
  error(token, fmt::format("{} is of RSL 2, of which only classes that stand alone are supported", what));
  throw GaveUp{};
}

}  // namespace tomales::compiler
