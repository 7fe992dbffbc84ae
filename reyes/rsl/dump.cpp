#include <fmt/format.h>

#include "reyes/rsl/tree.h"

namespace tomales::compiler {
namespace {

constexpr const char* kExprNames[] = {"number", "string",      "name",   "index", "tuple", "unary",
                                      "binary", "conditional", "assign", "call",  "cast",  "comma"};
constexpr const char* kStmtNames[] = {"empty",       "block",      "expression", "declare",  "if",
                                      "while",       "for",        "break",      "continue", "return",
                                      "illuminance", "illuminate", "solar",      "gather",   "define"};

class Dump {
 public:
  std::string run(const File& file) {
    for (const auto& f : file.functions) function(*f, 0);
    for (const auto& s : file.shaders) {
      line(0, fmt::format("{} {}", name(s->kind), s->name));
      if (!s->doc.empty()) line(1, "doc \"" + s->doc + "\"");
      for (const auto& p : s->parameters) variable(*p, 1);
      statement(*s->body, 1);
    }
    return std::move(out_);
  }

 private:
  void line(int indent, const std::string& text) {
    out_.append(static_cast<size_t>(indent) * 2, ' ');
    out_ += text + '\n';
  }

  void function(const Function& f, int indent) {
    line(indent, fmt::format("function {} {}", name(f.result), f.name));
    for (const auto& p : f.parameters) variable(*p, indent + 1);
    statement(*f.body, indent + 1);
  }

  void variable(const Variable& v, int indent) {
    constexpr const char* kDetails[] = {"", "uniform ", "varying "};
    line(indent, fmt::format("variable {}{}{}{} {}", v.isExtern ? "extern " : "", v.output ? "output " : "",
                             kDetails[static_cast<size_t>(v.detail)], name(v.type), v.name));
    if (v.initial) expression(v.initial.get(), indent + 1);
  }

  void statement(const Stmt& s, int indent) {
    const bool hasCount = s.kind == StmtKind::Break || s.kind == StmtKind::Continue;
    line(indent, kStmtNames[static_cast<size_t>(s.kind)] + (hasCount ? fmt::format(" {}", s.count) : std::string()));
    for (const auto& v : s.variables) variable(*v, indent + 1);
    for (const auto& e : s.exprs) expression(e.get(), indent + 1);
    for (const auto& b : s.body) statement(*b, indent + 1);
    if (s.function) function(*s.function, indent + 1);
  }

  static std::string valueOf(const Expr& e) {
    switch (e.kind) {
      case ExprKind::Number:
        return fmt::format(" {}", e.number);
      case ExprKind::String:
        return " \"" + e.text + "\"";
      case ExprKind::Cast:
        return " " + name(e.written) + (e.hasSpace ? " \"" + e.text + "\"" : "");
      case ExprKind::Name:
      case ExprKind::Unary:
      case ExprKind::Binary:
      case ExprKind::Assign:
      case ExprKind::Call:
        return " " + e.text;
      default:
        return "";
    }
  }

  void expression(const Expr* e, int indent) {
    if (!e) return line(indent, "none");
    const std::string type = e->type.base == Base::Void ? "" : " : " + name(e->type);
    line(indent, kExprNames[static_cast<size_t>(e->kind)] + valueOf(*e) + type);
    for (const auto& a : e->args) expression(a.get(), indent + 1);
  }

  std::string out_;
};

}  // namespace

std::string dump(const File& file) { return Dump().run(file); }

}  // namespace tomales::compiler
