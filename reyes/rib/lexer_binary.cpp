// Reads the encoded tokens, which begin with bytes from 0200 on.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "reyes/rib/lexer.h"

namespace tomales::rib {
namespace {

float bigEndianFloat(const char* bytes) {
  uint32_t bits;
  std::memcpy(&bits, bytes, 4);
  if constexpr (std::endian::native == std::endian::little) bits = __builtin_bswap32(bits);
  return std::bit_cast<float>(bits);
}

}  // namespace

bool Lexer::readBinary() {
  const int c = static_cast<unsigned char>(*stream_.begin());
  stream_.get();
  uint64_t n = 0;
  if (c < 0220) {
    readInteger((c & 3) + 1, (c - 0200) >> 2);
  } else if (c < 0244) {
    if (c < 0240 || readBytes(c - 0240 + 1, n)) readStringOf(c < 0240 ? static_cast<uint64_t>(c - 0220) : n);
  } else if (c < 0246) {
    if (!readBytes(c == 0244 ? 4 : 8, n)) return true;
    token_.kind = Token::Kind::Number;
    const double d = c == 0245 ? std::bit_cast<double>(n) : 0;
    token_.number = c == 0245 ? ScannedNumber{d, static_cast<float>(std::clamp<double>(d, -HUGE_VALF, HUGE_VALF))}
                              : ScannedNumber{std::bit_cast<float>(static_cast<uint32_t>(n)),
                                              std::bit_cast<float>(static_cast<uint32_t>(n))};
  } else if (c == 0246) {
    if (!readBytes(1, n)) return true;
    token_.kind = Token::Kind::Name;
    token_.text = requests_[n];
    if (token_.text.empty()) junk(fmt::format("the request code {}, which is not defined", n));
  } else if (c < 0314) {
    if (readBytes(c - 0310 + 1, n)) readFloats(n);
  } else if (c < 0317) {
    if (!readBytes(c == 0314 ? 1 : c - 0315 + 1, n) || !readDefinition()) return true;
    (c == 0314 ? requests_[n] : strings_[n]) = token_.text;
    return false;
  } else {
    if (!readBytes(c - 0317 + 1, n)) return true;
    token_.kind = Token::Kind::String;
    const auto it = strings_.find(n);
    if (it == strings_.end())
      junk(fmt::format("the string code {}, which is not defined", n));
    else
      token_.text = it->second;
  }
  return true;
}

bool Lexer::readBytes(int count, uint64_t& out) {
  out = 0;
  for (int i = 0; i < count; ++i) {
    const int c = stream_.get();
    if (c == ByteStream::kEnd) {
      junk("an encoded token that is cut off");
      return false;
    }
    out = out << 8 | static_cast<uint64_t>(c);
  }
  return true;
}

// Reads a two's complement of `bytes` bytes, of which `fraction` are after the radix point.
void Lexer::readInteger(int bytes, int fraction) {
  uint64_t n = 0;
  if (!readBytes(bytes, n)) return;
  const int unused = 64 - 8 * bytes;
  const double d = std::ldexp(static_cast<double>(static_cast<int64_t>(n << unused) >> unused), -8 * fraction);
  token_.kind = Token::Kind::Number;
  token_.number = {d, static_cast<float>(d)};
}

bool Lexer::readStringOf(uint64_t length) {
  token_.kind = Token::Kind::String;
  token_.text.clear();
  for (uint64_t left = length; left > 0;) {
    if (stream_.peek() == ByteStream::kEnd) {
      junk("an encoded string that is cut off");
      return false;
    }
    const auto n = std::min<uint64_t>(left, static_cast<uint64_t>(stream_.end() - stream_.begin()));
    if (length <= kLongestString) token_.text.append(stream_.begin(), n);
    stream_.skipTo(stream_.begin() + n);
    left -= n;
  }
  if (length <= kLongestString) return true;
  junk(fmt::format("an encoded string of {} bytes", length));
  return false;
}

bool Lexer::readDefinition() {
  skipBlanks();
  const int c = stream_.peek();
  uint64_t n = 0;
  if (c == '"') {
    readString();
  } else if (c >= 0220 && c < 0244) {
    stream_.get();
    if (c < 0240 || readBytes(c - 0240 + 1, n)) readStringOf(c < 0240 ? static_cast<uint64_t>(c - 0220) : n);
  } else {
    junk("the definition of a code without a string");
  }
  if (token_.kind == Token::Kind::String && token_.text.size() > kLongestDefinition)
    junk(fmt::format("the definition of a code as a string of {} bytes", token_.text.size()));
  return token_.kind == Token::Kind::String;
}

// Reads numbers while there are any. The count alone must not allocate memory.
void Lexer::readFloats(uint64_t count) {
  token_.kind = Token::Kind::Floats;
  token_.floats.clear();
  while (token_.floats.size() < count) {
    if (stream_.peek() == ByteStream::kEnd) return junk("an encoded array that is cut off");
    const size_t whole = static_cast<size_t>(stream_.end() - stream_.begin()) / 4;
    const auto n = std::min<uint64_t>(count - token_.floats.size(), whole);
    if (n == 0) {  // a number straddles two buffers
      uint64_t bits = 0;
      if (!readBytes(4, bits)) return;
      token_.floats.push_back(std::bit_cast<float>(static_cast<uint32_t>(bits)));
      continue;
    }
    const size_t at = token_.floats.size();
    const char* from = stream_.begin();
    token_.floats.resize(at + n);
    for (size_t i = 0; i < n; ++i) token_.floats[at + i] = bigEndianFloat(from + 4 * i);
    stream_.skipTo(from + 4 * n);
  }
}

}  // namespace tomales::rib
