// Makes the list of tokens of a file: performs directives and replaces macros.
#pragma once
#include "reyes/rsl/preprocess.h"
#include "reyes/rsl/preprocess/include.h"
#include "reyes/rsl/preprocess/macros.h"

namespace tomales::compiler {

class Preprocessor {
 public:
  static constexpr size_t kMostBytes =
      4 * kMostFileBytes;  ///< Limits the bytes that are read, and those of the result.
  /// `ownFolder` is the folder of the shader's file; empty for a text without a file.
  Preprocessor(const PreprocessOptions& options, const std::string& ownFolder, Sources& sources, Messages& messages);
  std::vector<Token> run(int32_t file);

 private:
  /// An #if, with its #elif and #else.
  struct Conditional {
    Place place{};
    bool outerActive = true, anyTaken = false, active = false, hadElse = false;
  };
  struct OpenFile {
    Lexer lexer;
    std::string folder;  ///< The folder where #include "NAME" looks first.
    std::vector<Conditional> conditionals;
  };
  /// Words that are read before the file goes on: a macro's replacement, an argument, or what was put back.
  struct Row {
    std::vector<Lexeme> lexemes;
    size_t at = 0;
    MacroPtr macro{};         ///< The macro whose replacement this is; null if it is no replacement.
    bool isArgument = false;  ///< True if reading stops at its end.
  };

  // preprocessor.cpp
  Lexeme next();  ///< The next word after replacement; End at the end of a file, or of a row that is an argument.
  Lexeme read();  ///< The next word, before replacement.
  Lexeme readFromFiles();
  void putBack(const Lexeme& lexeme);
  void closeFile();
  bool isDone() const { return stopped_ || files_.empty(); }
  /// Reports an error after which nothing more is read.
  void stop(Place place, std::string text);
  void predefine(const PreprocessOptions& options);

  // expansion.cpp
  bool enter(const Lexeme& name, Macro& macro);
  bool readArguments(const Lexeme& name, const Macro& macro, std::vector<MacroArgument>& arguments);
  bool readArgument(const Lexeme& name, bool isRest, int& depth, std::vector<Lexeme>& out);
  bool fits(const Lexeme& name, const Macro& macro, std::vector<MacroArgument>& arguments);
  std::vector<Lexeme> expanded(std::vector<Lexeme> lexemes);
  Lexeme ownValue(const Lexeme& name, const Macro& macro);
  bool account(Place place, size_t lexemes);

  // directives.cpp
  void directive(Place place);
  void conditionalDirective(std::string_view name, Place place);
  void beginConditional(std::string_view name, Place place, Lexer& lexer);
  void nextBranch(std::string_view name, Place place, Lexer& lexer);
  bool evaluate(Lexer& lexer, Place place);
  bool isDefined(Lexer& lexer, std::string_view directive, Place place);
  std::vector<Lexeme> withDefinedDone(Lexer& lexer);
  void plainDirective(const Lexeme& name, Place place);
  void include(Place place);
  void includeFile(std::string_view name, bool isQuoted, Place place);
  bool isActive() const { return files_.back().conditionals.empty() || files_.back().conditionals.back().active; }
  void skipLine();

  // output.cpp
  void put(const Lexeme& lexeme);
  void putNumber(const Lexeme& lexeme, Token& token);
  void putString(const Lexeme& lexeme, Token token);

  Sources& sources_;
  Messages& messages_;
  IncludeSearch search_;
  std::string ownFolder_;
  MacroTable macros_;
  MadeTexts made_;
  std::vector<OpenFile> files_;
  std::vector<Row> rows_;
  std::vector<Token> out_;
  int expansions_ = 0, nesting_ = 0, includes_ = 0;
  size_t work_ = 0, bytesIn_ = 0, bytesOut_ = 0;
  bool stopped_ = false;
};

}  // namespace tomales::compiler
