// Bytes -> tokens of RIB, ASCII and binary mixed at will (RISpec 3.2 appendix C). Never fails: bytes that
// belong to no token come out as Junk.
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
  std::vector<float> floats;  ///< Floats: an encoded array, brackets included.
  std::string text;           ///< Of a String without quotes and escapes, of a Name; for Junk, what it is.
  int line = 1;               ///< Of Lexer::file().
};

/// For messages: "the number 3", "a string \"...\"", "the end of the file".
std::string describe(const Token& token);

/// Rounded and clamped; INT_MIN for NaN.
int toInt(double d);

class Lexer {
 public:
  /// Longer tokens become Junk: an unclosed quote must not swallow a gigabyte. A defined string costs two
  /// bytes wherever it is used, so it must not be long either.
  static constexpr size_t kLongestString = 1 << 20, kLongestWord = 4096, kLongestDefinition = 1024;

  Lexer(ByteStream& stream, std::string file) : stream_(stream), file_(std::make_shared<std::string>(std::move(file))) {
    advance();
  }

  const Token& peek() const { return token_; }
  /// Where the token is: in the stream, or in the program that wrote it, if that said so by a comment of the form
  /// #line 12 "scene.py". The line after such a comment has the number that it gives, as in C.
  const std::shared_ptr<const std::string>& file() const { return file_; }
  void advance();

  bool atNumbers() const { return token_.kind == Token::Kind::Number || token_.kind == Token::Kind::Floats; }
  /// Appends the number or encoded array here and goes on. Pre: atNumbers().
  template <class T>
  void takeNumber(std::vector<T>& out);
  /// Appends all numbers from here on, up to the next token that is none.
  template <class T>
  void takeNumbers(std::vector<T>& out);

 private:
  /// False: it was a definition, the token is still to come.
  bool readToken();
  void skipBlanks();
  void skipComment();
  void readString();
  void readEscape();
  void readWord();
  void readJunk();
  void junk(std::string what);
  template <class T>
  void appendToken(std::vector<T>& out) const;
  template <class T>
  void takeWrittenNumbers(std::vector<T>& out);

  // Binary (lexer_binary.cpp)
  bool readBinary();
  /// Most significant byte first. False, and Junk: the stream ended.
  bool readBytes(int count, uint64_t& out);
  void readInteger(int bytes, int fraction);
  bool readStringOf(uint64_t length);
  /// A string in any encoding.
  bool readDefinition();
  void readFloats(uint64_t count);

  ByteStream& stream_;
  std::shared_ptr<const std::string> file_;
  Token token_;
  int line_ = 1;
  std::array<std::string, 256> requests_;
  std::unordered_map<uint64_t, std::string> strings_;
};

/// Bytes that begin an encoded token; the rest above 0177 is reserved.
inline bool isBinary(int c) { return (c >= 0200 && c <= 0246) || (c >= 0310 && c <= 0320); }

}  // namespace tomales::rib
