// Private to the checker (check*.cpp).
#pragma once
#include <map>
#include <set>

#include "reyes/rsl/check.h"
#include "reyes/rsl/globals.h"
#include "reyes/rsl/types.h"

namespace tomales::compiler {

class Checker {
 public:
  /// `prelude` is null while the prelude itself is checked. `plugins` is null if there are none.
  Checker(Checked& checked, const File* prelude, const RslFunctions* plugins, Messages& messages);
  void file(File& file);

 private:
  // --- check.cpp: definitions and statements
  void function(Function& f);
  void shader(Shader& s);
  void declare(Variable& v);
  void parameter(Variable& v);
  void initialise(Variable& v);
  void statement(Stmt& s);
  void block(Stmt& s);
  void loopBody(Stmt& s);  ///< Checks a statement that `break` and `continue` may leave.
  void forLoop(Stmt& s);
  void condition(Expr& e);
  void declaration(Variable& v);
  void jump(const Stmt& s);
  void returned(Stmt& s);
  void refuseRecursion();

  // --- check_light.cpp: the statements about light and rays
  void illuminance(Stmt& s);
  void illuminate(Stmt& s);
  void solar(Stmt& s);
  void gather(Stmt& s);

  // --- check_expressions.cpp
  /// Returns the type that the expression has on its own.
  Type type(Expr& e);
  /// Checks an expression where a value of the type `wanted` is needed. It picks the overload with that result, and
  /// reports an expression that does not convert.
  void expect(Expr& e, const Type& wanted, const char* where);
  /// Changes the expression's type to `wanted` if it can have that type.
  void retarget(Expr& e, const Type& wanted);
  void retargetFactor(Expr& e, const Type& wanted);
  Type typeOfName(Expr& e);
  Type typeOfIndex(Expr& e);
  Type typeOfTuple(Expr& e);
  Type typeOfUnary(Expr& e);
  Type typeOfBinary(Expr& e);
  Type typeOfConditional(Expr& e);
  Type typeOfAssign(Expr& e);
  Type typeOfCast(Expr& e);
  /// Marks the variable that an assignment to the expression changes. Reports an expression that is not assignable.
  void assigned(Expr& e, const char* where);
  int distance(const Expr& e, const Type& to) const;  ///< Negative if it does not convert.
  /// What a number is computed from, by what would do the same to each component of a colour. Noise comes before
  /// pictures.
  enum class Source { Numbers, Picture, Noise };
  Source sourceOf(const Expr& e);

  // --- check_calls.cpp
  Type typeOfCall(Expr& e);
  Type typeOfBuiltin(Expr& e, const Builtin& b);
  std::vector<const Builtin*> builtinsOf(const std::string& name);
  Type typeOfFunction(Expr& e, const Function& f);
  bool becomesParameter(Expr& e);
  void unknownFunction(Expr& e);
  void noFit(Expr& e, const std::vector<const Function*>& functions);
  int fit(const Expr& call, const Function& f) const;
  int fit(const Expr& call, const Builtin& b) const;
  std::vector<const Function*> functionsOf(std::string_view name) const;
  void list(std::vector<ExprPtr>& entries, size_t from, std::string_view function);

  struct Scope {
    std::map<std::string, Variable*, std::less<>> variables;
    std::multimap<std::string, const Function*, std::less<>> functions;
    bool isFunction = false;  ///< True for a function's scope: `extern` looks in the scopes outside of it.
  };
  Variable* find(std::string_view name, bool outside = false) const;
  std::vector<std::string> visibleNames() const;
  std::vector<std::string> functionNames() const;

  std::deque<Variable>& globals_;
  std::deque<Builtin>* const pluginRows_;
  const File* const prelude_;
  const RslFunctions* const plugins_;
  std::map<std::string, std::vector<const Builtin*>>
      plugged_;  ///< Rows of plugin functions, for names that were looked up there.
  Messages& messages_;
  std::vector<Scope> scopes_;
  const Function* current_ = nullptr;  ///< Null in the body of a shader.
  int loops_ = 0;
  std::map<const Function*, std::set<const Function*>> calls_;
  std::set<std::pair<int32_t, std::string>> told_;  ///< Unknown names that have been reported, once for each file.
};

}  // namespace tomales::compiler
