#include <fmt/format.h>

#include "reyes/rsl/preprocess/preprocessor.h"
#include "reyes/rsl/quote.h"

namespace tomales::compiler {
namespace {

constexpr int kMostMacroNesting = 200;

}  // namespace

/// Puts a macro's replacement before the next lexeme. Returns false if the macro takes arguments and none follow.
bool Preprocessor::enter(const Lexeme& name, Macro& macro) {
  const MacroPtr kept = macros_.share(macro.name);  // A directive among the arguments may remove it.
  std::vector<MacroArgument> arguments;
  if (macro.takesArguments) {
    const Lexeme open = read();
    if (!open.is("(")) {
      putBack(open);
      return false;
    }
    if (!readArguments(name, macro, arguments)) return true;
  }
  if (++expansions_ > kMostExpansions) {
    stop(name.place, fmt::format("more than {} uses of macros", kMostExpansions));
    return true;
  }
  size_t size = macro.pieces.size() + macro.name.size() / 32;  // Long names cost memory too.
  for (const MacroPiece& piece : macro.pieces)
    if (piece.parameter >= 0) size += arguments[static_cast<size_t>(piece.parameter)].expanded.size();
  if (!account(name.place, size)) return true;
  const int32_t expansion = sources_.addExpansion({macro.name, name.place});
  std::vector<Lexeme> lexemes = substitute(macro, arguments, expansion, made_, messages_);
  if (made_.isFull())
    stop(name.place, fmt::format("macros make more than {} MiB of text", MadeTexts::kMostBytes >> 20));
  if (!lexemes.empty()) lexemes.front().spaceBefore = name.spaceBefore;
  ++macro.active;
  rows_.push_back({.lexemes = std::move(lexemes), .macro = kept});
  return true;
}

bool Preprocessor::account(Place place, size_t lexemes) {
  work_ += lexemes;
  if (work_ > kMostTokens) stop(place, fmt::format("macros make more than {} words", kMostTokens));
  return !stopped_;
}

bool Preprocessor::readArguments(const Lexeme& name, const Macro& macro, std::vector<MacroArgument>& arguments) {
  int depth = 1;
  while (depth > 0) {
    const bool isRest = macro.isVariadic && arguments.size() + 1 == macro.parameters.size();
    MacroArgument argument;
    if (!readArgument(name, isRest, depth, argument.written)) return false;
    arguments.push_back(std::move(argument));
  }
  if (!fits(name, macro, arguments)) return false;
  if (++nesting_ > kMostMacroNesting) {
    stop(name.place, fmt::format("more than {} macros are nested in each other's arguments", kMostMacroNesting));
    return false;
  }
  for (MacroArgument& a : arguments) a.expanded = expanded(a.written);
  --nesting_;
  return !stopped_;
}

/// Reads an argument, to the ',' or ')' after it.
bool Preprocessor::readArgument(const Lexeme& name, bool isRest, int& depth, std::vector<Lexeme>& out) {
  for (;;) {
    Lexeme l = read();
    if (l.isEnd()) {
      if (!stopped_)
        messages_.error(name.place, "the arguments of macro " + inQuotes(name.text) + " are not closed", name.length());
      return false;
    }
    if (l.is("(")) ++depth;
    if (l.is(")") && --depth == 0) return true;
    if (l.is(",") && depth == 1 && !isRest) return true;
    if (!account(name.place, 1)) return false;
    l.spaceBefore = l.spaceBefore || l.startsLine;
    if (l.kind == LexemeKind::Name && !l.isFinal) {
      const Macro* macro = macros_.find(l.text);
      l.isFinal = macro && macro->active > 0;
    }
    out.push_back(l);
  }
}

/// Tells whether there are as many arguments as parameters. "()" is one empty argument or none.
bool Preprocessor::fits(const Lexeme& name, const Macro& macro, std::vector<MacroArgument>& arguments) {
  if (macro.parameters.empty() && arguments.size() == 1 && arguments[0].written.empty()) arguments.clear();
  if (macro.isVariadic && arguments.size() + 1 == macro.parameters.size()) arguments.emplace_back();
  if (arguments.size() == macro.parameters.size()) return true;
  messages_.error(
      name.place,
      fmt::format("macro {} takes {} argument{}, and {} {} given", inQuotes(macro.name), macro.parameters.size(),
                  macro.parameters.size() == 1 ? "" : "s", arguments.size(), arguments.size() == 1 ? "is" : "are"),
      name.length());
  if (macro.place.line > 0) messages_.note(macro.place, "it is defined here");
  return false;
}

/// Replaces the macros in an argument, as if nothing followed it.
std::vector<Lexeme> Preprocessor::expanded(std::vector<Lexeme> lexemes) {
  const size_t below = rows_.size();
  rows_.push_back({.lexemes = std::move(lexemes), .isArgument = true});
  std::vector<Lexeme> out;
  for (Lexeme l = next(); !l.isEnd() && !stopped_; l = next()) out.push_back(l);
  rows_.resize(std::min(rows_.size(), below));
  return out;
}

Lexeme Preprocessor::ownValue(const Lexeme& name, const Macro& macro) {
  Lexeme out = name;
  const Place place = sources_.outermost(name.place);
  if (macro.kind == Macro::Kind::Line) {
    out.kind = LexemeKind::Number;
    out.text = made_.keep(std::to_string(place.line));
  } else {
    std::string text = "\"";
    for (const char c : sources_.file(place.file).path)
      text += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
    out.kind = LexemeKind::String;
    out.text = made_.keep(text + '"');
  }
  return out;
}

}  // namespace tomales::compiler
