#include "reyes/rsl/preprocess/macros.h"

#include <algorithm>

#include "reyes/rsl/quote.h"

namespace tomales::compiler {
namespace {

constexpr std::string_view kVariadicName = "__VA_ARGS__";

class DefinitionReader {
 public:
  DefinitionReader(Lexer& lexer, Messages& messages) : lexer_(lexer), messages_(messages) {}

  MacroPtr read(Place directive) { return readAll(directive) ? macro_ : nullptr; }

 private:
  bool fail(Place place, std::string text) {
    messages_.error(place, std::move(text));
    return false;
  }

  bool readAll(Place directive) {
    const Lexeme name = lexer_.nextInLine();
    if (name.kind != LexemeKind::Name) return fail(name.isEnd() ? directive : name.place, "'#define' needs a name");
    if (name.text == "defined") return fail(name.place, "'defined' cannot be a macro");
    macro_->name = name.text;
    macro_->place = name.place;
    Lexeme l = lexer_.nextInLine();
    if (l.is("(") && !l.spaceBefore) {
      macro_->takesArguments = true;
      if (!readParameters(l.place)) return false;
      l = lexer_.nextInLine();
    }
    return readPieces(l);
  }

  bool readParameters(Place open) {
    Lexeme l = lexer_.nextInLine();
    if (l.is(")")) return true;
    for (;; l = lexer_.nextInLine()) {
      if (!readParameter(l)) return false;
      l = lexer_.nextInLine();
      if (l.is("...") && !macro_->isVariadic) {
        macro_->isVariadic = true;
        l = lexer_.nextInLine();
      }
      if (l.is(")")) return true;
      if (!l.is(",") || macro_->isVariadic) break;
    }
    fail(l.place, "expected ')' after the parameters of macro " + inQuotes(macro_->name));
    messages_.note(open, "to match this '('");
    return false;
  }

  bool readParameter(const Lexeme& l) {
    macro_->isVariadic = l.is("...");
    if (!macro_->isVariadic && l.kind != LexemeKind::Name)
      return fail(l.place, "expected the name of a parameter of macro " + inQuotes(macro_->name));
    std::string name(macro_->isVariadic ? kVariadicName : l.text);
    if (parameterNamed(name) >= 0)
      return fail(l.place, "macro " + inQuotes(macro_->name) + " has two parameters " + inQuotes(name));
    indices_.emplace(name, static_cast<int>(macro_->parameters.size()));
    macro_->parameters.push_back(std::move(name));
    return true;
  }

  int parameterNamed(std::string_view name) const {
    const auto found = indices_.find(std::string(name));
    return found == indices_.end() ? -1 : found->second;
  }

  bool readPieces(Lexeme l) {
    bool pasted = false;
    for (; !l.isEnd(); l = lexer_.nextInLine()) {
      if (l.is("##")) {
        if (macro_->pieces.empty()) return fail(l.place, "'##' has nothing before it");
        paste_ = l.place;
        pasted = true;
        continue;
      }
      MacroPiece piece{.lexeme = l, .pasted = pasted};
      pasted = false;
      if (l.is("#") && macro_->takesArguments) {
        const Lexeme parameter = lexer_.nextInLine();
        piece.stringify = true;
        piece.parameter = parameter.kind == LexemeKind::Name ? parameterNamed(parameter.text) : -1;
        if (piece.parameter < 0) return fail(l.place, "'#' is not followed by a parameter of the macro");
      } else if (l.kind == LexemeKind::Name && macro_->takesArguments) {
        piece.parameter = parameterNamed(l.text);
      }
      macro_->pieces.push_back(piece);
    }
    if (pasted) return fail(paste_, "'##' has nothing after it");
    return true;
  }

  Lexer& lexer_;
  Messages& messages_;
  MacroPtr macro_ = std::make_shared<Macro>();
  std::unordered_map<std::string, int> indices_;
  Place paste_{};
};

bool isSamePiece(const MacroPiece& a, const MacroPiece& b) {
  return a.lexeme.text == b.lexeme.text && a.parameter == b.parameter && a.stringify == b.stringify &&
         a.pasted == b.pasted;
}

}  // namespace

MacroPtr readDefinition(Lexer& lexer, Place directive, Messages& messages) {
  return DefinitionReader(lexer, messages).read(directive);
}

bool isSame(const Macro& a, const Macro& b) {
  return a.kind == b.kind && a.takesArguments == b.takesArguments && a.isVariadic == b.isVariadic &&
         a.parameters == b.parameters && std::ranges::equal(a.pieces, b.pieces, isSamePiece);
}

MacroTable::MacroTable() {
  for (const auto& [name, kind] : {std::pair{"__LINE__", Macro::Kind::Line}, {"__FILE__", Macro::Kind::File}}) {
    const MacroPtr macro = std::make_shared<Macro>();
    macro->kind = kind;
    macro->name = name;
    macros_[macro->name] = macro;
  }
}

void MacroTable::define(const MacroPtr& macro, Messages& messages) {
  if (const Macro* before = find(macro->name)) {
    if (!isSame(*before, *macro)) {
      messages.warning(macro->place, "macro " + inQuotes(macro->name) + " is defined anew",
                       static_cast<int32_t>(macro->name.size()));
      if (before->place.line > 0) messages.note(before->place, "the definition before is here");
    }
    macros_.erase(macro->name);
  }
  macros_[macro->name] = macro;
}

}  // namespace tomales::compiler
