// Makes arguments of requests from C++ values, and from the values that calls of reyes/ri.h pass.
#pragma once
#include "reyes/ri.h"
#include "reyes/rib.h"

namespace tomales::rib {

inline RibArg number(RtFloat f) { return {RibArg::Kind::Number, {f}}; }
inline RibArg integer(RtInt i) { return {RibArg::Kind::Integer, {}, {}, {i}}; }
inline RibArg string(const std::string& s) { return {RibArg::Kind::String, {}, {s}}; }
inline RibArg text(RtToken s) { return {RibArg::Kind::String, {}, {s ? s : ""}}; }
inline RibArg numbers(std::vector<float> list) { return {RibArg::Kind::Numbers, std::move(list)}; }
inline RibArg numbers(const RtFloat* list, size_t n) { return {RibArg::Kind::Numbers, {list, list + n}}; }
inline RibArg integers(const RtInt* list, size_t n) { return {RibArg::Kind::Integers, {}, {}, {list, list + n}}; }
inline RibArg texts(const RtToken* list, size_t n) {
  RibArg out{RibArg::Kind::Strings};
  for (size_t i = 0; i < n; ++i) out.strings.emplace_back(list[i] ? list[i] : "");
  return out;
}

}  // namespace tomales::rib
