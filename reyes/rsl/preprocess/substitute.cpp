#include "reyes/rsl/preprocess/macros.h"
#include "reyes/rsl/quote.h"

namespace tomales::compiler {
namespace {

class Substitution {
 public:
  Substitution(const Macro& macro, const std::vector<MacroArgument>& arguments, int32_t expansion, MadeTexts& made,
               Messages& messages)
      : macro_(macro), arguments_(arguments), expansion_(expansion), made_(made), messages_(messages) {}

  std::vector<Lexeme> run() {
    out_.reserve(macro_.pieces.size());
    for (size_t i = 0; i < macro_.pieces.size() && !made_.isFull(); ++i) add(i);
    std::erase_if(out_, [](const Lexeme& l) { return l.kind == LexemeKind::Nothing; });
    return std::move(out_);
  }

 private:
  void add(size_t i) {
    const MacroPiece& piece = macro_.pieces[i];
    const bool isPasteOperand = piece.pasted || (i + 1 < macro_.pieces.size() && macro_.pieces[i + 1].pasted);
    Lexeme own = piece.lexeme;
    own.place.expansion = expansion_;
    if (piece.stringify) {
      own.kind = LexemeKind::String;
      own.text = stringified(argument(piece).written);
      addOne(own, piece.pasted);
    } else if (piece.parameter < 0) {
      addOne(own, piece.pasted);
    } else {
      const std::vector<Lexeme>& all = isPasteOperand ? argument(piece).written : argument(piece).expanded;
      own.kind = LexemeKind::Nothing;
      own.text = {};
      if (all.empty() && isPasteOperand) addOne(own, piece.pasted);
      for (size_t k = 0; k < all.size(); ++k) {
        Lexeme l = all[k];
        if (k == 0) l.spaceBefore = own.spaceBefore;
        addOne(l, piece.pasted && k == 0);
      }
    }
  }

  const MacroArgument& argument(const MacroPiece& piece) const {
    return arguments_[static_cast<size_t>(piece.parameter)];
  }

  void addOne(Lexeme lexeme, bool pasted) {
    lexeme.startsLine = false;
    if (!pasted || out_.empty() || !paste(out_.back(), lexeme)) out_.push_back(lexeme);
  }

  /// Sets `left` to the word of both texts together. Returns false if that is not one word.
  bool paste(Lexeme& left, const Lexeme& right) {
    if (right.kind == LexemeKind::Nothing) return true;
    if (left.kind == LexemeKind::Nothing) {
      left = right;
      return true;
    }
    const std::string_view both = made_.keep(std::string(left.text) + std::string(right.text));
    Messages unheard;
    Lexer lexer(-1, both, made_, unheard);
    const Lexeme word = lexer.next();
    if (word.isEnd() || !lexer.next().isEnd() || unheard.hasErrors()) {
      messages_.error(left.place, "'##' makes " + inQuotes(both) + ", which is not one word");
      return false;
    }
    left.kind = word.kind;
    left.isOpen = word.isOpen;
    left.isFinal = false;
    left.text = both;
    return true;
  }

  std::string_view stringified(const std::vector<Lexeme>& lexemes) {
    std::string text = "\"";
    for (const Lexeme& l : lexemes) {
      if (text.size() > MadeTexts::kMostBytes) break;
      if (l.spaceBefore && text.size() > 1) text += ' ';
      const bool isQuoted = l.kind == LexemeKind::String || l.kind == LexemeKind::Character;
      for (const char c : l.text) {
        if (isQuoted && (c == '"' || c == '\\')) text += '\\';
        text += c;
      }
    }
    return made_.keep(text + '"');
  }

  const Macro& macro_;
  const std::vector<MacroArgument>& arguments_;
  int32_t expansion_;
  MadeTexts& made_;
  Messages& messages_;
  std::vector<Lexeme> out_;
};

}  // namespace

std::vector<Lexeme> substitute(const Macro& macro, const std::vector<MacroArgument>& arguments, int32_t expansion,
                               MadeTexts& made, Messages& messages) {
  return Substitution(macro, arguments, expansion, made, messages).run();
}

}  // namespace tomales::compiler
