#include "reyes/rsl/preprocess/preprocessor.h"

#include <fmt/format.h>

#include "reyes/rsl/quote.h"

namespace tomales::compiler {

Preprocessor::Preprocessor(const PreprocessOptions& options, const std::string& ownFolder, Sources& sources,
                           Messages& messages)
    : sources_(sources), messages_(messages), search_(options, ownFolder), ownFolder_(ownFolder) {
  predefine(options);
}

void Preprocessor::predefine(const PreprocessOptions& options) {
  std::vector<PreprocessOptions::Definition> all{{"TOMALES", "1"}};
  all.insert(all.end(), options.definitions.begin(), options.definitions.end());
  for (const auto& [name, value] : all) {
    Lexer lexer(-1, made_.keep(name + " " + value), made_, messages_);
    if (const MacroPtr macro = readDefinition(lexer, {}, messages_)) {
      macro->place = {};
      for (MacroPiece& piece : macro->pieces) piece.lexeme.place = {};
      macros_.define(macro, messages_);
    }
  }
}

std::vector<Token> Preprocessor::run(int32_t file) {
  files_.push_back({Lexer(file, sources_.file(file).text, made_, messages_), ownFolder_, {}});
  Place last{file, 1, 1, -1};
  while (!isDone()) {
    const Lexeme l = next();
    if (l.place.line > 0) last = l.place;
    if (!l.isEnd()) put(l);
    if (messages_.errorCount() > Messages::kMostErrors) break;
  }
  if (stopped_) out_.clear();  // A part of a shader would only cause more messages.
  out_.push_back({.place = last});
  return std::move(out_);
}

void Preprocessor::stop(Place place, std::string text) {
  if (!stopped_) messages_.error(place, std::move(text));
  stopped_ = true;
}

Lexeme Preprocessor::next() {
  for (;;) {
    Lexeme l = read();
    if (l.kind != LexemeKind::Name || l.isFinal) return l;
    Macro* macro = macros_.find(l.text);
    if (!macro) return l;
    if (macro->active > 0) {
      l.isFinal = true;
      return l;
    }
    if (macro->kind != Macro::Kind::Defined) return ownValue(l, *macro);
    if (!enter(l, *macro)) return l;
  }
}

Lexeme Preprocessor::read() {
  while (!rows_.empty() && !stopped_) {
    Row& row = rows_.back();
    if (row.at < row.lexemes.size()) return row.lexemes[row.at++];
    if (row.isArgument) return {};
    if (row.macro) --row.macro->active;
    rows_.pop_back();
  }
  return readFromFiles();
}

void Preprocessor::putBack(const Lexeme& lexeme) {
  if (!lexeme.isEnd()) rows_.push_back({.lexemes = {lexeme}});
}

Lexeme Preprocessor::readFromFiles() {
  while (!isDone()) {
    const Lexeme l = files_.back().lexer.next();
    if (l.isEnd()) {
      closeFile();
      return l;
    }
    if (l.startsLine && l.is("#")) {
      directive(l.place);
    } else if (isActive()) {
      return l;
    }
  }
  return {};
}

void Preprocessor::closeFile() {
  for (const Conditional& c : files_.back().conditionals)
    messages_.error(c.place, "this condition is not closed: there is no '#endif' after it");
  files_.pop_back();
}

namespace {

std::vector<Token> preprocessed(ReadFile file, const std::string& folder, const PreprocessOptions& options,
                                Sources& sources, Messages& messages) {
  const int32_t index = sources.addFile({file.path, std::move(file.text), {}});
  if (!file.failure.empty()) messages.error({index, 0, 0, -1}, "the shader cannot be read: " + file.failure);
  return Preprocessor(options, folder, sources, messages).run(index);
}

}  // namespace

std::vector<Token> preprocess(const std::string& path, const PreprocessOptions& options, Sources& sources,
                              Messages& messages) {
  return preprocessed(readFile(path), folderOf(path), options, sources, messages);
}

std::vector<Token> preprocessText(const std::string& name, const std::string& text, const PreprocessOptions& options,
                                  Sources& sources, Messages& messages) {
  return preprocessed(asFile(name, text), "", options, sources, messages);
}

std::string dump(const std::vector<Token>& tokens, const Sources& sources) {
  constexpr const char* kNames[] = {"name", "number", "string", "punctuator", "end"};
  std::string out;
  for (const Token& t : tokens) {
    const char* kind = kNames[static_cast<size_t>(t.kind)];
    out += fmt::format("{} {} {}\n", sources.text(t.place), kind, t.kind == TokenKind::End ? "" : inQuotes(t.text));
  }
  return out;
}

}  // namespace tomales::compiler
