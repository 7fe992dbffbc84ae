// Definitions of macros, and the replacement of one use of a macro (C90 6.8.3).
#pragma once
#include <memory>
#include <unordered_map>
#include <vector>

#include "reyes/rsl/preprocess/lexer.h"

namespace tomales::compiler {

/// A piece of a macro's replacement.
struct MacroPiece {
  Lexeme lexeme;
  int parameter = -1;      ///< The parameter whose argument stands here; -1 if the lexeme itself does.
  bool stringify = false;  ///< True if '#' is before the parameter.
  bool pasted = false;     ///< True if '##' is before the piece.
};

struct Macro {
  enum class Kind : uint8_t { Defined, Line, File };
  Kind kind = Kind::Defined;
  std::string name;
  Place place{};
  bool takesArguments = false, isVariadic = false;
  std::vector<std::string> parameters;  ///< The last of a variadic macro is __VA_ARGS__, or has a name of its own.
  std::vector<MacroPiece> pieces;
  int active = 0;  ///< The number of its replacements that are being read, in which it is not replaced again.
};
using MacroPtr = std::shared_ptr<Macro>;

/// Reads the rest of a "#define" line. Returns null after an error.
MacroPtr readDefinition(Lexer& lexer, Place directive, Messages& messages);
bool isSame(const Macro& a, const Macro& b);

struct MacroArgument {
  std::vector<Lexeme> written, expanded;
};

/// Returns the replacement with arguments substituted and '#' and '##' applied. Lexemes of the macro get `expansion`.
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
