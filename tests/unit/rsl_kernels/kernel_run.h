// Kernels by point: inputs as lists of floats, laid out as the machine lays out its registers.
#pragma once
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "reyes/rsl/kernels.h"

namespace tomales::compiler {

/// Floats of a letter of a signature; a componentwise kernel does one component.
inline int floatsOf(char letter) { return letter == 't' ? 3 : letter == 'm' ? 16 : 1; }

struct Entry {
  Op op;
  std::string name, gives, takes;
  int floatsIn() const {
    int n = 0;
    for (char c : takes) n += floatsOf(c);
    return n;
  }
  int floatsOut() const { return floatsOf(gives[0]); }
};
/// What the table says that a kernel does.
inline std::vector<Entry> entries() {
  std::vector<Entry> all;
  const auto add = [&](Op op, const std::string& name, const std::string& signature, const std::string& traits) {
    if (traits.find('K') == std::string::npos) return;
    const size_t equals = signature.find('=');
    all.push_back({op, name, signature.substr(0, equals), signature.substr(equals + 1)});
  };
#define RSL_OP(name, signature, traits) add(Op::name, #name, signature, traits);
  RSL_OPS(RSL_OP)
#undef RSL_OP
  return all;
}

/// A register of `blocks` blocks; a uniform one has one, all of whose values are the same.
struct Values {
  int floats, blocks;
  bool varying;
  std::vector<float> data;
  Values(int f, int b, bool v)
      : floats(f), blocks(v ? b : 1), varying(v), data(static_cast<size_t>(f * blocks * kBlock), -77.0f) {}
  float& at(int component, int point) {
    return data[static_cast<size_t>(component * blocks * kBlock + (varying ? point : point % kBlock))];
  }
  Lanes lanes() { return {data.data(), varying ? kBlock : 0, blocks * kBlock}; }
};

/// Numbers of all kinds: those that need care, those of shaders, and any bits.
class Numbers {
 public:
  explicit Numbers(uint32_t seed) : random_(seed) {}
  float any() {
    static const float kCareful[] = {0.0f, -0.0f, 1.0f,   -1.0f,   0.5f,     -0.5f,     2.0f,        -2.0f,      3.0f,
                                     1.5f, -3.0f, 1e-40f, -1e-40f, 3.4e38f,  -3e38f,    16777216.0f, 8388607.5f, 255.0f,
                                     1e9f, -1e9f, 4e-39f, 1e38f,   INFINITY, -INFINITY, NAN,         0x1p20f,    -7.0f};
    switch (random_() % 8) {
      case 0:
        return kCareful[random_() % std::size(kCareful)];
      case 1:
        return bits();
      case 2:
        return static_cast<float>(static_cast<int>(random_() % 21) - 10);
      default:
        return within(-8, 8);
    }
  }
  float bits() {
    const uint32_t b = static_cast<uint32_t>(random_());
    float f;
    std::memcpy(&f, &b, sizeof f);
    return f;
  }
  float within(float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(random_); }

 private:
  std::mt19937 random_;
};

/// How many floats lie between two; both may be no number.
inline int64_t ulpsBetween(float a, float b) {
  if (a != a || b != b) return (a != a) == (b != b) ? 0 : INT64_MAX;
  const auto place = [](float x) {
    int32_t i;
    std::memcpy(&i, &x, sizeof i);
    return static_cast<int64_t>(i < 0 ? INT32_MIN - static_cast<int64_t>(i) : i);
  };
  return std::abs(place(a) - place(b));
}

}  // namespace tomales::compiler
