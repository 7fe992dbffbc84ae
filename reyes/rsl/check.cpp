#include "reyes/rsl/check.h"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "reyes/rsl/checker.h"

namespace tomales::compiler {

Checker::Checker(Checked& checked, const File* prelude, const RslFunctions* plugins, Messages& messages)
    : globals_(checked.globals),
      pluginRows_(&checked.ofPlugins),
      prelude_(prelude),
      plugins_(plugins),
      messages_(messages) {
  Scope& outermost = scopes_.emplace_back();
  for (int32_t k = 0; k < kGlobals; ++k) {
    const GlobalInfo& g = info(static_cast<Global>(k));
    Variable& v = globals_.emplace_back();
    v.name = g.name;
    v.type = {g.base};
    v.global = k;
    v.detail = g.uniform ? Detail::Uniform : Detail::Varying;
    v.used = v.assigned = true;
    outermost.variables.emplace(v.name, &v);
  }
}

void Checker::file(File& file) {
  for (const auto& f : file.functions) scopes_.back().functions.emplace(f->name, f.get());
  for (const auto& f : file.functions) function(*f);
  std::map<std::pair<ShaderKind, std::string_view>, Place> seen;
  for (const auto& s : file.shaders) {
    if (const auto [first, fresh] = seen.try_emplace({s->kind, s->name}, s->place); !fresh) {
      messages_.warning(s->place,
                        fmt::format("{} \"{}\" is defined again; the first one counts", name(s->kind), s->name));
      messages_.note(first->second, "it was defined here");
    }
    shader(*s);
  }
  refuseRecursion();
}

Variable* Checker::find(std::string_view name, bool outside) const {
  for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope) {
    if (!outside)
      if (const auto it = scope->variables.find(name); it != scope->variables.end()) return it->second;
    if (scope->isFunction) outside = false;
  }
  return nullptr;
}

std::vector<std::string> Checker::visibleNames() const {
  std::vector<std::string> out;
  for (const Scope& scope : scopes_)
    for (const auto& [name, variable] : scope.variables) out.push_back(name);
  return out;
}

std::vector<std::string> Checker::functionNames() const {
  std::vector<std::string> out;
  for (const Scope& scope : scopes_)
    for (const auto& [name, function] : scope.functions) out.push_back(name);
  for (const Builtin& b : builtins()) out.push_back(b.name);
  if (prelude_)
    for (const auto& f : prelude_->functions) out.push_back(f->name);
  return out;
}

void Checker::declare(Variable& v) {
  const auto [it, isNew] = scopes_.back().variables.emplace(v.name, &v);
  if (isNew) return;
  messages_.warning(v.place, fmt::format("\"{}\" is declared again in the same block; this one counts", v.name),
                    static_cast<int32_t>(v.name.size()));
  messages_.note(it->second->place, "it was declared here");
  it->second = &v;
}

void Checker::initialise(Variable& v) {
  if (!v.initial) return;
  Expr& e = *v.initial;
  if (!v.type.isArray()) return expect(e, v.type, fmt::format("for \"{}\"", v.name).c_str());
  if (e.kind == ExprKind::Tuple) {
    for (const ExprPtr& part : e.args) expect(*part, {v.type.base}, fmt::format("for \"{}\"", v.name).c_str());
    e.checked = true;
    e.type = {v.type.base, static_cast<int32_t>(e.args.size())};
    if (v.type.length == kOpenArray) v.type.length = e.type.length;
    if (e.type.length > v.type.length)
      messages_.error(e.place, fmt::format("{} values for an array of {}", e.type.length, v.type.length), e.length);
  } else if (type(e).isArray()) {
    expect(e, v.type, fmt::format("for \"{}\"", v.name).c_str());
  } else {
    expect(e, {v.type.base}, fmt::format("for \"{}\"", v.name).c_str());  // the same for every element
  }
}

void Checker::parameter(Variable& v) {
  initialise(v);
  declare(v);
}

void Checker::function(Function& f) {
  const Function* const outer = std::exchange(current_, &f);
  const int loops = std::exchange(loops_, 0);
  scopes_.emplace_back().isFunction = true;
  for (const auto& p : f.parameters) parameter(*p);
  statement(*f.body);
  if (f.result != Type{} && !contains(*f.body, {StmtKind::Return}))
    messages_.warning(f.place,
                      fmt::format("\"{}\" gives a {}, and has no 'return': it gives 0", f.name, name(f.result)),
                      static_cast<int32_t>(f.name.size()));
  scopes_.pop_back();
  current_ = outer;
  loops_ = loops;
}

void Checker::shader(Shader& s) {
  current_ = nullptr;
  scopes_.emplace_back().isFunction = true;
  for (const auto& p : s.parameters) parameter(*p);
  statement(*s.body);
  for (const auto& p : s.parameters)
    if (!p->used && !p->output && p->name.substr(0, 2) != "__")  // parameters with underscores are for the renderer
      messages_.warning(p->place, fmt::format("the parameter \"{}\" is never read", p->name),
                        static_cast<int32_t>(p->name.size()));
  scopes_.pop_back();
}

void Checker::condition(Expr& e) {
  if (!e.checked) type(e);
  if (e.kind == ExprKind::Assign && e.text == "=" && !e.args[0]->text.empty())
    messages_.warning(e.place, fmt::format("this assigns \"{}\"; '==' compares", e.args[0]->text), e.length);
  if (e.type.isTriple() || e.type == kUnknown) return;  // some shaders ask whether a triple is not 0
  expect(e, {Base::Float}, "as a condition");
}

void Checker::declaration(Variable& v) {
  if (v.isExtern) {
    v.outer = find(v.name, true);
    if (!v.outer)
      messages_.error(v.place, fmt::format("no outer scope has a variable \"{}\"", v.name),
                      static_cast<int32_t>(v.name.size()));
    else if (v.outer->type != v.type && !(isSpatial(v.outer->type) && isSpatial(v.type)))
      messages_.error(v.place, fmt::format("\"{}\" is a {}, not a {}", v.name, name(v.outer->type), name(v.type)),
                      static_cast<int32_t>(v.name.size()));
    if (!v.outer || v.outer->type == v.type) return declare(v);
    v.type = v.outer->type;
  }
  initialise(v);
  v.assigned |= v.initial != nullptr;
  declare(v);
}

void Checker::block(Stmt& s) {
  scopes_.emplace_back();
  for (const StmtPtr& part : s.body)
    if (part->kind == StmtKind::Define) scopes_.back().functions.emplace(part->function->name, part->function.get());
  for (const StmtPtr& part : s.body) statement(*part);
  for (const auto& [name, v] : scopes_.back().variables) {
    if (v->outer || v->global >= 0) continue;
    const auto length = static_cast<int32_t>(name.size());
    if (!v->used)
      messages_.warning(v->place, fmt::format("the variable \"{}\" is never read", name), length);
    else if (!v->assigned)
      messages_.warning(v->place, fmt::format("\"{}\" is read, and nothing is ever assigned to it: it is 0", name),
                        length);
  }
  scopes_.pop_back();
}

void Checker::loopBody(Stmt& s) {
  ++loops_;
  statement(s);
  --loops_;
}

void Checker::forLoop(Stmt& s) {
  if (s.exprs[0]) type(*s.exprs[0]);
  if (s.exprs[1]) condition(*s.exprs[1]);
  if (s.exprs[2]) type(*s.exprs[2]);
  loopBody(*s.body[0]);
}

void Checker::statement(Stmt& s) {
  switch (s.kind) {
    case StmtKind::Empty:
      return;
    case StmtKind::Block:
      return block(s);
    case StmtKind::Expression:
      type(*s.exprs[0]);
      return;
    case StmtKind::Declare:
      for (const auto& v : s.variables) declaration(*v);
      return;
    case StmtKind::If:
      condition(*s.exprs[0]);
      for (const StmtPtr& part : s.body) statement(*part);
      return;
    case StmtKind::While:
      condition(*s.exprs[0]);
      return loopBody(*s.body[0]);
    case StmtKind::For:
      return forLoop(s);
    case StmtKind::Break:
    case StmtKind::Continue:
      return jump(s);
    case StmtKind::Return:
      return returned(s);
    case StmtKind::Illuminance:
      return illuminance(s);
    case StmtKind::Illuminate:
      return illuminate(s);
    case StmtKind::Solar:
      return solar(s);
    case StmtKind::Gather:
      return gather(s);
    case StmtKind::Define:
      return function(*s.function);  // block() has made its name known
  }
}

void Checker::jump(const Stmt& s) {
  const char* const word = s.kind == StmtKind::Break ? "break" : "continue";
  if (loops_ == 0)
    messages_.error(s.place, fmt::format("'{}' stands in no loop", word));
  else if (s.count > loops_ || s.count < 1)
    messages_.error(s.place, fmt::format("'{} {}' has only {} loops around it", word, s.count, loops_));
}

void Checker::returned(Stmt& s) {
  const bool hasValue = !s.exprs.empty() && s.exprs[0];
  if (!current_) {
    if (hasValue) messages_.error(s.place, "a shader returns no value");
    return;
  }
  if (current_->result == Type{}) {
    if (hasValue) messages_.error(s.place, fmt::format("\"{}\" returns no value", current_->name));
  } else if (!hasValue) {
    messages_.error(s.place, fmt::format("\"{}\" returns a {}", current_->name, name(current_->result)));
  } else {
    expect(*s.exprs[0], current_->result, "as the result");
  }
}

// Functions are inlined, so recursion, also through other functions, is impossible (RISpec 12.3 forbids it too).
void Checker::refuseRecursion() {
  std::set<const Function*> done, open;
  const auto visit = [&](const auto& self, const Function* f) -> void {
    if (!f || done.count(f)) return;
    open.insert(f);
    for (const Function* callee : calls_[f]) {
      if (!open.count(callee)) {
        self(self, callee);
      } else {
        messages_.error(f->place, fmt::format("\"{}\" calls \"{}\", which leads back to it: shaders have no recursion",
                                              f->name, callee->name));
        calls_[f].clear();
        break;
      }
    }
    open.erase(f);
    done.insert(f);
  };
  std::vector<const Function*> all;
  for (const auto& [f, callees] : calls_) all.push_back(f);
  for (const Function* f : all) visit(visit, f);
}

Checked check(File file, Messages& messages, const RslFunctions* plugins) {
  Checked out{std::move(file), {}};
  Checker(out, &prelude().file, plugins, messages).file(out.file);
  return out;
}

}  // namespace tomales::compiler
