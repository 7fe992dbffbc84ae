// Structures to bytes and back, for files. A type is packed by one list of its fields that serves both ways:
//   template <class A> void fields(A& a, Lens& x) { auto& [radius, name] = x; each(a, radius, name); }
// The structured binding makes the compiler stop at a structure that has gained a field which the list lacks.
//   Packer      appends to bytes
//   Unpacker    takes from bytes; `damaged` once they do not fit
//   ContentSum  a number that changes with the values
//   SchemaSum   a number that changes with the lists, so that builds that differ do not read each other's files
#pragma once
#include <array>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "reyes/base/math.h"
#include "reyes/base/record_file.h"

namespace tomales {

/// True for types that are stored as they are in memory.
template <class T>
constexpr bool kPacksRaw =
    (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) || std::is_enum_v<T> || std::is_same_v<T, vec2> ||
    std::is_same_v<T, vec3> || std::is_same_v<T, vec4> || std::is_same_v<T, mat4>;

struct Packer {
  Bytes bytes;
  template <class... T>
  void put(const T&... x) {
    (field(*this, const_cast<T&>(x)), ...);  // packing changes nothing
  }
  void raw(const void* data, size_t size) {
    const auto* p = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), p, p + size);
  }
};

struct Unpacker {
  BytesView bytes;
  bool damaged = false;
  template <class T>
  T get() {
    T x{};
    field(*this, x);
    return x;
  }
  void raw(void* data, size_t size) {
    if (size > bytes.size()) {
      damaged = true;
      bytes = {};
      if (size > 0) std::memset(data, 0, size);
    } else if (size > 0) {
      std::memcpy(data, bytes.data(), size);
      bytes = bytes.subspan(size);
    }
  }
};

struct ContentSum {
  uint64_t sum = 0;
  void raw(const void* data, size_t size) {
    const uint64_t both[2] = {sum, checksum({static_cast<const std::byte*>(data), size})};
    sum = checksum(std::as_bytes(std::span(both)));
  }
};

struct SchemaSum {
  uint64_t sum = 0;
  void add(uint64_t what) {
    const uint64_t both[2] = {sum, what};
    sum = checksum(std::as_bytes(std::span(both)));
  }
};

template <class A>
constexpr bool kUnpacks = std::is_same_v<A, Unpacker>;
template <class A>
constexpr bool kIsSchema = std::is_same_v<A, SchemaSum>;

template <class A, class... T>
void each(A& a, T&... x) {
  (field(a, x), ...);
}

template <class A, class T>
requires kPacksRaw<T>
void field(A& a, T& x) {
  if constexpr (kIsSchema<A>)
    a.add(sizeof(T) << 8 | (std::is_floating_point_v<T> ? 1 : 2));
  else
    a.raw(&x, sizeof(T));
}

template <class A>
void field(A& a, bool& x) {
  uint8_t byte = x;
  field(a, byte);
  if constexpr (kUnpacks<A>) x = byte != 0;
}

/// Packs the number of the elements that follow, each at least one byte; 0 for a schema.
template <class A>
size_t countField(A& a, size_t count) {
  if constexpr (kIsSchema<A>) {
    a.add(3);
    return 0;
  } else {
    uint64_t n = count;
    a.raw(&n, sizeof(n));
    if constexpr (kUnpacks<A>)
      if (n > a.bytes.size()) a.damaged = true, n = 0;
    return static_cast<size_t>(n);
  }
}

template <class A>
void field(A& a, std::string& x) {
  x.resize(countField(a, x.size()));
  if constexpr (!kIsSchema<A>) a.raw(x.data(), x.size());
}

template <class A, class T, class Allocator>
void field(A& a, std::vector<T, Allocator>& x) {
  if constexpr (kIsSchema<A>) {
    T example{};
    a.add(4), field(a, example);
  } else {
    const size_t n = countField(a, x.size());
    if constexpr (kPacksRaw<T>) {
      if constexpr (kUnpacks<A>)
        if (n > a.bytes.size() / sizeof(T)) return void(a.damaged = true);
      x.resize(n);
      a.raw(x.data(), n * sizeof(T));
    } else if constexpr (kUnpacks<A>) {
      // A forged number of elements takes no memory before their bytes are there.
      x.clear();
      for (size_t i = 0; i < n && !a.damaged; ++i) field(a, x.emplace_back());
    } else {
      for (T& element : x) field(a, element);
    }
  }
}

template <class A, class T, size_t N>
void field(A& a, std::array<T, N>& x) {
  for (T& element : x) field(a, element);
}
template <class A, class T, size_t N>
void field(A& a, T (&x)[N]) {
  for (T& element : x) field(a, element);
}

template <class A, class T>
void field(A& a, std::optional<T>& x) {
  bool there = x.has_value();
  field(a, there);
  if constexpr (kIsSchema<A>) there = true;
  if (there && !x) x.emplace();
  if (there) field(a, *x);
}

/// Packs a copy, so that pointers that shared an object do not share it any more.
template <class A, class T>
void field(A& a, std::shared_ptr<T>& x) {
  std::optional<std::remove_const_t<T>> value;
  if (x) value = *x;
  field(a, value);
  if constexpr (kUnpacks<A>) x = value ? std::make_shared<T>(std::move(*value)) : nullptr;
}

template <class A, class K, class V>
void field(A& a, std::map<K, V>& x) {
  if constexpr (kIsSchema<A>) {
    K key{};
    V value{};
    each(a, key, value);
  } else {
    const size_t n = countField(a, x.size());
    if constexpr (kUnpacks<A>) {
      for (size_t i = 0; i < n && !a.damaged; ++i) {
        K key{};
        field(a, key), field(a, x[key]);
      }
    } else {
      for (auto& [key, value] : x) {
        K copy = key;
        each(a, copy, value);
      }
    }
  }
}

template <class A, class T>
void field(A& a, std::set<T>& x) {
  std::vector<T> elements(x.begin(), x.end());
  field(a, elements);
  if constexpr (kUnpacks<A>) x = {elements.begin(), elements.end()};
}

template <class A, class T>
requires requires(A& a, T& x) { fields(a, x); }
void field(A& a, T& x) {
  if constexpr (kIsSchema<A>) a.add(5);
  fields(a, x);
}

template <class T>
Bytes pack(const T& x) {
  Packer packer;
  packer.put(x);
  return std::move(packer.bytes);
}

/// Returns false if the bytes are not those of a T.
template <class T>
bool unpack(BytesView bytes, T& out) {
  Unpacker unpacker{bytes};
  field(unpacker, out);
  return !unpacker.damaged && unpacker.bytes.empty();
}

/// Returns the ContentSum of all values, in their order.
template <class... T>
uint64_t contentSum(const T&... x) {
  ContentSum sum;
  (field(sum, const_cast<T&>(x)), ...);
  return sum.sum;
}

template <class T>
uint64_t schemaOf() {
  SchemaSum schema;
  T example{};
  field(schema, example);
  return schema.sum;
}

}  // namespace tomales
