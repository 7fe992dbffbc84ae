// Shaders' text in, short texts of what became of it out.
#pragma once
#include <fmt/format.h>

#include "reyes/rsl/parse.h"

namespace tomales::compiler {

/// A text, and what is made of it.
struct Case {
  const char *text, *expected;
};

/// A text as a file "a.sl", read as far as asked.
struct Front {
  Sources sources;
  Messages messages;
  std::vector<Token> tokens;
  File file;

  explicit Front(const std::string& text, const PreprocessOptions& options = {}) {
    tokens = preprocessText("a.sl", text, options, sources, messages);
  }
  Front& parsed() {
    file = parse(tokens, messages);
    return *this;
  }
};

/// Words with a blank between them, strings in quotes.
inline std::string spelled(const std::vector<Token>& tokens) {
  std::string out;
  for (const Token& t : tokens) {
    if (t.kind == TokenKind::End) continue;
    if (!out.empty()) out += ' ';
    out += t.kind == TokenKind::String ? '"' + t.text + '"' : t.text;
  }
  return out;
}

/// What the preprocessor makes of a text, with the first message after it if there is one.
inline std::string preprocessedText(const std::string& text, const PreprocessOptions& options = {}) {
  const Front front(text, options);
  return spelled(front.tokens) + (front.messages.all().empty() ? "" : " !" + front.messages.all()[0].text);
}

/// "LINE:COLUMN: TEXT" for each message, notes with "note: " before the text.
inline std::string messagesOf(const Front& front) {
  std::string out;
  for (const Message& m : front.messages.all()) {
    constexpr const char* kSeverities[] = {"", "warning: ", "note: "};
    out += fmt::format("{}{}:{}: {}{}", out.empty() ? "" : "\n", m.place.line, m.place.column,
                       kSeverities[static_cast<size_t>(m.severity)], m.text);
  }
  return out;
}

/// Parses a file with these lines in the body of a shader.
inline std::string treeOf(const std::string& statements) {
  Front front("surface x() {\n" + statements + "\n}");
  front.parsed();
  constexpr std::string_view kHead = "surface x\n  block\n";
  const std::string all = dump(front.file);
  if (front.messages.hasErrors()) return messagesOf(front);
  return all.starts_with(kHead) ? all.substr(kHead.size()) : all;
}

/// An expression with a bracket around each operator: "(+ a (* b c))".
inline std::string bracketed(const Expr& e) {
  std::string out = e.kind == ExprKind::Number ? fmt::format("{}", e.number) : e.text;
  if (e.kind == ExprKind::String) return '"' + e.text + '"';
  if (e.kind == ExprKind::Cast) out = name(e.written) + (e.hasSpace ? " \"" + e.text + '"' : "");
  if (e.args.empty() && e.kind != ExprKind::Call) return out;
  if (e.kind == ExprKind::Tuple) out = "tuple";
  for (const ExprPtr& arg : e.args) out += ' ' + bracketed(*arg);
  return '(' + out + ')';
}

inline std::string expressionOf(const std::string& text) {
  Front front("surface x() { " + text + "; }");
  front.parsed();
  if (front.messages.hasErrors()) return messagesOf(front);
  return bracketed(*front.file.shaders.at(0)->body->body.at(0)->exprs.at(0));
}

}  // namespace tomales::compiler
