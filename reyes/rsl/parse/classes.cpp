// Class shaders of RSL 2. One whose methods the renderer calls at fixed places says nothing that a shader of RSL 1
// could not say: its members become variables of that, its methods functions, and the calls its last statements.
#include <fmt/format.h>

#include <algorithm>

#include "reyes/rsl/parse/parser.h"
#include "reyes/rsl/quote.h"

namespace tomales::compiler {
namespace {

/// A method that the renderer calls, and what it is called with: variables of shaders of its kind.
struct Called {
  std::string_view method;
  std::optional<ShaderKind> kind;  ///< None if it belongs to all.
  std::vector<std::string> arguments;
};

/// In the order of the calls.
const std::vector<Called>& calledMethods() {
  static const std::vector<std::string> kColors{"Ci", "Oi"};
  static const std::vector<Called> all = {{"construct", {}, {}},
                                          {"begin", {}, {}},
                                          {"displacement", ShaderKind::Displacement, {"P", "N"}},
                                          {"opacity", ShaderKind::Surface, {"Oi"}},
                                          {"prelighting", ShaderKind::Surface, kColors},
                                          {"surface", ShaderKind::Surface, kColors},
                                          {"lighting", ShaderKind::Surface, kColors},
                                          {"postlighting", ShaderKind::Surface, kColors},
                                          {"light", ShaderKind::Light, {"L", "Cl"}},
                                          {"volume", ShaderKind::Volume, kColors}};
  return all;
}

const Function* methodOf(const Stmt& body, std::string_view name) {
  for (const StmtPtr& s : body.body)
    if (s->kind == StmtKind::Define && s->function->name == name) return s->function.get();
  return nullptr;
}

/// Tells whether the renderer calls the method in a shader of that kind, which has that body. Surfaces displace too.
bool isCalled(const Called& c, ShaderKind kind, const Stmt& body) {
  const bool isSurface = kind == ShaderKind::Surface;
  if (c.method == "surface" && methodOf(body, "lighting")) return false;  // one way or the other
  return !c.kind || c.kind == kind || (isSurface && c.kind == ShaderKind::Displacement);
}

std::vector<ShaderKind> kindsOf(const Stmt& body) {
  std::vector<ShaderKind> out;
  for (const Called& c : calledMethods())
    if (c.kind && methodOf(body, c.method) && std::ranges::find(out, *c.kind) == out.end()) out.push_back(*c.kind);
  std::ranges::sort(out);  // a surface first, which has the methods of a displacement too
  return out;
}

/// What a second form of the class does not read is read by the first, or has been reported.
void withoutWarnings(Shader& s) {
  for (const auto& p : s.parameters) p->used = true;
  for (const StmtPtr& part : s.body->body)
    for (const auto& v : part->variables) v->used = v->assigned = true;
}

}  // namespace

/// A parameter of the method that has the name of the variable which it would be given is that variable.
StmtPtr Parser::callOf(Function& f, const std::vector<std::string>& arguments, const Token& word) {
  ExprPtr call = make(ExprKind::Call, word);
  call->text = f.name;
  std::vector<std::unique_ptr<Variable>> own;
  for (size_t k = 0; k < f.parameters.size(); ++k) {
    if (k >= arguments.size())
      failAt(word, fmt::format("the renderer calls {} with {} arguments", inQuotes(f.name), arguments.size()));
    if (f.parameters[k]->name == arguments[k]) continue;
    ExprPtr argument = make(ExprKind::Name, word);
    argument->text = arguments[k];
    adopt(*call, std::move(argument));
    own.push_back(std::move(f.parameters[k]));
  }
  f.parameters = std::move(own);
  auto out = std::make_unique<Stmt>();
  out->kind = StmtKind::Expression;
  out->place = f.place;
  out->exprs.push_back(std::move(call));
  return out;
}

/// Reads a class once for each kind of shader that it is: one may be a surface and a displacement.
void Parser::classShaders(File& file, const std::string& doc) {
  const Token& word = take();
  const size_t begin = at_;
  const int errors = messages_.errorCount();
  std::vector<ShaderKind> kinds{ShaderKind::Surface};
  for (size_t k = 0; k < kinds.size(); ++k) {
    at_ = begin;
    std::unique_ptr<Shader> s = shader(kinds[k], doc);
    if (messages_.errorCount() > errors) return;
    if (k == 0) kinds = kindsOf(*s->body);
    if (kinds.empty()) refuseRsl2(word, "a class that is no surface, displacement, light or volume by its methods");
    s->kind = kinds[k];
    std::vector<StmtPtr> calls;
    for (const Called& c : calledMethods())
      for (StmtPtr& part : s->body->body) {
        if (part->kind != StmtKind::Define || part->function->name != c.method) continue;
        if (isCalled(c, s->kind, *s->body))
          calls.push_back(callOf(*part->function, c.arguments, word));
        else
          *part = Stmt();  // its variables are of another kind of shader
      }
    if (k > 0) withoutWarnings(*s);
    for (StmtPtr& call : calls) s->body->body.push_back(std::move(call));
    file.shaders.push_back(std::move(s));
  }
}

}  // namespace tomales::compiler
