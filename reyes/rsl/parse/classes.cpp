// Class shaders of RSL 2. A class whose methods the renderer calls at fixed places is equivalent to a shader of RSL 1:
// its members become variables, its methods functions, and the calls its last statements.
#include <fmt/format.h>

#include <algorithm>

#include "reyes/rsl/globals.h"
#include "reyes/rsl/parse/parser.h"
#include "reyes/rsl/quote.h"

namespace tomales::compiler {
namespace {

/// A method that the renderer calls, and its arguments, which are variables of shaders of its kind.
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
                                          {"diffuselighting", ShaderKind::Surface, kColors},
                                          {"specularlighting", ShaderKind::Surface, kColors},
                                          {"postlighting", ShaderKind::Surface, kColors},
                                          {"light", ShaderKind::Light, {"L", "Cl"}},
                                          {"volume", ShaderKind::Volume, kColors}};
  return all;
}

bool hasMethod(const Stmt& body, std::initializer_list<std::string_view> names) {
  return std::ranges::any_of(body.body, [&](const StmtPtr& s) {
    return s->kind == StmtKind::Define && std::ranges::find(names, s->function->name) != names.end();
  });
}

bool isOfKind(const Called& c, ShaderKind kind) {
  return !c.kind || c.kind == kind || (kind == ShaderKind::Surface && c.kind == ShaderKind::Displacement);
}

/// Tells whether another method is called instead. The class may still call this one itself.
bool isReplaced(const Called& c, const Stmt& body) {
  if (c.method == "surface") return hasMethod(body, {"lighting"});
  if (c.method == "diffuselighting" || c.method == "specularlighting") return hasMethod(body, {"surface", "lighting"});
  return false;
}

/// Returns the kinds of shaders that a class is, from its methods. A surface comes first; it may have the methods of a
/// displacement too.
std::vector<ShaderKind> kindsOf(const Stmt& body) {
  std::vector<ShaderKind> out;
  if (hasMethod(body, {"surface", "lighting", "diffuselighting", "specularlighting"}))
    out.push_back(ShaderKind::Surface);
  if (hasMethod(body, {"light"})) out.push_back(ShaderKind::Light);
  if (hasMethod(body, {"displacement"})) out.push_back(ShaderKind::Displacement);
  if (hasMethod(body, {"volume"})) out.push_back(ShaderKind::Volume);
  return out;
}

/// Replaces parameters of a method by the variables that they are given, if they have the same name. Such a parameter
/// is removed, and so is the argument where the class itself calls the method.
class SharedVariables {
 public:
  /// Takes out the parameters.
  SharedVariables(Function& f, const std::vector<std::string>& arguments)
      : method_(f.name), count_(f.parameters.size()) {
    std::vector<std::unique_ptr<Variable>> own;
    for (size_t k = 0; k < count_; ++k)
      if (f.parameters[k]->name == arguments[k])
        shared_.emplace_back(k, arguments[k]);
      else
        own.push_back(std::move(f.parameters[k]));
    f.parameters = std::move(own);
  }

  void takeOutOf(Stmt& s) const {
    for (const ExprPtr& e : s.exprs)
      if (e) takeOutOf(*e);
    for (const StmtPtr& part : s.body)
      if (part) takeOutOf(*part);
    takeOutOf(s.variables);
    if (s.function) {
      takeOutOf(s.function->parameters);
      takeOutOf(*s.function->body);
    }
  }

 private:
  void takeOutOf(const std::vector<std::unique_ptr<Variable>>& variables) const {
    for (const auto& v : variables)
      if (v->initial) takeOutOf(*v->initial);
  }
  void takeOutOf(Expr& e) const {
    for (const ExprPtr& a : e.args)
      if (a) takeOutOf(*a);
    const auto isShared = [&](const std::pair<size_t, std::string>& s) {
      return e.args[s.first]->kind == ExprKind::Name && e.args[s.first]->text == s.second;
    };
    if (e.kind != ExprKind::Call || e.text != method_ || e.args.size() != count_) return;
    if (!std::ranges::all_of(shared_, isShared)) return;
    for (auto s = shared_.rbegin(); s != shared_.rend(); ++s)
      e.args.erase(e.args.begin() + static_cast<std::ptrdiff_t>(s->first));
  }

  std::string method_;
  size_t count_;
  std::vector<std::pair<size_t, std::string>> shared_;  ///< Places among the parameters, rising, and names.
};

/// Keeps a second form of the class from warnings: the first form has had them.
void withoutWarnings(Shader& s) {
  for (const auto& p : s.parameters) p->used = true;
  for (const StmtPtr& part : s.body->body)
    for (const auto& v : part->variables) v->used = v->assigned = true;
}

}  // namespace

/// Reports what the renderer cannot call.
void Parser::checkMethod(const Function& f, const std::vector<std::string>& arguments) {
  const auto refuse = [&](const std::string& why) {
    messages_.error(f.place, why, static_cast<int32_t>(f.name.size()));
    throw Failed{};
  };
  if (f.parameters.size() > arguments.size())
    refuse(fmt::format("the renderer calls {} with {}", inQuotes(f.name),
                       arguments.empty() ? "nothing" : fmt::format("{} alone", fmt::join(arguments, " and "))));
  for (size_t k = 0; k < f.parameters.size(); ++k)
    if (const Base base = findGlobal(arguments[k])->base; !f.parameters[k]->type.is(base))
      refuse(fmt::format("the renderer gives {} to {}, a {}, but this is a {}", arguments[k], inQuotes(f.name),
                         name(base), name(f.parameters[k]->type)));
}

StmtPtr Parser::callOf(const Function& f, const std::vector<std::string>& arguments, const Token& word) {
  ExprPtr call = make(ExprKind::Call, word);
  call->text = f.name;
  for (size_t k = 0; k < f.parameters.size(); ++k) {
    ExprPtr argument = make(ExprKind::Name, word);
    argument->text = arguments[k];
    adopt(*call, std::move(argument));
  }
  auto out = std::make_unique<Stmt>();
  out->kind = StmtKind::Expression;
  out->place = f.place;
  out->exprs.push_back(std::move(call));
  return out;
}

/// Reads a class once for each kind of shader that it is: one may be a surface and a displacement.
void Parser::classShaders(File& file, const Token& word, const std::string& doc) {
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
    for (const Called& c : calledMethods()) {
      const Function* first = nullptr;
      for (StmtPtr& part : s->body->body) {
        if (part->kind != StmtKind::Define || part->function->name != c.method) continue;
        if (!isOfKind(c, s->kind)) {
          *part = Stmt();  // its variables are of another kind of shader
        } else if (!isReplaced(c, *s->body)) {
          Function& f = *part->function;
          if (first) {
            messages_.error(f.place, fmt::format("the renderer calls one {} alone", inQuotes(f.name)));
            throw Failed{};
          }
          first = &f;
          checkMethod(f, c.arguments);
          calls.push_back(callOf(f, c.arguments, word));
          const SharedVariables shared(f, c.arguments);
          shared.takeOutOf(*s->body);
          shared.takeOutOf(*calls.back());
        }
      }
    }
    if (k > 0) withoutWarnings(*s);
    for (StmtPtr& call : calls) s->body->body.push_back(std::move(call));
    file.shaders.push_back(std::move(s));
  }
}

}  // namespace tomales::compiler
