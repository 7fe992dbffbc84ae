// A sequence in blocks of one size, which grows without moving its elements: it never needs memory for two copies, and
// at most one block is partly unused. Threads: as std::vector.
#pragma once
#include <cstddef>
#include <iterator>
#include <memory>
#include <vector>

namespace tomales {

template <class T>
class BlockVector {
 public:
  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](size_t i) { return blocks_[i / kBlock][i % kBlock]; }
  const T& operator[](size_t i) const { return blocks_[i / kBlock][i % kBlock]; }
  T& back() { return (*this)[size_ - 1]; }
  void push_back(const T& t) {
    if (size_ == blocks_.size() * kBlock) blocks_.push_back(std::make_unique<T[]>(kBlock));
    (*this)[size_++] = t;
  }

  struct Iterator {
    using iterator_category = std::forward_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = const T*;
    using reference = const T&;
    const BlockVector* vector = nullptr;
    size_t i = 0;
    const T& operator*() const { return (*vector)[i]; }
    const T* operator->() const { return &(*vector)[i]; }
    Iterator& operator++() { return ++i, *this; }
    Iterator operator++(int) { return {vector, i++}; }
    bool operator==(const Iterator& o) const { return i == o.i; }
  };
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, size_}; }

 private:
  static constexpr size_t kBlock = 1024;

  std::vector<std::unique_ptr<T[]>> blocks_;
  size_t size_ = 0;
};

}  // namespace tomales
