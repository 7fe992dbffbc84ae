// RSL by the plainest means: one point walks through the checked tree of a shader. Knows what WrittenProgram writes.
#pragma once
#include <cmath>
#include <map>
#include <stdexcept>

#include "reyes/rsl/check.h"
#include "reyes/rsl/globals.h"
#include "reyes/shader.h"

namespace tomales::compiler {

class TreeWalk {
 public:
  struct Value {
    float x[3] = {};
    int width = 1;
    Value() = default;
    Value(float f) : x{f, f, f} {}
    Value(const rsl::Vec3& v) : x{v.x, v.y, v.z}, width(3) {}
  };
  using Globals = std::map<Global, Value>;
  struct Light {
    bool lit;
    Value L, Cl;
  };

  TreeWalk(const Shader& shader, Globals globals, std::vector<Light> lights)
      : globals_(std::move(globals)), lights_(std::move(lights)) {
    for (const auto& p : shader.parameters) declare(*p);
    run(*shader.body);
  }
  Value valueOf(const Variable& v) const { return stored_.at(&v)[0]; }

 private:
  /// How a statement is left: it goes on, leaves or continues so many loops, or returns from the function.
  struct Way {
    enum Kind { GoesOn, Breaks, Continues, Returns } kind = GoesOn;
    int32_t loops = 0;
  };

  std::vector<Value>& storage(const Variable& v) {
    const Variable* at = &v;
    while (at->outer) at = at->outer;
    const auto it = references_.find(at);
    return it != references_.end() ? *it->second : stored_[at];
  }
  void declare(const Variable& v) {
    std::vector<Value> values(static_cast<size_t>(std::max(1, v.type.length)));
    const bool list = v.initial && v.initial->kind == ExprKind::Tuple && v.type.isArray();
    for (size_t k = 0; list && k < v.initial->args.size(); ++k) values[k] = value(*v.initial->args[k]);
    if (v.initial && !list) values[0] = value(*v.initial);
    if (v.type.isTriple()) values[0].width = 3;
    stored_[&v] = std::move(values);
  }

  Value value(const Expr& e) {
    const auto arg = [&](size_t k) { return value(*e.args[k]); };
    switch (e.kind) {
      case ExprKind::Number:
        return e.number;
      case ExprKind::Name:
        if (e.variable->global >= 0) return globals_.at(static_cast<Global>(e.variable->global));
        return storage(*e.variable)[0];
      case ExprKind::Index:
        return place(e);
      case ExprKind::Tuple: {
        Value out{rsl::Vec3{}};
        for (size_t k = 0; k < 3; ++k) out.x[k] = arg(k).x[0];
        return out;
      }
      case ExprKind::Unary:
        return e.text == "!" ? Value(arg(0).x[0] == 0 ? 1.0f : 0.0f)
                             : each(arg(0), 0.0f, [](float a, float) { return -a; });
      case ExprKind::Binary: {
        const Value a = arg(0);
        return binary(e.text, a, arg(1));
      }
      case ExprKind::Conditional:
        return arg(0).x[0] != 0 ? arg(1) : arg(2);
      case ExprKind::Assign: {
        const Value right = arg(1);
        Value& to = place(*e.args[0]);
        const int width = to.width;
        to = e.text == "=" ? right : binary(e.text.substr(0, 1), Value(to), right);
        to.width = width;
        return to;
      }
      case ExprKind::Cast: {
        Value out = arg(0);
        out.width = 3;
        return out;
      }
      case ExprKind::Call:
        return e.function ? called(e, *e.function) : builtIn(e);
      default:
        throw std::logic_error("the walk does not know this expression");
    }
  }
  Value& place(const Expr& e) {
    if (e.kind == ExprKind::Name) return storage(*e.variable)[0];
    const float index = value(*e.args[1]).x[0];
    return storage(*e.args[0]->variable).at(static_cast<size_t>(index));
  }

  template <class Function>
  static Value each(const Value& a, const Value& b, const Function& f) {
    Value out;
    out.width = std::max(a.width, b.width);
    for (int k = 0; k < 3; ++k) out.x[k] = f(a.x[k], b.x[k]);
    return out;
  }
  static Value binary(const std::string& text, const Value& a, const Value& b) {
    const bool same = a.x[0] == b.x[0] && a.x[1] == b.x[1] && a.x[2] == b.x[2];
    const float x = a.x[0], y = b.x[0];
    if (text == "+") return each(a, b, [](float p, float q) { return p + q; });
    if (text == "-") return each(a, b, [](float p, float q) { return p - q; });
    if (text == "*") return each(a, b, [](float p, float q) { return p * q; });
    const bool holds = text == "<"    ? x < y
                       : text == "<=" ? x <= y
                       : text == ">"  ? x > y
                       : text == ">=" ? x >= y
                       : text == "==" ? same
                       : text == "!=" ? !same
                       : text == "&&" ? x != 0 && y != 0
                                      : x != 0 || y != 0;
    return holds ? 1.0f : 0.0f;
  }
  Value builtIn(const Expr& e) {
    std::vector<Value> a;
    for (const ExprPtr& arg : e.args) a.push_back(value(*arg));
    const auto least = [](float x, float y) { return std::min(x, y); };
    const auto most = [](float x, float y) { return std::max(x, y); };
    if (e.text == "min") return each(a[0], a[1], least);
    if (e.text == "max") return each(a[0], a[1], most);
    if (e.text == "clamp") return each(each(a[0], a[1], most), a[2], least);
    if (e.text == "floor") return each(a[0], 0.0f, [](float x, float) { return std::floor(x); });
    if (e.text == "abs") return each(a[0], 0.0f, [](float x, float) { return std::abs(x); });
    if (e.text == "comp") return a[0].x[static_cast<int>(a[1].x[0])];
    if (e.text == "setcomp") return place(*e.args[0]).x[static_cast<int>(a[1].x[0])] = a[2].x[0];
    throw std::logic_error("the walk does not know " + e.text);
  }
  Value called(const Expr& e, const Function& f) {
    std::vector<Value> given;
    for (const ExprPtr& arg : e.args) given.push_back(value(*arg));
    for (size_t k = 0; k < given.size(); ++k)
      if (f.parameters[k]->output)
        references_[f.parameters[k].get()] = &storage(*e.args[k]->variable);
      else
        stored_[f.parameters[k].get()] = {given[k]};
    result_ = Value();
    run(*f.body);
    return result_;
  }

  bool holds(const Expr* e) { return !e || value(*e).x[0] != 0; }
  Way run(const Stmt& s) {
    switch (s.kind) {
      case StmtKind::Block:
        for (const StmtPtr& part : s.body)
          if (const Way way = run(*part); way.kind != Way::GoesOn) return way;
        return {};
      case StmtKind::Expression:
        value(*s.exprs[0]);
        return {};
      case StmtKind::Declare:
        for (const auto& v : s.variables) declare(*v);
        return {};
      case StmtKind::If:
        if (holds(s.exprs[0].get())) return run(*s.body[0]);
        return s.body.size() > 1 ? run(*s.body[1]) : Way();
      case StmtKind::While:
        return loop(s.exprs[0].get(), *s.body[0], nullptr);
      case StmtKind::For:
        value(*s.exprs[0]);
        return loop(s.exprs[1].get(), *s.body[0], s.exprs[2].get());
      case StmtKind::Break:
        return {Way::Breaks, s.count};
      case StmtKind::Continue:
        return {Way::Continues, s.count};
      case StmtKind::Return:
        if (!s.exprs.empty() && s.exprs[0]) result_ = value(*s.exprs[0]);
        return {Way::Returns, 0};
      case StmtKind::Illuminance:
        for (const Light& light : lights_) {
          if (!light.lit) continue;
          globals_[Global::L] = light.L;
          globals_[Global::Cl] = light.Cl;
          if (const auto [left, way] = round(*s.body[0]); left) return way;
        }
        return {};
      default:
        return {};
    }
  }
  Way loop(const Expr* condition, const Stmt& body, const Expr* step) {
    while (holds(condition)) {
      if (const auto [left, way] = round(body); left) return way;
      if (step) value(*step);
    }
    return {};
  }
  /// Is the loop left behind this round, and on which way?
  std::pair<bool, Way> round(const Stmt& body) {
    Way way = run(body);
    if (way.kind == Way::GoesOn || (way.kind == Way::Continues && way.loops == 1)) return {false, {}};
    if (way.kind == Way::Breaks && way.loops == 1) return {true, {}};
    --way.loops;
    return {true, way};
  }

  Globals globals_;
  std::vector<Light> lights_;
  std::map<const Variable*, std::vector<Value>> stored_;
  std::map<const Variable*, std::vector<Value>*> references_;
  Value result_;
};

}  // namespace tomales::compiler
