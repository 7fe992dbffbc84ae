// Turns bytes into tokens of RIB, ASCII and binary mixed at will (RISpec 3.2 appendix C). It never fails: bytes that
// belong to no token become Junk.
#pragma once
#include <array>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "reyes/rib/number.h"
#include "reyes/rib/stream.h"

namespace tomales::rib {

struct Token {
  enum class Kind { End, Number, Floats, String, Name, Open, Close, Junk };
  Kind kind = Kind::End;
  ScannedNumber number{};     ///< May be infinite or NaN: writers print "inf" and "nan" when their input was broken.
  std::vector<float> floats;  ///< The numbers of an encoded array, brackets included.
  std::string text;           ///< A String without quotes and escapes, or a Name; for Junk, a description of it.
  int line = 1;               ///< Line in Lexer::file().
};

/// Describes it in a message: "the number 3", "a string \"...\"", "the end of the file".
std::string describe(const Token& token);

/// Rounds and clamps; NaN becomes INT_MIN.
int toInt(double d);

class Lexer {
 public:
  /// Longer tokens become Junk: an unclosed quote must not swallow a gigabyte. A defined string costs two bytes
  /// wherever it is used, so it must not be long either.
  static constexpr size_t kLongestString = 1 << 20, kLongestWord = 4096, kLongestDefinition = 1024;

  Lexer(ByteStream& stream, std::string file) : stream_(stream), file_(std::make_shared<std::string>(std::move(file))) {
    advance();
  }

  const Token& peek() const { return token_; }
  /// Returns the file or program of the token: the stream's own name, or a source that a comment of the form #line 12
  /// "scene.py" names. The line after such a comment has the number that it gives, as in C.
  const std::shared_ptr<const std::string>& file() const { return file_; }
  void advance();
  /// Does the same as advance(), but skips all numbers and brackets up to the next other token, without parsing them.
  void advancePastNumbers();

  bool atNumbers() const { return token_.kind == Token::Kind::Number || token_.kind == Token::Kind::Floats; }
  /// Appends the next number or encoded array, and moves past it. Pre: atNumbers().
  template <class T>
  void takeNumber(std::vector<T>& out);
  /// Appends all numbers from here up to the next other token.
  template <class T>
  void takeNumbers(std::vector<T>& out);

 private:
  /// Returns false after a definition, which is no token yet.
  bool readToken();
  void skipBlanks();
  void skipComment();
  void skipLineEnd();
  void readString();
  void readEscape();
  void readWord();
  void readJunk();
  void junk(std::string what);
  template <class T>
  void appendToken(std::vector<T>& out) const;
  template <class T>
  void takeWrittenNumbers(std::vector<T>& out);

  // Binary tokens are read in lexer_binary.cpp.
  bool readBinary();
  /// Reads the most significant byte first. Returns false, with Junk, if the stream has ended.
  bool readBytes(int count, uint64_t& out);
  void readInteger(int bytes, int fraction);
  bool readStringOf(uint64_t length);
  /// Reads a string in any encoding.
  bool readDefinition();
  void readFloats(uint64_t count);

  ByteStream& stream_;
  std::shared_ptr<const std::string> file_;
  Token token_;
  int line_ = 1;
  std::array<std::string, 256> requests_;
  std::unordered_map<uint64_t, std::string> strings_;
};

/// Tells whether the byte begins an encoded token. The rest above 0177 is reserved.
inline bool isBinary(int c) { return (c >= 0200 && c <= 0246) || (c >= 0310 && c <= 0320); }

}  // namespace tomales::rib
