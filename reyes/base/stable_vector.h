// A sequence that grows while others read it: elements never move. Threads: one may append while others use elements
// that they know of; only that one may iterate or call size().
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>

namespace tomales {

template <class T>
class StableVector {
 public:
  StableVector() = default;
  StableVector(const StableVector& o) { *this = o; }
  StableVector(StableVector&& o) noexcept { swap(o); }
  StableVector& operator=(StableVector&& o) noexcept {
    clear();
    swap(o);
    return *this;
  }
  StableVector& operator=(const StableVector& o) {
    if (this == &o) return *this;
    clear();
    for (const T& t : o) push_back(t);
    return *this;
  }

  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](size_t i) { return element(*this, i); }
  const T& operator[](size_t i) const { return element(*this, i); }
  const T& at(size_t i) const {
    if (i >= size_) throw std::out_of_range("StableVector");
    return (*this)[i];
  }
  T& back() { return (*this)[size_ - 1]; }
  const T& back() const { return (*this)[size_ - 1]; }
  T& front() { return (*this)[0]; }
  const T& front() const { return (*this)[0]; }
  T& push_back(T t) {
    const auto [block, offset] = placeOf(size_);
    if (!blocks_[block]) blocks_[block] = std::make_unique<T[]>(kFirst << block);
    ++size_;
    return blocks_[block][offset] = std::move(t);
  }
  void clear() {
    for (auto& block : blocks_) block.reset();
    size_ = 0;
  }

  template <class Vector, class Element>
  struct Iterator {
    using iterator_category = std::forward_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = Element*;
    using reference = Element&;
    Vector* vector = nullptr;
    size_t i = 0;
    Element& operator*() const { return (*vector)[i]; }
    Element* operator->() const { return &(*vector)[i]; }
    Iterator& operator++() { return ++i, *this; }
    Iterator operator++(int) { return {vector, i++}; }
    bool operator==(const Iterator& o) const { return i == o.i; }
  };
  auto begin() { return Iterator<StableVector, T>{this, 0}; }
  auto end() { return Iterator<StableVector, T>{this, size_}; }
  auto begin() const { return Iterator<const StableVector, const T>{this, 0}; }
  auto end() const { return Iterator<const StableVector, const T>{this, size_}; }

 private:
  static constexpr size_t kFirst = 16;  ///< Elements of the first block; each block is twice as long as the one before.

  static std::pair<size_t, size_t> placeOf(size_t i) {
    const size_t block = static_cast<size_t>(std::bit_width(i / kFirst + 1)) - 1;
    return {block, i - kFirst * ((size_t{1} << block) - 1)};
  }
  template <class Self>
  static auto& element(Self& self, size_t i) {
    const auto [block, offset] = placeOf(i);
    return self.blocks_[block][offset];
  }
  void swap(StableVector& o) noexcept { std::swap(blocks_, o.blocks_), std::swap(size_, o.size_); }

  std::array<std::unique_ptr<T[]>, 40> blocks_;
  size_t size_ = 0;
};

}  // namespace tomales
