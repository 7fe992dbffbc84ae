// Recursive descent over a list of tokens. After an error has been reported, Failed is thrown. It is caught where
// parsing can go on, at the next statement or definition.
#pragma once
#include <initializer_list>

#include "reyes/rsl/parse.h"

namespace tomales::compiler {

/// An error that has been reported.
struct Failed {};
/// An error after which nothing more is read.
struct GaveUp {};

class Parser {
 public:
  Parser(const std::vector<Token>& tokens, Messages& messages) : tokens_(tokens), messages_(messages) {}
  File run();

 private:
  /// Counts one more level of nesting while it lives.
  class Level {
   public:
    explicit Level(Parser& parser) : parser_(parser) { parser_.deeper(); }
    ~Level() { --parser_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Parser& parser_;
  };

  /// The words that stand before a declared name.
  struct Specifiers {
    Type type{};
    Detail detail = Detail::Unstated;
    bool output = false, isExtern = false, hasType = false, any = false;
  };

  // tokens.cpp
  const Token& here(size_t ahead = 0) const { return tokens_[std::min(at_ + ahead, tokens_.size() - 1)]; }
  const Token& take();
  bool takeIf(std::string_view punctuator);
  void expect(std::string_view punctuator);
  void expectClosing(std::string_view punctuator, const Token& open);
  const Token& expectName(std::string_view what);
  /// Reports "expected X before 'word'" for the next word, and suggests a word of `known` that may have been meant.
  [[noreturn]] void fail(std::string text, const std::vector<std::string>& known = {});
  [[noreturn]] void failAt(const Token& token, std::string text);
  void error(const Token& token, std::string text);
  void deeper();
  bool atEnd() const { return here().kind == TokenKind::End; }
  size_t behindBracket(size_t index) const;
  void skipStatement();
  void skipDefinition();
  [[noreturn]] void refuseRsl2(const Token& token, std::string_view what);
  bool isRsl2(bool atFileLevel) const;

  // definitions.cpp
  void definition(File& file);
  std::unique_ptr<Shader> shader(ShaderKind kind, std::string doc);
  std::unique_ptr<Function> function(const Specifiers& specifiers);
  Specifiers specifiers();
  void parameters(std::vector<std::unique_ptr<Variable>>& out);
  std::unique_ptr<Variable> variable(const Specifiers& specifiers);
  int32_t arrayLength();
  bool isFunctionHere() const;
  bool beginsSpecifiers() const;
  [[noreturn]] void failNoDefinition();

  // classes.cpp
  void classShaders(File& file, const Token& word, const std::string& doc);
  void checkMethod(const Function& method, const std::vector<std::string>& arguments);
  StmtPtr callOf(const Function& method, const std::vector<std::string>& arguments, const Token& word);

  // statements.cpp
  StmtPtr statement();
  StmtPtr block();
  void statementInto(std::vector<StmtPtr>& out);
  StmtPtr declaration();
  StmtPtr ifStatement();
  StmtPtr whileStatement();
  StmtPtr forStatement();
  StmtPtr levels(StmtKind kind);
  StmtPtr returnStatement();
  StmtPtr lightStatement(StmtKind kind);
  StmtPtr expressionStatement();
  [[noreturn]] void failNoStatement();
  void bracketed(Stmt& out);

  // expressions.cpp
  ExprPtr expression();  ///< Commas included.
  ExprPtr assignment();
  /// Fails if `variable` cannot be assigned.
  void checkAssigned(const Expr& variable, const Token& sign, bool isReadToo);
  bool isDoubledSign() const;
  bool isIncrement() const;
  bool isEarlyIncrement() const;
  ExprPtr one(const Token& at) const;
  ExprPtr added(const Token& sign, ExprPtr variable);  ///< variable += 1, or -= 1
  ExprPtr increment(ExprPtr variable);
  ExprPtr earlyIncrement();
  ExprPtr conditional();
  ExprPtr binary(int lowest);
  ExprPtr unary();
  ExprPtr cast();
  ExprPtr postfix();
  ExprPtr primary();
  [[noreturn]] void failNoExpression();
  ExprPtr call();
  ExprPtr inBrackets();
  ExprPtr arrayValue();
  void list(std::vector<ExprPtr>& out);
  ExprPtr make(ExprKind kind, const Token& token) const;
  void adopt(Expr& parent, ExprPtr child);

  const std::vector<Token>& tokens_;
  Messages& messages_;
  size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace tomales::compiler
