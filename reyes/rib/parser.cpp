#include "reyes/rib/parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <climits>
#include <cmath>

namespace tomales::rib {
namespace {

float toFloat(double d) {
  if (std::abs(d) > std::numeric_limits<float>::max()) return d > 0 ? kInfinity : -kInfinity;
  return static_cast<float>(d);
}

int toInt(double d) {
  return std::isnan(d) ? 0 : static_cast<int>(std::lround(std::clamp<double>(d, -INT_MAX, INT_MAX)));
}

// Binary junk is full of words; only these deserve a message each.
bool looksLikeRequest(const std::string& word) {
  const auto alphanumeric = [](char c) { return std::isalnum(static_cast<unsigned char>(c)); };
  return word.size() >= 4 && std::isupper(static_cast<unsigned char>(word[0])) &&
         std::all_of(word.begin(), word.end(), alphanumeric);
}

}  // namespace

Parser::Parser(ByteStream& stream, std::string file, Dictionary& dictionary, Log& log)
    : file_(std::make_shared<const std::string>(std::move(file))),
      lexer_(stream),
      dictionary_(dictionary),
      log_(log) {}

std::optional<Request> Parser::next() {
  while (!at(Kind::End)) {
    const Signature* signature = at(Kind::Name) ? findSignature(lexer_.peek().text) : nullptr;
    if (!signature) {
      if (!at(Kind::Name))
        log_.report(Severity::Warning, "rib-junk", here(),
                    "a request was expected, but here is " + describe(lexer_.peek()) +
                        "; skipped up to the next request");
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

bool Parser::fail(const std::string& expected) {
  log_.report(Severity::Warning, "rib-arguments", here(),
              fmt::format("{} (line {}): {} was expected, but here is {}; the request is ignored",
                          request_.name, request_.where.line, expected, describe(lexer_.peek())));
  return false;
}

void Parser::skipToKnownRequest(bool reportUnknown) {
  for (; !at(Kind::End); lexer_.advance()) {
    if (!at(Kind::Name)) continue;
    if (findSignature(lexer_.peek().text)) return;
    if (reportUnknown || looksLikeRequest(lexer_.peek().text))
      log_.report(Severity::Warning, "rib-unknown-request", here(),
                  fmt::format("unknown request {}, ignored", lexer_.peek().text.substr(0, 40)));
    reportUnknown = false;
  }
}

bool Parser::readArguments(const Signature& signature) {
  for (size_t i = 0; i < signature.arguments.size(); ++i) {
    if (signature.arguments[i] == '?') {
      const bool given = at(Kind::Open) || at(Kind::Number);
      if (!given) break;
    } else if (!readArgument(signature.arguments[i])) {
      return false;
    }
  }
  const bool hasCategory = request_.name == "Option" || request_.name == "Attribute";
  if (signature.parameterList && !readParameters(hasCategory ? request_.args[0].strings[0] : ""))
    return false;
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
      return readArray(request_.args.emplace_back(), RibArg::Kind::Numbers);
    case 'S':
      return readArray(request_.args.emplace_back(), RibArg::Kind::Strings);
    case 'b':
      return at(Kind::String) ? readText(false) : readNumbers(16);
    case 'm':
      return readNumbers(16);
    case 'f':
      if (!readNumbers(1)) return false;
      request_.args.back().kind = RibArg::Kind::Number;
      return true;
    default:
      return readNumbers(static_cast<size_t>(letter - '0'));
  }
}

bool Parser::readText(bool orNumber) {
  RibArg arg{RibArg::Kind::String, {}, {}};
  const bool bracketed = at(Kind::Open);
  if (bracketed) lexer_.advance();
  if (at(Kind::String))
    arg.strings.push_back(lexer_.peek().text);
  else if (orNumber && at(Kind::Number))
    arg.strings.push_back(fmt::format("{}", lexer_.peek().number));
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
  RibArg arg{RibArg::Kind::Numbers, {}, {}};
  bool open = false;
  while (arg.numbers.size() < count || open) {
    if (at(open ? Kind::Close : Kind::Open)) {
      open = !open;
    } else if (at(Kind::Number) && arg.numbers.size() < count) {
      arg.numbers.push_back(toFloat(lexer_.peek().number));
    } else {
      return fail(arg.numbers.size() < count ? fmt::format("number {} of {}", arg.numbers.size() + 1, count)
                                             : "']'");
    }
    lexer_.advance();
  }
  request_.args.push_back(std::move(arg));
  return true;
}

bool Parser::readArray(RibArg& out, RibArg::Kind kind) {
  out.kind = kind;
  const bool wantsNumbers = kind == RibArg::Kind::Numbers;
  const bool bracketed = at(Kind::Open);
  if (bracketed) lexer_.advance();
  for (; at(wantsNumbers ? Kind::Number : Kind::String); lexer_.advance()) {
    if (wantsNumbers)
      out.numbers.push_back(toFloat(lexer_.peek().number));
    else
      out.strings.push_back(lexer_.peek().text);
    if (!bracketed) return lexer_.advance(), true;
  }
  if (!bracketed || !at(Kind::Close))
    return fail(wantsNumbers ? "an array of numbers" : "an array of strings");
  lexer_.advance();
  return true;
}

bool Parser::readParameters(const std::string& category) {
  while (at(Kind::String)) {
    const std::string token = lexer_.peek().text;
    const SourceLoc where = here();
    lexer_.advance();
    std::vector<double> numbers;
    std::vector<std::string> strings;
    if (!readValues(numbers, strings)) return fail(fmt::format("a value of \"{}\"", token));
    Param param;
    const auto declaration = dictionary_.find(token, category, param.name);
    if (declaration && keepParameter(token, *declaration, param, numbers, strings))
      request_.params.push_back(std::move(param));
    else if (!declaration)
      log_.report(
          Severity::Warning, "rib-undeclared", where,
          fmt::format("{}: parameter \"{}\" is not declared; ignored", request_.name, token.substr(0, 80)));
  }
  return true;
}

bool Parser::readValues(std::vector<double>& numbers, std::vector<std::string>& strings) {
  const bool bracketed = at(Kind::Open);
  if (bracketed) lexer_.advance();
  for (; at(Kind::Number) || at(Kind::String); lexer_.advance()) {
    if (at(Kind::Number))
      numbers.push_back(lexer_.peek().number);
    else
      strings.push_back(lexer_.peek().text);
    if (!bracketed) return lexer_.advance(), true;
  }
  if (!bracketed || !at(Kind::Close)) return false;
  lexer_.advance();
  return true;
}

bool Parser::keepParameter(const std::string& token, const Declaration& d, Param& param,
                           std::vector<double>& numbers, std::vector<std::string>& strings) {
  param.storage = d.storage;
  param.type = d.type;
  param.arrayLength = d.arrayLength;
  const bool wantsStrings = d.type == ValueType::String;
  const size_t count = wantsStrings ? strings.size() : numbers.size();
  const auto width = static_cast<size_t>(param.width());
  const bool mixed = wantsStrings ? !numbers.empty() : !strings.empty();
  if (mixed || count % width != 0) {
    log_.report(Severity::Warning, "rib-parameter", request_.where,
                mixed
                    ? fmt::format("{}: \"{}\" takes {}; the parameter is ignored", request_.name, token,
                                  wantsStrings ? "strings, not numbers" : "numbers, not strings")
                    : fmt::format("{}: \"{}\" has {} values, not a multiple of {}; the parameter is ignored",
                                  request_.name, token, count, width));
    return false;
  }
  if (wantsStrings)
    param.strings = std::move(strings);
  else if (d.type == ValueType::Integer)
    std::transform(numbers.begin(), numbers.end(), std::back_inserter(param.ints), toInt);
  else
    std::transform(numbers.begin(), numbers.end(), std::back_inserter(param.floats), toFloat);
  return true;
}

}  // namespace tomales::rib
