// The first stage of the compiler: files, #include, #define and #if become one list of tokens. Sources: RISpec 3.2
// section 11 (RSL is passed through the C preprocessor) and ISO C90 6.8, whose rules of replacement (stringify, paste,
// no recursion) are followed.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "reyes/rsl/source.h"

namespace tomales::compiler {

enum class TokenKind : uint8_t {
  Name,
  Number,
  String,      ///< The text without quotes, with escapes resolved.
  Punctuator,  ///< One of RSL's operators or brackets, the longest that fits: "+=", "&&", "?", ...
  End
};

struct Token {
  TokenKind kind = TokenKind::End;
  std::string text{};
  float number = 0;
  Place place{};
  /// The comment directly before a word that may begin a shader, or null.
  std::shared_ptr<const std::string> comment{};
  bool is(std::string_view punctuator) const { return kind == TokenKind::Punctuator && text == punctuator; }
  bool isName(std::string_view name) const { return kind == TokenKind::Name && text == name; }
};

struct PreprocessOptions {
  /// The folders of #include: "NAME" is looked for beside the including file first, then here; <NAME> only here. A file
  /// outside of these folders and the shader's own is not read, even through "../" in a name.
  std::vector<std::string> includeFolders;
  struct Definition {
    std::string name, value;  ///< Given by `-D NAME=VALUE`.
  };
  std::vector<Definition> definitions;
  /// True if the renderer's own headers are used for names that are found nowhere else (standard_headers.h).
  bool standardHeaders = true;
};

/// Bounds for untrusted files; exceeding them is an error.
constexpr int kMostIncludeDepth = 64;
constexpr size_t kMostTokens = 500'000;       ///< After expansion, counting those that macros make in between.
constexpr int kMostExpansions = 50'000;       ///< Uses of macros.
constexpr int kMostIncludes = 2'000;          ///< A file counts each time it is included.
constexpr size_t kMostFileBytes = 16u << 20;  ///< The greatest size of one file.

/// Returns the tokens of a file and of all that it includes; the last is of kind End. Errors go to `messages`, and
/// tokenizing goes on as well as it can; if a bound is exceeded, there are no tokens.
std::vector<Token> preprocess(const std::string& path, const PreprocessOptions& options, Sources& sources,
                              Messages& messages);
/// Returns the same for a text, which messages call `name`. It includes files from the folders of `options` alone.
std::vector<Token> preprocessText(const std::string& name, const std::string& text, const PreprocessOptions& options,
                                  Sources& sources, Messages& messages);

/// Returns a line for each token: place, kind, text.
std::string dump(const std::vector<Token>& tokens, const Sources& sources);

}  // namespace tomales::compiler
