// Turns tokens into Requests. A returned request has the arguments of its signature, and parameters that fit their
// declarations. Everything else is reported with file and line, and skipped.
#pragma once
#include <optional>

#include "reyes/rib.h"
#include "reyes/rib/dictionary.h"
#include "reyes/rib/lexer.h"
#include "reyes/rib/request_table.h"

namespace tomales::rib {

class Parser {
 public:
  /// A file with more errors than this is no RIB, and may have no end.
  static constexpr int kMostSenseless = 100'000;

  /// The dictionary must outlive the parser: it belongs to the whole stream, archives included.
  Parser(ByteStream& stream, std::string file, Dictionary& dictionary, Log& log);

  /// Returns the next good request; nothing at the end of the stream, or after kMostSenseless errors.
  std::optional<Request> next();
  /// Skips to the end of the frame without parsing its requests. Returns the number of worlds that begin in it.
  int skipFrame();
  /// Mutes messages. Used in a branch of a condition that is not read, because it may be meant for other renderers.
  void mute(bool muted) { muted_ = muted; }

 private:
  using Kind = Token::Kind;
  bool at(Kind kind) const { return lexer_.peek().kind == kind; }
  SourceLoc here() const { return {lexer_.file(), lexer_.peek().line}; }
  void warn(const char* code, const SourceLoc& where, const std::string& message,
            Severity severity = Severity::Warning) const;
  /// Reports what is wrong with the request, and always returns false.
  bool fail(const std::string& expected);
  void skipToKnownRequest(bool reportUnknown);
  void unknownRequest(const std::string& name) const;

  bool readArguments(const Signature& signature);
  bool readArgument(char letter);
  bool readText(bool orNumber);
  bool readNumbers(size_t count);
  bool readInteger();
  bool readArray(RibArg::Kind kind);
  bool readParameters(const std::string& category);
  bool readParameter(const std::string& category);
  bool readValuesOf(const std::string& token, const SourceLoc& where, const std::string& category);
  /// Reads a light that has no handle: what was read as one is the name of its first parameter.
  bool readParameterInPlaceOfHandle();
  /// Tells whether the values show the type of a token whose name is not declared.
  bool valuesTellTypeOf(const std::string& token) const;
  static Param typedByValues(const std::string& name, Param values);
  /// Reads numbers into `ints` or `floats`, by the parameter's type.
  bool readValues(Param& param);
  size_t widthOf(const Param& param) const;  ///< Number of numbers in one written element.
  bool valuesFit(const Param& param) const;
  /// Returns valuesFit(), and reports if they do not.
  bool fitsDeclaration(const std::string& token, const Param& param) const;

  Lexer lexer_;
  Dictionary& dictionary_;
  Log& log_;
  Request request_;
  bool muted_ = false;
  int senseless_ = 0;  ///< Number of places that were skipped.
};

}  // namespace tomales::rib
