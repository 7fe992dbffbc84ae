#include "reyes/rsl/passes/rules.h"

namespace tomales::compiler {
namespace {

constexpr bool isSmooth(Op op) {
  switch (op) {
    case Op::Floor:
    case Op::Ceil:
    case Op::Round:
    case Op::Sign:
    case Op::Step:
    case Op::Less:
    case Op::LessEqual:
    case Op::Equal:
    case Op::NotEqual:
    case Op::And:
    case Op::Or:
    case Op::Not:
    case Op::TripleEqual:
    case Op::MatrixEqual:
    case Op::TextEqual:
    case Op::Match:
    case Op::Cell1F:
    case Op::Cell2F:
    case Op::Cell3F:
    case Op::Cell4F:
    case Op::Cell1T:
    case Op::Cell2T:
    case Op::Cell3T:
    case Op::Cell4T:
      return false;
    default:
      return true;
  }
}

}  // namespace

std::vector<size_t> differentiated(const Instruction& i) {
  if (!isSmooth(i.op)) return {};
  switch (i.op) {
    case Op::Select:
      return {1, 2};
    case Op::TransformPoint:
    case Op::TransformVector:
    case Op::TransformNormal:
      return {1};
    case Op::ElementF:
    case Op::ElementT:
      return {0};
    case Op::SetElement:
      return {1};
    case Op::Component:
      return {0};
    case Op::SetComponent:
      return {0, 2};
    case Op::TransformSpace:
    case Op::ColorTransform:
      return {2};
    case Op::TextureF:
    case Op::TextureT:
      return {2, 3};
    case Op::EnvironmentF:
    case Op::EnvironmentT:
      return {2};
    case Op::SplineF:
    case Op::SplineT: {
      std::vector<size_t> all;
      for (size_t k = 1; k < i.in.size(); ++k) all.push_back(k);
      return all;
    }
    case Op::Copy:
      return {0};
    default: {
      if (!info(i.op).kernel()) return {};  // light, rays and messages are the same over a micropolygon
      std::vector<size_t> all;
      for (size_t k = 0; k < i.in.size(); ++k) all.push_back(k);
      return all;
    }
  }
}

}  // namespace tomales::compiler
