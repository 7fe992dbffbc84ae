// Definitions of macros, and what one use of a macro is replaced by (C90 6.8.3).
#pragma once
#include <memory>
#include <unordered_map>
#include <vector>

#include "reyes/rsl/preprocess/lexer.h"

namespace tomales::compiler {

/// A piece of a macro's replacement.
struct MacroPiece {
  Lexeme lexeme;
  int parameter = -1;      ///< Whose argument stands here; -1: the lexeme itself.
  bool stringify = false;  ///< '#' before the parameter.
  bool pasted = false;     ///< '##' before it.
};

struct Macro {
  enum class Kind : uint8_t { Defined, Line, File };
  Kind kind = Kind::Defined;
  std::string name;
  Place place{};
  bool takesArguments = false, isVariadic = false;
  std::vector<std::string> parameters;  ///< The last of a variadic one is __VA_ARGS__, or has a name of its own.
  std::vector<MacroPiece> pieces;
  int active = 0;  ///< Replacements by it that are being read: it is not replaced within them.
};
using MacroPtr = std::shared_ptr<Macro>;

/// The macro that the rest of a "#define" line defines; null after an error.
MacroPtr readDefinition(Lexer& lexer, Place directive, Messages& messages);
bool isSame(const Macro& a, const Macro& b);

struct MacroArgument {
  std::vector<Lexeme> written, expanded;
};

/// The replacement with arguments put in, '#' and '##' done. Lexemes of the macro get `expansion`.
std::vector<Lexeme> substitute(const Macro& macro, const std::vector<MacroArgument>& arguments, int32_t expansion,
                               MadeTexts& made, Messages& messages);

class MacroTable {
 public:
  MacroTable();
  Macro* find(std::string_view name) const {
    const auto found = macros_.find(name);
    return found == macros_.end() ? nullptr : found->second.get();
  }
  MacroPtr share(std::string_view name) const { return macros_.find(name)->second; }
  void define(const MacroPtr& macro, Messages& messages);
  void undefine(std::string_view name) { macros_.erase(name); }

 private:
  std::unordered_map<std::string_view, MacroPtr> macros_;  ///< Keys are views of the macros' names.
};

}  // namespace tomales::compiler
