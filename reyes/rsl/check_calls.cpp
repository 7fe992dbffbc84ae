#include <fmt/format.h>

#include <algorithm>

#include "reyes/rsl/checker.h"

namespace tomales::compiler {
namespace {

/// Returns the distance of an argument's type from the slot of a built-in function; negative if it does not fit.
int suits(const Slot& slot, const Expr& e, int far) {
  if (e.type == kUnknown) return 0;
  if (slot.any) return !slot.array || e.type.isArray() ? 0 : -1;
  return far;
}

Type typeOf(const Slot& slot) { return {slot.base, slot.array ? kOpenArray : 0}; }

std::string argumentTypes(const Expr& call) {
  std::string out;
  for (const ExprPtr& a : call.args) out += (out.empty() ? "" : ", ") + name(a->type);
  return out;
}

std::string signature(const Builtin& b) {
  std::string out = name(Type{b.result}) + " " + b.name + "(";
  for (const Slot& s : b.slots)
    out += std::string(&s == b.slots.data() ? "" : ", ") + (s.output ? "output " : "") +
           (s.any ? "any type" : name(typeOf(s)));
  return out + (b.more ? ", ...)" : ")");
}

std::string signature(const Function& f) {
  std::string out = name(f.result) + " " + f.name + "(";
  for (const auto& p : f.parameters)
    out += std::string(p == f.parameters.front() ? "" : ", ") + (p->output ? "output " : "") + name(p->type);
  return out + ")";
}

bool takesList(const Builtin& b) {
  switch (b.emit) {
    case Emit::List:
    case Emit::Traced:
    case Emit::Texture:
    case Emit::Environment:
    case Emit::Shadow:
      return true;
    default:
      return false;
  }
}

}  // namespace

int Checker::fit(const Expr& call, const Builtin& b) const {
  const size_t n = b.slots.size();
  if (call.args.size() < n || (call.args.size() > n && !b.more)) return -1;
  int sum = 0;
  for (size_t i = 0; i < call.args.size(); ++i) {
    const Expr& a = *call.args[i];
    if (i >= n && (takesList(b) || b.emit == Emit::Print)) break;
    const Slot& slot = b.slots[std::min(i, n - 1)];
    const int far = suits(slot, a, distance(a, typeOf(slot)));
    if (far < 0) return -1;
    sum += far;
  }
  // The first argument after the fixed ones of an optional list is a name; texture() takes coordinates before it.
  if (call.args.size() > n && (b.emit == Emit::List || b.emit == Emit::Traced) &&
      !call.args[n]->type.is(Base::String) && call.args[n]->type != kUnknown)
    return -1;
  return sum;
}

int Checker::fit(const Expr& call, const Function& f) const {
  if (call.args.size() != f.parameters.size()) return -1;
  int sum = 0;
  for (size_t i = 0; i < call.args.size(); ++i) {
    const int far = distance(*call.args[i], f.parameters[i]->type);
    if (far < 0) return -1;
    sum += far;
  }
  return sum;
}

std::vector<const Function*> Checker::functionsOf(std::string_view name) const {
  std::vector<const Function*> out;
  for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope) {
    const auto [from, to] = scope->functions.equal_range(name);
    for (auto it = from; it != to; ++it) out.push_back(it->second);
  }
  return out;
}

// A function of the file takes precedence over a built-in one of the same name, if the arguments fit.
Type Checker::typeOfCall(Expr& e) {
  for (const ExprPtr& a : e.args) type(*a);
  const std::vector<const Function*> own = functionsOf(e.text);
  const Function* best = nullptr;
  int least = -1;
  for (const Function* f : own)
    if (const int far = fit(e, *f); far >= 0 && (!best || far < least)) {
      best = f;
      least = far;
    }
  if (best) return typeOfFunction(e, *best);

  std::vector<const Function*> all = own;
  if (prelude_)
    for (const auto& f : prelude_->functions) {
      if (f->name != e.text) continue;
      all.push_back(f.get());
      if (const int far = fit(e, *f); far >= 0 && (!best || far < least)) {
        best = f.get();
        least = far;
      }
    }
  const std::vector<const Builtin*> rows = builtinsOf(e.text);
  const Builtin* chosen = nullptr;
  for (const Builtin* b : rows)
    if (const int far = fit(e, *b); far >= 0 && (least < 0 || far < least)) {
      chosen = b;
      least = far;
    }
  if (chosen) return typeOfBuiltin(e, *chosen);
  if (best) return typeOfFunction(e, *best);
  if (rows.empty() && all.empty()) {
    if (becomesParameter(e)) return type(e);
    unknownFunction(e);
    return Type{Base::Float};
  }
  noFit(e, all);
  return kUnknown;
}

Type Checker::typeOfFunction(Expr& e, const Function& f) {
  e.function = &f;
  calls_[current_].insert(&f);
  for (size_t i = 0; i < e.args.size(); ++i) {
    const Variable& p = *f.parameters[i];
    expect(*e.args[i], p.type, fmt::format("as \"{}\" of \"{}\"", p.name, f.name).c_str());
    if (p.output) assigned(*e.args[i], fmt::format("for the output \"{}\" of \"{}\"", p.name, f.name).c_str());
  }
  return f.result;
}

/// Finds the functions of the language, or, where it has none of that name, those of plugins.
std::vector<const Builtin*> Checker::builtinsOf(const std::string& name) {
  std::vector<const Builtin*> out;
  const auto [first, count] = rowsOf(name);
  for (int32_t row = first; row < first + count; ++row) out.push_back(&builtins()[static_cast<size_t>(row)]);
  if (count > 0 || !plugins_) return out;
  const auto [known, isNew] = plugged_.try_emplace(name);
  if (isNew) {
    for (const TmFunction* f : plugins_->named(name))
      if (const std::optional<Builtin> b = builtinOf(*f)) {
        pluginRows_->push_back(*b);
        known->second.push_back(&pluginRows_->back());
      }
  }
  return known->second;
}

Type Checker::typeOfBuiltin(Expr& e, const Builtin& b) {
  e.builtin = &b;
  const size_t n = b.slots.size();
  for (size_t i = 0; i < e.args.size(); ++i) {
    if (i >= n && takesList(b)) break;
    if (i >= n && b.emit == Emit::Print) continue;
    const Slot& slot = b.slots[std::min(i, n - 1)];
    const std::string where = fmt::format("as argument {} of {}()", i + 1, b.name);
    if (!slot.any) expect(*e.args[i], typeOf(slot), where.c_str());
    if (slot.output) assigned(*e.args[i], where.c_str());
  }
  if (b.op == Op::Smoothstep && constantOf(*e.args[1]) && constantOf(*e.args[0]) > constantOf(*e.args[1]))
    messages_.warning(
        e.place,
        "smoothstep() whose first edge is the greater one is a hard step; 1 - smoothstep(least, greatest, x) falls "
        "smoothly",
        e.length);
  if (takesList(b)) {
    size_t from = n;
    while (from < e.args.size() && !e.args[from]->type.is(Base::String)) ++from;
    if (b.emit == Emit::Texture && from != n && from != n + 2 && from != n + 8)
      messages_.error(e.place, fmt::format("{}() takes no coordinates, or s and t, or those of four corners", b.name),
                      e.length);
    for (size_t i = n; i < from; ++i)
      expect(*e.args[i], b.emit == Emit::Texture ? Type{Base::Float} : typeOf(b.slots.back()), "as a coordinate");
    list(e.args, from, b.name);
  }
  return {b.result};
}

void Checker::list(std::vector<ExprPtr>& entries, size_t from, std::string_view function) {
  if ((entries.size() - from) % 2 != 0)
    messages_.error(entries.back()->place, fmt::format("the list of {}() needs a value after each name", function));
  for (size_t i = from; i + 1 < entries.size(); i += 2) {
    if (!entries[i]->checked) type(*entries[i]);
    if (!entries[i + 1]->checked) type(*entries[i + 1]);
    if (distance(*entries[i], {Base::String}) < 0)
      messages_.error(entries[i]->place, fmt::format("the list of {}() needs a name here, and this is a {}", function,
                                                     name(entries[i]->type)));
    else if (entries[i]->kind == ExprKind::String && isFilled(function, entries[i]->text))
      assigned(*entries[i + 1], fmt::format("for \"{}\" of {}()", entries[i]->text, function).c_str());
  }
}

bool isFilled(std::string_view function, std::string_view name) {
  const auto begins = [&](std::string_view with) { return name.substr(0, with.size()) == with; };
  if (function == "gather")
    return begins("surface:") || begins("primitive:") || begins("ray:") || begins("attribute:") ||
           begins("environment:") || name == "volume:Ci" || name == "volume:Oi" || name == "effectivedistance";
  if (function == "illuminance") return begins("light:");
  if (function == "texture3d")
    return name != "coordsystem" && name != "filterradius" && name != "filterscale" && name != "maxdepth" &&
           name != "lerp";
  if (function == "occlusion" || function == "indirectdiffuse" || function == "indirect")
    return name == "environmentcolor" || name == "environmentdir" || name == "occlusion";
  return false;
}

// evalparam("name", x) of PRMan 19 and 20 assigns to x a parameter of the shader, which a pattern may drive there.
bool Checker::becomesParameter(Expr& e) {
  if (e.text != "evalparam" || e.args.size() != 2 || e.args[0]->kind != ExprKind::String ||
      (e.args[1]->kind != ExprKind::Name && e.args[1]->kind != ExprKind::Index))
    return false;
  const Variable* parameter = find(e.args[0]->text);
  if (!parameter || parameter->global >= 0) return false;
  const auto make = [&](ExprKind kind, std::string text) {
    auto out = std::make_unique<Expr>();
    out->kind = kind;
    out->place = e.place;
    out->length = e.length;
    out->text = std::move(text);
    return out;
  };
  auto assignment = make(ExprKind::Assign, "="), yes = make(ExprKind::Number, "1");
  yes->number = 1;
  assignment->args.push_back(std::move(e.args[1]));
  assignment->args.push_back(make(ExprKind::Name, e.args[0]->text));
  e.kind = ExprKind::Comma;
  e.args.clear();
  e.args.push_back(std::move(assignment));
  e.args.push_back(std::move(yes));
  return true;
}

// The function may be one of a library that other renderers load (DSO shadeops), so the shader runs and reports it.
void Checker::unknownFunction(Expr& e) {
  e.missing = true;
  if (!told_.insert({1, e.text}).second) return;
  if (Variable* v = find(e.text)) {
    v->used = true;
    return messages_.error(e.place, fmt::format("\"{}\" is a variable, and no function", e.text), e.length);
  }
  std::vector<std::string> known = functionNames();
  known.insert(known.end(), typeNames().begin(), typeNames().end());  // a cast looks like a call
  const auto near = nearNames(e.text, known);
  messages_.missing(e.place,
                    fmt::format("there is no function \"{}\"{}: its value is a loud one", e.text,
                                near.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", near.front())),
                    e.length);
}

void Checker::noFit(Expr& e, const std::vector<const Function*>& functions) {
  messages_.error(e.place, fmt::format("there is no {}({})", e.text, argumentTypes(e)), e.length);
  const auto isOfPrelude = [&](const Function* f) {
    return prelude_ && std::any_of(prelude_->functions.begin(), prelude_->functions.end(),
                                   [f](const auto& other) { return other.get() == f; });
  };
  for (const Function* f : functions)  // places of the prelude are not in the user's files
    messages_.note(isOfPrelude(f) ? Place{} : f->place, fmt::format("there is {}", signature(*f)));
  std::vector<const Builtin*> rows = builtinsOf(e.text);
  constexpr size_t kMostShown = 4;
  rows.resize(std::min(rows.size(), kMostShown));
  for (const Builtin* b : rows) messages_.note({}, fmt::format("there is {}", signature(*b)));
}

}  // namespace tomales::compiler
