#include "reyes/rib/parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "reyes/base/near_names.h"
#include "reyes/rib/handlers.h"

namespace tomales::rib {
namespace {

// Tells whether an unknown word deserves a message: binary junk is full of words.
bool looksLikeRequest(const std::string& word) {
  const auto alphanumeric = [](char c) { return std::isalnum(static_cast<unsigned char>(c)); };
  return word.size() >= 4 && std::isupper(static_cast<unsigned char>(word[0])) &&
         std::all_of(word.begin(), word.end(), alphanumeric);
}

}  // namespace

Parser::Parser(ByteStream& stream, std::string file, Dictionary& dictionary, Log& log)
    : lexer_(stream, std::move(file)), dictionary_(dictionary), log_(log) {}

std::optional<Request> Parser::next() {
  for (; !at(Kind::End); ++senseless_) {
    if (senseless_ >= kMostSenseless) {
      log_.report(Severity::Missing, "rib-senseless", here(),
                  fmt::format("{} places before make no sense as RIB; the rest is not read", senseless_));
      break;
    }
    const Signature* signature = at(Kind::Name) ? findSignature(lexer_.peek().text) : nullptr;
    if (!signature) {
      if (!at(Kind::Name))
        warn("rib-junk", here(),
             "a request was expected, but here is " + describe(lexer_.peek()) + "; skipped up to the next request");
      skipToKnownRequest(at(Kind::Name));
      continue;
    }
    request_ = {std::string(signature->name), {}, {}, here()};
    lexer_.advance();
    if (readArguments(*signature)) return std::move(request_);
    skipToKnownRequest(false);
  }
  return std::nullopt;
}

int Parser::skipFrame() {
  int worlds = 0;
  for (; !at(Kind::End); lexer_.advancePastNumbers()) {
    if (!at(Kind::Name)) continue;
    const std::string& name = lexer_.peek().text;
    if (name == "FrameEnd" || name == "FrameBegin") break;
    worlds += name == "WorldBegin";
  }
  return worlds;
}

void Parser::warn(const char* code, const SourceLoc& where, const std::string& message, Severity severity) const {
  if (!muted_) log_.report(severity, code, where, message);
}

bool Parser::fail(const std::string& expected) {
  const bool missing = findSignature(request_.name)->support == Support::Draws;
  warn("rib-arguments", here(),
       fmt::format("{} (line {}): {} was expected, but here is {}; the request is ignored", request_.name,
                   request_.where.line, expected, describe(lexer_.peek())),
       missing ? Severity::Missing : Severity::Warning);
  return false;
}

void Parser::skipToKnownRequest(bool reportUnknown) {
  for (; !at(Kind::End); lexer_.advance()) {
    if (!at(Kind::Name)) continue;
    if (findSignature(lexer_.peek().text)) return;
    if (reportUnknown || looksLikeRequest(lexer_.peek().text)) unknownRequest(lexer_.peek().text);
    reportUnknown = false;
  }
}

void Parser::unknownRequest(const std::string& name) const {
  warn("rib-unknown-request", here(),
       fmt::format("unknown request {}, ignored{}", name.substr(0, 40), didYouMean(name, requestNames())),
       Severity::Missing);
}

bool Parser::readArguments(const Signature& signature) {
  for (size_t i = 0; i < signature.arguments.size(); ++i) {
    if (signature.arguments[i] == '?') {
      const bool given = at(Kind::Open) || lexer_.atNumbers();
      if (!given) break;
    } else if (!readArgument(signature.arguments[i])) {
      return false;
    }
  }
  const bool hasHandle = signature.arguments == "sh" && signature.parameterList;
  if (hasHandle && (at(Kind::Open) || lexer_.atNumbers()) && !readParameterInPlaceOfHandle()) return false;
  const bool hasCategory = request_.name == "Option" || request_.name == "Attribute";
  if (signature.parameterList && !readParameters(hasCategory ? request_.args[0].strings[0] : "")) return false;
  if (!at(Kind::Name) && !at(Kind::End) && !at(Kind::Junk)) return fail("the next request");
  return true;
}

bool Parser::readArgument(char letter) {
  switch (letter) {
    case 's':
      return readText(false);
    case 'h':
      return readText(true);
    case 'F':
      return readArray(RibArg::Kind::Numbers);
    case 'I':
      return readArray(RibArg::Kind::Integers);
    case 'S':
      return readArray(RibArg::Kind::Strings);
    case 'b':
      return at(Kind::String) ? readText(false) : readNumbers(16);
    case 'm':
      return readNumbers(16);
    case 'f':
      if (!readNumbers(1)) return false;
      request_.args.back().kind = RibArg::Kind::Number;
      return true;
    case 'i':
      return readInteger();
    case 'c':
      return readNumbers(static_cast<size_t>(dictionary_.colorSamples()));
    default:
      return readNumbers(static_cast<size_t>(letter - '0'));
  }
}

bool Parser::readText(bool orNumber) {
  RibArg arg{RibArg::Kind::String};
  const bool bracketed = at(Kind::Open);
  if (bracketed) lexer_.advance();
  if (at(Kind::String))
    arg.strings.push_back(lexer_.peek().text);
  else if (orNumber && at(Kind::Number))
    arg.strings.push_back(fmt::format("{}", lexer_.peek().number.wide));
  else
    return fail(orNumber ? "a handle" : "a string");
  lexer_.advance();
  if (bracketed && !at(Kind::Close)) return fail("']'");
  if (bracketed) lexer_.advance();
  request_.args.push_back(std::move(arg));
  return true;
}

// Writers disagree on where the brackets of fixed-size arguments go ("Rotate 30 [0 1 0]"), so they may be
// anywhere.
bool Parser::readNumbers(size_t count) {
  RibArg arg{RibArg::Kind::Numbers};
  bool open = false;
  while (arg.numbers.size() < count || open) {
    if (at(open ? Kind::Close : Kind::Open)) {
      open = !open;
    } else if (at(Kind::Number) && arg.numbers.size() < count) {
      arg.numbers.push_back(lexer_.peek().number.narrow);
    } else if (at(Kind::Floats) && lexer_.peek().floats.size() <= count - arg.numbers.size()) {
      const std::vector<float>& more = lexer_.peek().floats;
      arg.numbers.insert(arg.numbers.end(), more.begin(), more.end());
    } else {
      return fail(arg.numbers.size() < count ? fmt::format("number {} of {}", arg.numbers.size() + 1, count) : "']'");
    }
    lexer_.advance();
  }
  request_.args.push_back(std::move(arg));
  return true;
}

bool Parser::readInteger() {
  RibArg arg{RibArg::Kind::Integer};
  const bool bracketed = at(Kind::Open);
  if (bracketed) lexer_.advance();
  if (lexer_.atNumbers()) lexer_.takeNumber(arg.integers);
  if (arg.integers.size() != 1) return fail("an integer");
  if (bracketed && !at(Kind::Close)) return fail("']'");
  if (bracketed) lexer_.advance();
  request_.args.push_back(std::move(arg));
  return true;
}

bool Parser::readArray(RibArg::Kind kind) {
  RibArg& out = request_.args.emplace_back(RibArg{kind});
  const bool wantsNumbers = kind != RibArg::Kind::Strings, bracketed = at(Kind::Open);
  if (bracketed) lexer_.advance();
  if (wantsNumbers && lexer_.atNumbers()) {
    const auto take = [&](auto& list) { bracketed ? lexer_.takeNumbers(list) : lexer_.takeNumber(list); };
    kind == RibArg::Kind::Integers ? take(out.integers) : take(out.numbers);
    if (!bracketed) return true;
  }
  for (; !wantsNumbers && at(Kind::String); lexer_.advance()) {
    out.strings.push_back(lexer_.peek().text);
    if (!bracketed) {
      lexer_.advance();
      return true;
    }
  }
  if (!bracketed || !at(Kind::Close)) return fail(wantsNumbers ? "an array of numbers" : "an array of strings");
  lexer_.advance();
  return true;
}

bool Parser::readParameters(const std::string& category) {
  while (at(Kind::String))
    if (!readParameter(category)) return false;
  return true;
}

bool Parser::readParameterInPlaceOfHandle() {
  const std::string token = std::exchange(request_.args.back().strings[0], request_.where.text());
  warn("rib-no-handle", request_.where,
       fmt::format("{}: there is no handle before the parameter \"{}\"; the place of the request is its handle",
                   request_.name, token.substr(0, 80)));
  return readValuesOf(token, request_.where, "");
}

bool Parser::readParameter(const std::string& category) {
  const std::string token = lexer_.peek().text;
  const SourceLoc where = here();
  lexer_.advance();
  return readValuesOf(token, where, category);
}

bool Parser::readValuesOf(const std::string& token, const SourceLoc& where, const std::string& category) {
  Param param;
  const auto declaration = dictionary_.find(token, category, param.name);
  const bool valuesTell = valuesTellTypeOf(token), declared = declaration && !(declaration->standard && valuesTell);
  if (declaration) {
    param.storage = declaration->storage;
    param.type = declaration->reference ? ValueType::String : declaration->type;
    param.arrayLength = declaration->arrayLength;
  }
  if (!readValues(param)) return fail(fmt::format("a value of \"{}\"", token));
  if (!declaration && !valuesTell) {
    warn("rib-undeclared", where,
         fmt::format("{}: parameter \"{}\" is not declared; ignored", request_.name, token.substr(0, 80)),
         Severity::Missing);
    return true;
  }
  if (!declared && !(declaration && valuesFit(param))) param = typedByValues(token, std::move(param));
  if (!fitsDeclaration(token, param)) return true;
  if (declaration && declaration->reference) request_.references.emplace_back(param.name, declaration->type);
  if (!declared && !isGeometry(request_.name)) param.arrayLength = 0;
  request_.params.push_back(std::move(param));
  return true;
}

// A primitive variable has a class, which its values do not show. Other parameters need no declaration: shaders,
// options and attributes have their own types, and exporters of modellers write private data ("__instanceid").
bool Parser::valuesTellTypeOf(const std::string& token) const {
  const bool bare = token.find_first_of(" \t\r\n[]") == std::string::npos;
  return bare && (token.starts_with("__") || !isGeometry(request_.name));
}

Param Parser::typedByValues(const std::string& name, Param values) {
  Param out;
  out.name = name;
  out.type = values.strings.empty() ? ValueType::Float : ValueType::String;
  out.floats = std::move(values.floats);
  out.strings = std::move(values.strings);
  out.floats.insert(out.floats.end(), values.ints.begin(), values.ints.end());
  return out;
}

bool Parser::readValues(Param& param) {
  const bool bracketed = at(Kind::Open);
  const auto appendNumbers = [&](auto& out) { bracketed ? lexer_.takeNumbers(out) : lexer_.takeNumber(out); };
  if (bracketed) lexer_.advance();
  while (lexer_.atNumbers() || at(Kind::String)) {
    if (at(Kind::String)) {
      param.strings.push_back(lexer_.peek().text);
      lexer_.advance();
    } else if (param.type == ValueType::Integer)
      appendNumbers(param.ints);
    else
      appendNumbers(param.floats);
    if (!bracketed) return true;
  }
  if (!bracketed || !at(Kind::Close)) return false;
  lexer_.advance();
  return true;
}

size_t Parser::widthOf(const Param& param) const {
  const bool color = param.type == ValueType::Color;
  return static_cast<size_t>(color ? dictionary_.colorSamples() * param.arrayLength : param.width());
}

bool Parser::valuesFit(const Param& param) const {
  const size_t numbers = param.ints.size() + param.floats.size(), strings = param.strings.size();
  const bool text = param.type == ValueType::String;
  return (text ? numbers : strings) == 0 && (text ? strings : numbers) % widthOf(param) == 0;
}

bool Parser::fitsDeclaration(const std::string& token, const Param& param) const {
  if (valuesFit(param)) return true;
  const bool text = param.type == ValueType::String;
  const size_t numbers = param.ints.size() + param.floats.size(), strings = param.strings.size();
  const bool mixed = (text ? numbers : strings) > 0;
  warn("rib-parameter", request_.where,
       mixed ? fmt::format("{}: \"{}\" takes {}; the parameter is ignored", request_.name, token,
                           text ? "strings, not numbers" : "numbers, not strings")
             : fmt::format("{}: \"{}\" has {} values, not a multiple of {}; the parameter is ignored", request_.name,
                           token, text ? strings : numbers, widthOf(param)));
  return false;
}

}  // namespace tomales::rib
