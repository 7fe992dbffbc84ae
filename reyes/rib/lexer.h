// Bytes -> tokens of ASCII RIB (RISpec 3.2 appendix C). Never fails: bytes that belong to no token come out
// as Junk.
#pragma once
#include <string>

#include "reyes/rib/stream.h"

namespace tomales::rib {

struct Token {
  enum class Kind { End, Number, String, Name, Open, Close, Junk };
  Kind kind = Kind::End;
  double number = 0;  ///< May be infinite or NaN: writers print "inf" and "nan" when their input was broken.
  std::string text;   ///< Of a String without quotes and escapes, of a Name; for Junk, what it is.
  int line = 1;
};

/// For messages: "the number 3", "a string \"...\"", "the end of the file".
std::string describe(const Token& token);

class Lexer {
 public:
  /// Longer tokens become Junk: an unclosed quote must not swallow a gigabyte.
  static constexpr size_t kLongestString = 1 << 20, kLongestWord = 4096;

  explicit Lexer(ByteStream& stream) : stream_(stream) { advance(); }

  const Token& peek() const { return token_; }
  void advance();

 private:
  void skipBlanks();
  void readString();
  void readEscape();
  void readWord();
  void readJunk();

  ByteStream& stream_;
  Token token_;
  int line_ = 1;
};

}  // namespace tomales::rib
