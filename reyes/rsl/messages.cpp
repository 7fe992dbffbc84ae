#include <fmt/format.h>

#include <algorithm>

#include "reyes/rsl/source.h"

namespace tomales::compiler {
namespace {

constexpr size_t kMostShown = 200;  ///< Most characters of a line that are shown, around the place of the message.
constexpr int kMostNotes = 8;  ///< Most notes on nested macros and on files that are shown; the outermost always is.

const char* name(Severity severity) {
  switch (severity) {
    case Severity::Error:
      return "error";
    case Severity::Warning:
      return "warning";
    case Severity::Note:
      return "note";
  }
  return "";
}

bool continuesCharacter(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Returns the line and, below it, a caret with a tail. Tabs are repeated before the caret, so that it fits in any
/// terminal.
std::string pointedAt(std::string_view line, size_t column, size_t length) {
  size_t at = std::min(column - 1, line.size());
  if (line.size() > kMostShown) {
    const size_t begin = std::min(at > kMostShown / 2 ? at - kMostShown / 2 : 0, line.size() - kMostShown);
    line = line.substr(begin, kMostShown);
    at -= begin;
  }
  std::string shown, below;
  for (size_t i = 0; i < line.size(); ++i) {
    const bool control = static_cast<unsigned char>(line[i]) < 0x20 || line[i] == 0x7f;
    shown += control && line[i] != '\t' ? '?' : line[i];
    if (i < at && !continuesCharacter(line[i])) below += line[i] == '\t' ? '\t' : ' ';
  }
  below += '^';
  const size_t tail = std::min(length, line.size() - at);
  if (tail > 1) below.append(tail - 1, '~');
  return fmt::format("{}\n{}\n", shown, below);
}

std::string oneMessage(const Sources& sources, Severity severity, Place place, size_t length, std::string_view text) {
  const bool nowhere = place.file < 0 && severity == Severity::Note;  // the note is about what is part of the renderer
  std::string out = nowhere ? fmt::format("{}: {}\n", name(severity), text)
                            : fmt::format("{}: {}: {}\n", sources.text(place), name(severity), text);
  const std::string_view line = sources.line(place.file, place.line);
  if (!line.empty() && place.column > 0) out += pointedAt(line, static_cast<size_t>(place.column), length);
  return out;
}

std::string macroNotes(const Sources& sources, Place place) {
  std::string out;
  for (int shown = 0; place.expansion >= 0; ++shown) {
    const Expansion& e = sources.expansion(place.expansion);
    place = e.use;
    if (shown < kMostNotes || place.expansion < 0)
      out += oneMessage(sources, Severity::Note, place, e.macro.size(), "in expansion of macro '" + e.macro + "'");
  }
  return out;
}

std::string includeLines(const Sources& sources, Place place) {
  std::string out;
  for (int shown = 0; place.file >= 0 && sources.file(place.file).includedFrom.line > 0; ++shown) {
    place = sources.file(place.file).includedFrom;
    if (shown < kMostNotes || sources.file(place.file).includedFrom.line == 0)
      out += fmt::format("  included from {}:{}\n", sources.file(place.file).path, place.line);
  }
  return out;
}

}  // namespace

bool Messages::isTold(Severity severity, Place place, const std::string& text) const {
  return std::ranges::any_of(
      all_, [&](const Message& m) { return m.severity == severity && m.place == place && m.text == text; });
}

void Messages::error(Place place, std::string text, int32_t length) {
  if (isTold(Severity::Error, place, text)) return void(keeps_ = false);
  ++errors_;
  add(Severity::Error, place, std::move(text), length);
}

void Messages::missing(Place place, std::string text, int32_t length) {
  if (!isTold(Severity::Warning, place, text)) ++missing_;
  warning(place, std::move(text), length);
}

void Messages::warning(Place place, std::string text, int32_t length) {
  if (isTold(Severity::Warning, place, text)) return void(keeps_ = false);
  ++warnings_;
  add(Severity::Warning, place, std::move(text), length);
}

void Messages::note(Place place, std::string text, int32_t length) {
  add(Severity::Note, place, std::move(text), length);
}

void Messages::add(Severity severity, Place place, std::string text, int32_t length) {
  if (severity != Severity::Note) {
    const bool isError = severity == Severity::Error;
    keeps_ = (isError ? errors_ : warnings_) <= kMostErrors;
    notes_ = 0;
  } else if (++notes_ > kMostErrors) {
    return;
  }
  if (keeps_) all_.push_back({severity, place, std::max(1, length), std::move(text)});
}

std::string Messages::rendered(const Sources& sources) const {
  std::string out;
  for (const Message& m : all_) {
    out += oneMessage(sources, m.severity, m.place, static_cast<size_t>(m.length), m.text);
    out += macroNotes(sources, m.place);
    if (m.severity != Severity::Note) out += includeLines(sources, sources.outermost(m.place));
  }
  if (errors_ > kMostErrors) out += fmt::format("{} more errors are not shown\n", errors_ - kMostErrors);
  return out;
}

}  // namespace tomales::compiler
