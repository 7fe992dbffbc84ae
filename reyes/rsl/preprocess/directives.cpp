#include <fmt/format.h>

#include "reyes/rsl/preprocess/condition.h"
#include "reyes/rsl/preprocess/preprocessor.h"
#include "reyes/rsl/quote.h"

namespace tomales::compiler {
namespace {

constexpr size_t kMostNameBytes = 4096;  ///< The longest name of an included file.

bool isConditional(std::string_view name) {
  return name == "if" || name == "ifdef" || name == "ifndef" || name == "elif" || name == "else" || name == "endif";
}

}  // namespace

void Preprocessor::skipLine() { files_.back().lexer.restOfLine(); }

/// Reads a directive, after the '#' that begins a line.
void Preprocessor::directive(Place place) {
  const size_t depth = files_.size();
  const Lexeme name = files_.back().lexer.nextInLine();
  if (name.isEnd()) return;
  if (name.kind == LexemeKind::Name && isConditional(name.text)) {
    conditionalDirective(name.text, place);
  } else if (isActive()) {
    plainDirective(name, place);
  }
  if (files_.size() == depth) skipLine();
}

void Preprocessor::conditionalDirective(std::string_view name, Place place) {
  OpenFile& file = files_.back();
  if (name.starts_with("if")) {
    beginConditional(name, place, file.lexer);
  } else if (file.conditionals.empty()) {
    messages_.error(place, fmt::format("'#{}' without an '#if' before it", name));
  } else if (name == "endif") {
    file.conditionals.pop_back();
  } else {
    nextBranch(name, place, file.lexer);
  }
}

void Preprocessor::beginConditional(std::string_view name, Place place, Lexer& lexer) {
  Conditional c{.place = place, .outerActive = isActive()};
  if (c.outerActive)
    c.active = name == "if" ? evaluate(lexer, place) : isDefined(lexer, name, place) == (name == "ifdef");
  c.anyTaken = c.active;
  files_.back().conditionals.push_back(c);
}

void Preprocessor::nextBranch(std::string_view name, Place place, Lexer& lexer) {
  Conditional& c = files_.back().conditionals.back();
  if (c.hadElse) {
    messages_.error(place, fmt::format("'#{}' after the '#else' of the same '#if'", name));
    messages_.note(c.place, "the '#if' is here");
  }
  c.hadElse = c.hadElse || name == "else";
  const bool open = c.outerActive && !c.anyTaken;
  const bool taken = open && (name == "else" || evaluate(lexer, place));
  Conditional& same = files_.back().conditionals.back();
  same.active = taken;
  same.anyTaken = same.anyTaken || taken;
}

bool Preprocessor::isDefined(Lexer& lexer, std::string_view directive, Place place) {
  const Lexeme name = lexer.nextInLine();
  if (name.kind == LexemeKind::Name) return macros_.find(name.text) != nullptr;
  messages_.error(name.isEnd() ? place : name.place, fmt::format("'#{}' needs the name of a macro", directive));
  return false;
}

bool Preprocessor::evaluate(Lexer& lexer, Place place) {
  const int errors = messages_.errorCount();
  const std::vector<Lexeme> expression = expanded(withDefinedDone(lexer));
  return messages_.errorCount() == errors && !stopped_ && holds(expression, place, messages_);
}

/// Reads the rest of the line, with 1 or 0 for each "defined NAME" and "defined(NAME)".
std::vector<Lexeme> Preprocessor::withDefinedDone(Lexer& lexer) {
  std::vector<Lexeme> out;
  for (Lexeme l = lexer.nextInLine(); !l.isEnd(); l = lexer.nextInLine()) {
    if (l.kind == LexemeKind::Name && l.text == "defined") {
      Lexeme name = lexer.nextInLine();
      const bool inBrackets = name.is("(");
      if (inBrackets) name = lexer.nextInLine();
      if (name.kind != LexemeKind::Name || (inBrackets && !lexer.nextInLine().is(")"))) {
        messages_.error(l.place, "'defined' needs the name of a macro, or one in brackets", l.length());
        return {};
      }
      l.kind = LexemeKind::Number;
      l.text = macros_.find(name.text) ? "1" : "0";
    }
    out.push_back(l);
  }
  return out;
}

void Preprocessor::plainDirective(const Lexeme& name, Place place) {
  Lexer& lexer = files_.back().lexer;
  if (name.text == "include") {
    include(place);
  } else if (name.text == "define") {
    if (const MacroPtr macro = readDefinition(lexer, place, messages_)) macros_.define(macro, messages_);
  } else if (name.text == "undef") {
    const Lexeme macro = lexer.nextInLine();
    if (macro.kind != LexemeKind::Name) messages_.error(place, "'#undef' needs the name of a macro");
    macros_.undefine(macro.text);
  } else if (name.text == "error") {
    messages_.error(place, "#error " + std::string(lexer.restOfLine()));
  } else if (name.text == "warning") {
    messages_.warning(place, "#warning " + std::string(lexer.restOfLine()));
  } else if (name.text != "pragma" && name.text != "line" && name.text != "ident" && name.kind != LexemeKind::Number) {
    // Messages name the file that is really read, so #line is accepted and changes nothing.
    static const std::vector<std::string> known{"include", "define", "undef", "if",      "ifdef", "ifndef", "elif",
                                                "else",    "endif",  "error", "warning", "line",  "pragma"};
    const std::vector<std::string> near = nearNames(name.text, known);
    messages_.error(name.place, inQuotes(name.text) + " is no directive" + (near.empty() ? "" : "; '" + near[0] + "'?"),
                    name.length());
  }
}

void Preprocessor::include(Place place) {
  Lexer& lexer = files_.back().lexer;
  if (const std::string_view angled = lexer.angledName(&place); !angled.empty())
    return includeFile(angled.substr(1, angled.size() - 2), false, place);
  std::vector<Lexeme> words;
  for (Lexeme l = lexer.nextInLine(); !l.isEnd(); l = lexer.nextInLine()) words.push_back(l);
  words = expanded(std::move(words));
  if (!words.empty() && words[0].kind == LexemeKind::String && !words[0].isOpen) {
    const std::string_view text = words[0].text;
    return includeFile(text.substr(1, text.size() - 2), true, sources_.outermost(words[0].place));
  }
  std::string spelled;
  for (const Lexeme& l : words)
    if (spelled.size() < kMostNameBytes) spelled += l.text;
  if (spelled.size() > 2 && spelled.front() == '<' && spelled.back() == '>')
    return includeFile(spelled.substr(1, spelled.size() - 2), false, place);
  messages_.error(place, "'#include' needs \"NAME\" or <NAME>");
}

void Preprocessor::includeFile(std::string_view name, bool isQuoted, Place place) {
  if (files_.size() > kMostIncludeDepth)
    return stop(place, fmt::format("files include each other more than {} deep", kMostIncludeDepth));
  if (++includes_ > kMostIncludes) return stop(place, fmt::format("more than {} files are included", kMostIncludes));
  ReadFile file = search_.find(name, isQuoted, files_.back().folder);
  bytesIn_ += file.text.size();
  if (bytesIn_ > kMostBytes) return stop(place, fmt::format("more than {} MiB are included", kMostBytes >> 20));
  if (!file.failure.empty())
    return messages_.error(place, fmt::format("cannot include {}: {}", inQuotes(name), file.failure),
                           static_cast<int32_t>(name.size() + 2));
  skipLine();
  const std::string folder = folderOf(file.path);
  const int32_t index = sources_.addFile({std::move(file.path), std::move(file.text), place});
  files_.push_back({Lexer(index, sources_.file(index).text, made_, messages_), folder, {}});
}

}  // namespace tomales::compiler
