// The trees of functions and shaders that the parser makes of a file (RISpec 3.2 sections 11 to 14). The checker
// (check.h) fills in types and the meanings of names.
#pragma once
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reyes/rsl/source.h"

namespace tomales::compiler {

enum class Base : uint8_t { Void, Float, Color, Point, Vector, Normal, Matrix, String };
const char* name(Base base);
std::optional<Base> baseNamed(std::string_view name);
/// Returns the names of all types but void.
const std::vector<std::string>& typeNames();
enum class Detail : uint8_t { Unstated, Uniform, Varying };

/// A type without its detail.
struct Type {
  Base base = Base::Void;
  int32_t length =
      0;  ///< The length of an array; 0 if none; kOpenArray for "float a[]", which is as long as the argument.
  bool operator==(const Type&) const = default;
  bool isArray() const { return length != 0; }
  bool isTriple() const { return length == 0 && base >= Base::Color && base <= Base::Normal; }
  bool is(Base b) const { return length == 0 && base == b; }
};
constexpr int32_t kOpenArray = -1;
/// Returns the name of a type in RSL: "float", "color[3]", ...
std::string name(const Type& type);

struct Expr;
struct Stmt;
struct Function;
struct Builtin;
using ExprPtr = std::unique_ptr<Expr>;
using StmtPtr = std::unique_ptr<Stmt>;

/// A declared variable or parameter.
struct Variable {
  std::string name;
  Place place{};
  Type type;
  Detail detail = Detail::Unstated;
  bool output = false;    ///< True for a parameter that its function or shader may assign.
  bool isExtern = false;  ///< True if declared by `extern`: it stands for `outer`, a variable of an outer scope.
  ExprPtr initial;        ///< The initial value, or the default of a parameter. Null if there is none.
  /// The checker sets these.
  Variable* outer = nullptr;
  int32_t global = -1;  ///< A Global (globals.h), or -1.
  bool used = false, assigned = false;
};

enum class ExprKind : uint8_t {
  Number,       ///< number
  String,       ///< text
  Name,         ///< text -> variable
  Index,        ///< args[0] [ args[1] ]
  Tuple,        ///< (a, b, c), or a matrix of 16; of other lengths only as the value of an array: { a, b, ... }
  Unary,        ///< text: "-", "!", "+"
  Binary,       ///< text: + - * / . ^ < <= > >= == != && ||
  Conditional,  ///< args[0] ? args[1] : args[2]
  Assign,       ///< text: = += -= *= /= (and ^= .= as some compilers have them); args[0] is a Name or an Index
  Call,         ///< text: name of a function; args
  Cast,         ///< written type, text: space ("" none): `color "hsv" (a, b, c)`, `point "shader" p`, `float noise(x)`
  Comma,        ///< args in order; the value is that of the last
};

/// Most levels of one expression. More are an error of the parser, so that trees may be walked by recursion. (Nesting
/// is bounded by kMostNesting; this counts a chain "a + b + c + ..." too.)
constexpr int32_t kMostHeight = 1000;

struct Expr {
  ExprKind kind = ExprKind::Number;
  Place place{};
  int32_t length = 1;  ///< The number of characters that the caret underlines.
  std::string text;
  float number = 0;
  Type written{};  ///< The type that a Cast writes.
  bool hasSpace = false;
  std::vector<ExprPtr> args;
  int32_t height = 1;  ///< The number of levels of the tree from here down, at most kMostHeight.
  /// The checker sets these.
  bool checked = false;
  Type type{};
  Variable* variable = nullptr;        ///< The variable of a Name.
  const Function* function = nullptr;  ///< The function of a Call to one of the file.
  const Builtin* builtin = nullptr;    ///< The function of a Call to a built-in one, or to one of a plugin.
  bool missing = false;                ///< True for a Call to a function that does not exist.
};

/// Returns the value of an expression that consists of number literals alone; otherwise nothing.
std::optional<float> constantOf(const Expr& e);

enum class StmtKind : uint8_t {
  Empty,
  Block,        ///< body
  Expression,   ///< exprs[0]
  Declare,      ///< variables, in order
  If,           ///< exprs[0]; body[0] and, where there is one, body[1] (else)
  While,        ///< exprs[0]; body[0]
  For,          ///< exprs[0..2], each may be null: first, condition, step; body[0]
  Break,        ///< count levels
  Continue,     ///< count levels
  Return,       ///< exprs[0], which may be null
  Illuminance,  ///< exprs: those in the brackets; body[0]
  Illuminate,   ///< the same as Illuminance
  Solar,        ///< the same as Illuminance
  Gather,       ///< the same as Illuminance, and body[1] (else) if there is one
  Define,       ///< a function within a function
};

struct Stmt {
  StmtKind kind = StmtKind::Empty;
  Place place{};
  int32_t count = 1;
  std::vector<ExprPtr> exprs;
  std::vector<StmtPtr> body;
  std::vector<std::unique_ptr<Variable>> variables;
  std::unique_ptr<Function> function;
};

/// Tells whether `s` contains a statement of one of these kinds. Functions that it defines do not count.
bool contains(const Stmt& s, std::initializer_list<StmtKind> kinds);

struct Function {
  std::string name;
  Place place{};
  Type result{};  ///< Void if it returns nothing.
  std::vector<std::unique_ptr<Variable>> parameters;
  StmtPtr body;  ///< A Block.
};

enum class ShaderKind : uint8_t { Surface, Light, Displacement, Volume, Imager, Transformation };
const char* name(ShaderKind kind);
std::optional<ShaderKind> shaderKindNamed(std::string_view name);
const std::vector<std::string>& shaderKindNames();

struct Shader {
  ShaderKind kind = ShaderKind::Surface;
  std::string name;
  Place place{};
  std::string doc;  ///< The first sentence of the comment before it; empty if there is none.
  std::vector<std::unique_ptr<Variable>> parameters;
  StmtPtr body;  ///< A Block.
};

/// A file. Functions are in the order of their definitions, and may be called by what follows them.
struct File {
  std::vector<std::unique_ptr<Function>> functions;
  std::vector<std::unique_ptr<Shader>> shaders;
};

/// Returns one line for each node, indented, with the types that the checker has set.
std::string dump(const File& file);

}  // namespace tomales::compiler
