// Writes requests as RIB text, ASCII or binary (RISpec 3.2 appendix C).
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <unordered_map>

#include "reyes/rib.h"
#include "reyes/rib/stream.h"

namespace tomales {
namespace {

using rib::gzip;

/// The form of numbers, strings and names; it appends to a text.
class Encoding {
 public:
  virtual ~Encoding() = default;
  virtual void name(std::string& out, const std::string& request) = 0;
  virtual void number(std::string& out, float f) = 0;
  virtual void integer(std::string& out, int i) = 0;
  virtual void string(std::string& out, const std::string& s) = 0;
  virtual void token(std::string& out, const std::string& s) = 0;  ///< Writes the name of a parameter.
  virtual void floats(std::string& out, const std::vector<float>& list) = 0;
  virtual void endOfRequest(std::string& out) = 0;
};

class Ascii : public Encoding {
 public:
  void name(std::string& out, const std::string& request) override { out += request; }
  void number(std::string& out, float f) override { fmt::format_to(std::back_inserter(out), " {}", f); }
  void integer(std::string& out, int i) override { fmt::format_to(std::back_inserter(out), " {}", i); }
  void string(std::string& out, const std::string& s) override {
    out += " \"";
    for (const char c : s) {
      if (c == '\n')
        out += "\\n";
      else if (c == '\r')
        out += "\\r";
      else
        (c == '"' || c == '\\' ? out += '\\' : out) += c;
    }
    out += '"';
  }
  void token(std::string& out, const std::string& s) override { string(out, s); }
  void floats(std::string& out, const std::vector<float>& list) override {
    out += " [";
    for (const float f : list) number(out, f);
    out += " ]";
  }
  void endOfRequest(std::string& out) override { out += '\n'; }
};

class Binary : public Encoding {
 public:
  void name(std::string& out, const std::string& request) override {
    const auto [it, fresh] = names_.try_emplace(request, names_.size());
    const size_t code = it->second;
    if (code > 255) {
      out += request + " ";
      return;
    }
    if (fresh) {
      (out += '\314') += static_cast<char>(code);
      string(out, request);
    }
    (out += '\246') += static_cast<char>(code);
  }
  void number(std::string& out, float f) override {
    if (std::abs(f) <= 32768 && f == std::trunc(f) && !(f == 0 && std::signbit(f)))
      return integer(out, static_cast<int>(f));
    out += '\244';
    bytes(out, std::bit_cast<uint32_t>(f), 4);
  }
  void integer(std::string& out, int i) override {
    int n = 1;
    while (n < 4 && (i < -(1 << (8 * n - 1)) || i >= 1 << (8 * n - 1))) ++n;
    out += static_cast<char>(0200 + n - 1);
    bytes(out, static_cast<uint32_t>(i), n);
  }
  void string(std::string& out, const std::string& s) override {
    if (s.size() < 16)
      out += static_cast<char>(0220 + s.size());
    else
      counted(out, 0240, s.size());
    out += s;
  }
  void token(std::string& out, const std::string& s) override {
    if (s.size() > 200) return string(out, s);
    const auto [it, fresh] = tokens_.try_emplace(s, static_cast<uint32_t>(tokens_.size()));
    const bool wide = it->second > 0xff;
    if (it->second > 0xffff) return string(out, s);
    if (fresh) {
      out += wide ? '\316' : '\315';
      bytes(out, it->second, wide ? 2 : 1);
      string(out, s);
    }
    out += wide ? '\320' : '\317';
    bytes(out, it->second, wide ? 2 : 1);
  }
  void floats(std::string& out, const std::vector<float>& list) override {
    counted(out, 0310, list.size());
    for (const float f : list) bytes(out, std::bit_cast<uint32_t>(f), 4);
  }
  void endOfRequest(std::string&) override {}

 private:
  static void bytes(std::string& out, uint32_t value, int count) {
    for (int shift = 8 * (count - 1); shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 0xff);
  }
  static void counted(std::string& out, int code, size_t size) {
    int n = 1;
    while (n < 4 && size >> (8 * n) != 0) ++n;
    out += static_cast<char>(code + n - 1);
    bytes(out, static_cast<uint32_t>(size), n);
  }

  std::unordered_map<std::string, size_t> names_;
  std::unordered_map<std::string, uint32_t> tokens_;
};

std::string declarationOf(const Param& p, ValueType type) {
  const std::string length = p.arrayLength == 1 ? "" : fmt::format("[{}]", p.arrayLength);
  return fmt::format("{} {}{} ", nameOf(p.storage), nameOf(type), length);
}

std::string declarationOf(const Param& p) { return declarationOf(p, p.type); }

class Writer : public RiSink {
 public:
  explicit Writer(const RibWriterSettings& settings)
      : settings_(settings),
        encoding_(settings.binary ? std::unique_ptr<Encoding>(new Binary) : std::make_unique<Ascii>()) {
    if (!settings.binary) out_ = "##RenderMan RIB\n";
  }
  ~Writer() override {
    flush();
    if (settings_.gzip && !written_) settings_.write(gzip(""));
  }

  void request(const Request& r) override {
    encoding_->name(out_, r.name);
    for (const RibArg& a : r.args) argument(a);
    for (const Param& p : r.params) parameter(p, r);
    encoding_->endOfRequest(out_);
    if (out_.size() > kBlock) flush();
  }

 private:
  static constexpr size_t kBlock = 1 << 20;

  void argument(const RibArg& a) {
    switch (a.kind) {
      case RibArg::Kind::Number:
        return encoding_->number(out_, a.number());
      case RibArg::Kind::Integer:
        return encoding_->integer(out_, a.integer());
      case RibArg::Kind::String:
        return encoding_->string(out_, a.strings[0]);
      case RibArg::Kind::Numbers:
        return encoding_->floats(out_, a.numbers);
      case RibArg::Kind::Integers:
        return integers(a.integers);
      case RibArg::Kind::Strings:
        return strings(a.strings);
    }
  }

  // A parameter that was written without a declaration stays so. A name with blanks or brackets cannot be declared
  // inline: its Declare is among the requests.
  void parameter(const Param& p, const Request& r) {
    const bool inlined = p.arrayLength > 0 && p.name.find_first_of(" \t\r\n[]") == std::string::npos;
    const auto reference =
        std::find_if(r.references.begin(), r.references.end(), [&](const auto& f) { return f.first == p.name; });
    encoding_->token(out_, !inlined ? p.name
                           : reference == r.references.end()
                               ? declarationOf(p) + p.name
                               : "reference " + declarationOf(p, reference->second) + p.name);
    if (p.type == ValueType::String) return strings(p.strings);
    if (p.type != ValueType::Integer) return encoding_->floats(out_, p.floats);
    integers(p.ints);
  }

  void integers(const std::vector<int>& list) {
    out_ += " [";
    for (const int i : list) encoding_->integer(out_, i);
    out_ += "]";
  }
  void strings(const std::vector<std::string>& list) {
    out_ += " [";
    for (const std::string& s : list) encoding_->string(out_, s);
    out_ += "]";
  }

  void flush() {
    if (out_.empty()) return;
    settings_.write(settings_.gzip ? gzip(out_) : out_);
    out_.clear();
    written_ = true;
  }

  const RibWriterSettings settings_;
  std::unique_ptr<Encoding> encoding_;
  std::string out_;
  bool written_ = false;
};

}  // namespace

std::unique_ptr<RiSink> makeRibWriter(const RibWriterSettings& settings) { return std::make_unique<Writer>(settings); }

}  // namespace tomales
