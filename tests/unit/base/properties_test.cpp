// Properties of containers, files of records and packed values, for contents that RapidCheck makes up.
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "reyes/base/block_vector.h"
#include "reyes/base/distribution.h"
#include "reyes/base/morton.h"
#include "reyes/base/pack.h"
#include "reyes/base/packed_normal.h"
#include "tests/unit/made_up.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

using test::madeUpVector;
using test::numberIn;

RC_GTEST_PROP(BlockVectors, HoldWhatWasPushedInItsOrder, ()) {
  const auto count = *test::wholeIn<size_t>(0, 5000);
  BlockVector<size_t> vector;
  RC_ASSERT(vector.empty());
  for (size_t i = 0; i < count; ++i) {
    vector.push_back(3 * i);
    RC_ASSERT(vector.back() == 3 * i);
  }
  RC_ASSERT(vector.size() == count);
  size_t at = 0;
  for (const size_t value : vector) RC_ASSERT(value == 3 * at++);
  RC_ASSERT(at == count);
}

RC_GTEST_PROP(BlockVectors, NeverMoveTheirElements, ()) {
  const auto before = *test::wholeIn<size_t>(1, 3000), after = *test::wholeIn<size_t>(0, 3000);
  BlockVector<int> vector;
  for (size_t i = 0; i < before; ++i) vector.push_back(static_cast<int>(i));
  const int* last = &vector.back();
  for (size_t i = 0; i < after; ++i) vector.push_back(-1);
  RC_ASSERT(last == &vector[before - 1]);
  RC_ASSERT(*last == static_cast<int>(before) - 1);
}

/// A structure of every kind of field that files have.
struct Everything {
  std::map<std::string, std::vector<int>> lists;
  std::optional<double> number;
  std::set<uint16_t> set;
  std::vector<std::string> texts;
  bool yes = false;
  bool operator==(const Everything&) const = default;
};
template <class A, class Lens>
void fields(A& a, Lens& x) requires std::is_same_v<std::remove_const_t<Lens>, Everything> {
  auto& [lists, number, set, texts, yes] = x;
  each(a, lists, number, set, texts, yes);
}

Everything madeUp() {
  Everything out;
  out.lists = *rc::gen::arbitrary<std::map<std::string, std::vector<int>>>();
  if (*rc::gen::arbitrary<bool>()) out.number = *rc::gen::arbitrary<double>();
  out.set = *rc::gen::arbitrary<std::set<uint16_t>>();
  out.texts = *rc::gen::arbitrary<std::vector<std::string>>();
  out.yes = *rc::gen::arbitrary<bool>();
  return out;
}

RC_GTEST_PROP(PackedValues, ComeBackAsTheyWere, ()) {
  const Everything before = madeUp();
  Everything after;
  RC_ASSERT(unpack(pack(before), after));
  RC_ASSERT(after == before);
  RC_ASSERT(contentSum(after) == contentSum(before));
}

RC_GTEST_PROP(PackedValues, AreRefusedIfTheirEndIsMissingOrBytesFollow, ()) {
  const Everything before = madeUp();
  Bytes bytes = pack(before);
  Everything after;
  const auto kept = *test::wholeIn<size_t>(0, bytes.size());
  RC_ASSERT_FALSE(unpack(BytesView(bytes).first(kept), after));
  bytes.push_back(std::byte{0});
  RC_ASSERT_FALSE(unpack(bytes, after));
}

RC_GTEST_PROP(PackedValues, HaveTheSameSumOnlyIfTheyAreTheSame, ()) {
  const Everything a = madeUp(), other = madeUp();
  Everything b = a;
  switch (*test::wholeIn(0, 5)) {
    case 0:
      b.lists = other.lists;
      break;
    case 1:
      b.number = other.number;
      break;
    case 2:
      b.set = other.set;
      break;
    case 3:
      b.texts = other.texts;
      break;
    default:
      b.yes = other.yes;
  }
  RC_ASSERT((contentSum(a) == contentSum(b)) == (pack(a) == pack(b)));
}

const RecordFileKind kMadeUp{"PropFILE", 1, 7};

std::string written(const std::string& name, const std::vector<std::pair<RecordName, Bytes>>& records) {
  const std::string path = test::temporary(name);
  std::string error;
  const auto writer = RecordWriter::create(path, kMadeUp, Unfinished::Removed, error);
  RC_ASSERT(writer != nullptr);
  for (const auto& [record, content] : records) RC_ASSERT(writer->write(record, content));
  RC_ASSERT(writer->finish());
  return path;
}

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::pair<RecordName, Bytes>> madeUpRecords() {
  const auto names = *rc::gen::arbitrary<std::set<std::pair<uint32_t, uint32_t>>>();
  std::vector<std::pair<RecordName, Bytes>> out;
  for (const auto& [kind, index] : names) {
    const auto content = *rc::gen::arbitrary<std::vector<uint8_t>>();
    const BytesView view = std::as_bytes(std::span(content));
    out.push_back({{kind, index}, Bytes(view.begin(), view.end())});
  }
  return out;
}

RC_GTEST_PROP(FilesOfRecords, HaveTheSameBytesInWhateverOrderRecordsWereWritten, ()) {
  auto records = madeUpRecords();
  const std::string sorted = contentOf(written("sorted", records));
  for (size_t i = records.size(); i > 1; --i) std::swap(records[i - 1], records[*test::wholeIn<size_t>(0, i)]);
  RC_ASSERT(contentOf(written("shuffled", records)) == sorted);
}

RC_GTEST_PROP(FilesOfRecords, GiveBackEveryRecord, ()) {
  const auto records = madeUpRecords();
  std::string error;
  const auto file = RecordFile::open(written("whole", records), kMadeUp, error);
  RC_ASSERT(file != nullptr);
  RC_ASSERT(file->names().size() == records.size());
  for (const auto& [name, content] : records) RC_ASSERT(file->read(name, error) == content);
}

RC_GTEST_PROP(FilesOfRecords, NeverGiveBackAChangedRecord, ()) {
  const auto records = madeUpRecords();
  const std::string path = written("changed", records);
  std::string content = contentOf(path);
  char& byte = content[*test::wholeIn<size_t>(0, content.size())];
  byte = static_cast<char>(byte ^ *test::wholeIn(1, 256));
  std::ofstream(path, std::ios::binary) << content;
  std::string error;
  const auto file = RecordFile::open(path, kMadeUp, error);
  if (!file) return;
  for (const auto& [name, expected] : records) {
    const auto read = file->read(name, error);
    if (read) RC_ASSERT(*read == expected);  // RC_ASSERT evaluates both sides of ||
  }
}

RC_GTEST_PROP(MortonPlaces, InterleaveTheBitsOfTheThreeAxes, ()) {
  glm::uvec3 cell;
  for (int axis = 0; axis < 3; ++axis) cell[axis] = *test::wholeIn(0U, 1U << 21);
  uint64_t place = mortonPlace(cell);
  for (int bit = 0; bit < 63; ++bit, place >>= 1) RC_ASSERT((place & 1) == (cell[bit % 3] >> (bit / 3) & 1));
}

RC_GTEST_PROP(PackedNormals, TurnByLessThanFourThousandthsOfADegree, ()) {
  const vec3 n = madeUpVector(-1, 1);
  RC_PRE(dot(n, n) > 0);
  const glm::dvec3 a = glm::normalize(glm::dvec3(n)), b = glm::normalize(glm::dvec3(unpackNormal(packNormal(n))));
  RC_ASSERT(glm::degrees(std::asin(std::min(1.0, glm::length(glm::cross(a, b))))) < 0.004);
  RC_ASSERT(glm::dot(a, b) > 0);
}

RC_GTEST_PROP(Distributions, PickEachChoiceByTheShareOfItsWeight, ()) {
  const auto weights = *rc::gen::nonEmpty(rc::gen::container<std::vector<double>>(
      rc::gen::map(test::wholeIn(0, 100), [](int w) { return static_cast<double>(w); })));
  Distribution distribution;
  double total = 0;
  for (const double w : weights) distribution.add(w), total += w;
  RC_PRE(total > 0);
  RC_ASSERT(distribution.total() == total);
  const double x = *numberIn(0, 4095.0f / 4096);
  double inside = x;
  const size_t choice = distribution.pick(inside);
  double before = 0;
  for (size_t i = 0; i < choice; ++i) before += weights[i];
  RC_ASSERT(weights[choice] > 0);
  RC_ASSERT(std::abs((before + inside * weights[choice]) / total - x) < 1e-12);
}

}  // namespace
}  // namespace tomales
