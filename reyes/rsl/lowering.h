// Private to the lowering (lower*.cpp).
#pragma once
#include <map>

#include "reyes/rsl/builtins.h"
#include "reyes/rsl/globals.h"
#include "reyes/rsl/lower.h"

namespace tomales::compiler {

Shape shapeOf(const Type& type);

class Lowering {
 public:
  Lowering(Code& code, Messages& messages);
  void shader(const Shader& s);

 private:
  // --- lower.cpp: registers and instructions
  int32_t add(Register r);
  int32_t temporary(Shape shape);
  int32_t number(float value);
  int32_t text(const std::string& value);
  int32_t constant(Shape shape, std::vector<float> floats);
  int32_t global(Global g);
  int32_t variable(const Variable& v);  ///< Makes a register for the variable, which stands for it from now on.
  /// Counts an instruction or an inlined function. Returns false, after one report, if there are too many.
  bool hasRoom();
  Instruction& emit(Op op, std::vector<int32_t> out, std::vector<int32_t> in);
  /// Emits an instruction with one result, of its signature's shape (of `shape` if that is `*`).
  int32_t compute(Op op, std::vector<int32_t> in, Shape shape = Shape::Number);
  void copy(int32_t to, int32_t from);        ///< Writes the active points.
  void initialise(int32_t to, int32_t from);  ///< Writes all points, because the register has no value yet.
  /// Returns a block of the instructions that `body` emits.
  template <class Body>
  Block block(const Body& body);
  Shape shape(int32_t reg) const { return code_.registers[static_cast<size_t>(reg)].shape; }

  // --- lower_shader.cpp: parameters
  void parameter(const Variable& v);
  void beginColor();
  void hideUncoloured();
  int32_t outputParameter(const Variable& v);
  void givenParameter(const Variable& v);
  bool constantDefault(const Variable& v, Parameter& p);
  void computedDefault(const Variable& v, int32_t reg);
  /// Returns a register that is 1 where the value is the mark of a default that the shader computes.
  int32_t isMissing(int32_t reg);

  // --- lower_statements.cpp
  void statement(const Stmt& s);
  void declaration(const Variable& v);
  void initialiseArray(const Variable& v, int32_t reg);
  void ifElse(const Expr& condition, const Stmt* then, const Stmt* otherwise);
  void ifElse(int32_t condition, Block then, Block otherwise);
  void loop(const Expr* condition, const Stmt& body, const Expr* step);
  void jump(const Stmt& s);
  // --- lower_light.cpp
  /// Runs `body` inside the labels that its `break` and `continue` leave.
  template <class Body>
  void breakable(const Stmt& within, const Body& body);
  int32_t condition(const Expr& e);

  void illuminance(const Stmt& s);
  void illuminate(const Stmt& s);
  /// Notes where the cone of an illuminate() may shine, of which `angle` is the register.
  void noteCone(const Expr& axis, int32_t angle);
  /// Returns how many places from which a light shines may count at one point; those of a loop count twice.
  static int lightsOf(const Stmt& s);
  static int lightsOf(const Expr& e);
  void solar(const Stmt& s);
  void gather(const Stmt& s);

  // --- lower_expressions.cpp
  int32_t value(const Expr& e);
  /// Returns the register of the expression's value as the type `wanted`. A number stays a number where a triple is
  /// wanted, since it counts for all components; where a matrix is wanted, it becomes one.
  int32_t value(const Expr& e, const Type& wanted);
  /// Returns a triple of a number that stands for one, for instructions that read each component by itself.
  int32_t widened(int32_t reg, const Type& type);
  /// Evaluates the list in order. Values that a later expression may change are copied.
  std::vector<int32_t> values(const std::vector<const Expr*>& list, const std::vector<Type>& wanted);
  int32_t name(const Expr& e);
  int32_t ofLight(Global g);
  int32_t element(const Expr& e);
  int32_t element(int32_t array, int32_t index);
  int32_t tuple(const Expr& e);
  int32_t binary(const Expr& e);
  int32_t conditional(const Expr& e);
  int32_t assign(const Expr& e);
  int32_t cast(const Expr& e);
  void store(const Expr& to, int32_t from);
  /// Returns the register that a call may write for `to`. `after` lists what must be stored if `to` is not a plain
  /// variable.
  int32_t target(const Expr& to, std::vector<std::pair<const Expr*, int32_t>>& after);

  // --- lower_calls.cpp
  int32_t call(const Expr& e);
  int32_t inlined(const Expr& e, const Function& f);
  /// Binds the parameters of a function to the arguments of a call. Returns what must be stored after the call.
  std::vector<std::pair<const Expr*, int32_t>> bindArguments(const Expr& e, const Function& f);
  // Both return the register of the function's value, or -1 if it has none.
  int32_t inlineStraight(const Function& f);  ///< Pre: it returns only at its very end, so that no label is needed.
  int32_t inlineWithReturns(const Function& f);

  // --- lower_builtins.cpp
  int32_t builtin(const Expr& e, const Builtin& b);
  std::vector<int32_t> arguments(const Expr& e, const Builtin& b, size_t count);
  std::vector<Setting> settings(const std::vector<ExprPtr>& list, size_t from, std::string_view function,
                                std::vector<std::pair<const Expr*, int32_t>>& after);
  int32_t instruction(const Expr& e, const Builtin& b);
  int32_t fold(const Expr& e, const Builtin& b);
  int32_t component(const Expr& e, const Builtin& b);
  int32_t derivative(const Expr& e, const Builtin& b);
  int32_t calculatedNormal(const Expr& e, const Builtin& b);
  int32_t colorTransform(const Expr& e, const Builtin& b);
  int32_t shaderName(const Expr& e, const Builtin& b);
  int32_t print(const Expr& e, const Builtin& b);
  int32_t arrayLength(const Expr& e, const Builtin& b);
  int32_t setComponent(const Expr& e, const Builtin& b);
  int32_t spline(const Expr& e, const Builtin& b);
  int32_t transform(const Expr& e, const Builtin& b);
  int32_t withList(const Expr& e, const Builtin& b);
  int32_t ask(const Expr& e, const Builtin& b);
  int32_t normalOf(int32_t position);
  int32_t plugin(const Expr& e, const Builtin& b);
  // --- lower_pictures.cpp
  int32_t texture(const Expr& e, const Builtin& b);
  int32_t environment(const Expr& e, const Builtin& b);
  int32_t shadow(const Expr& e, const Builtin& b);
  /// Lowers the file name, and the channel in brackets after it.
  std::pair<int32_t, int32_t> picture(const Expr& e);

  Code& code_;
  Messages& messages_;
  Block* block_;
  bool shinesFromMany_ = false;  ///< Several illuminate() or solar() of this light may reach one point.
  int32_t depth_ = 0;            ///< The number of enclosing control structures.
  int instructions_ = 0;
  std::map<const Variable*, int32_t> registers_;
  std::map<float, int32_t> numbers_;
  std::map<std::string, int32_t> texts_;
  std::map<Global, int32_t> globals_, ofLight_;
  struct LoopLabels {
    int32_t leave, next;
  };
  std::vector<LoopLabels> loops_;
  struct Inlined {
    int32_t result = -1, label = -1;
    Type type{};
  };
  std::vector<Inlined> functions_;
  Place place_{};
};

template <class Body>
Block Lowering::block(const Body& body) {
  Block out;
  Block* const outer = block_;
  block_ = &out;
  ++depth_;
  body();
  block_ = outer;
  --depth_;
  return out;
}

}  // namespace tomales::compiler
