// Noun: the lights that are switched on for an object (RISpec 3.2 section 4.2.5). Threads: like a vector.
#pragma once
#include <compare>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <vector>

namespace tomales {

/// Numbers of lights, each at most once, in the order in which they were switched on. Runs of consecutive numbers are
/// kept as two numbers: a scene of many lamps with geometry has as many lists, and each names all lamps before it, so
/// that one number for each light would take memory and time as the square of their number.
class LightList {
 public:
  /// The lights first, first + 1, ..., end - 1.
  struct Run {
    int first, end;
    auto operator<=>(const Run&) const = default;
  };

  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = int;
    using difference_type = std::ptrdiff_t;
    using pointer = const int*;
    using reference = int;

    Iterator() = default;
    explicit Iterator(std::vector<Run>::const_iterator run) : run_(run) {}
    int operator*() const { return run_->first + offset_; }
    Iterator& operator++() {
      if (run_->first + ++offset_ != run_->end) return *this;
      ++run_;
      offset_ = 0;
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator&) const = default;

   private:
    std::vector<Run>::const_iterator run_;
    int offset_ = 0;
  };

  LightList() = default;
  LightList(std::initializer_list<int> lights) {
    for (const int light : lights) switchOn(light);
  }

  Iterator begin() const { return Iterator(runs_.begin()); }
  Iterator end() const { return Iterator(runs_.end()); }
  bool empty() const { return runs_.empty(); }
  size_t size() const;
  bool contains(int light) const;
  /// Tells whether the other list begins with the lights of this one, in their order.
  bool begins(const LightList& longer) const;
  /// Lists that begin with another one follow it.
  auto operator<=>(const LightList&) const = default;

  /// Puts the light at the end, wherever it was before.
  void switchOn(int light);
  /// Puts a light at the end that is not in the list. Unlike switchOn, it does not search.
  void add(int light) { append({light, light + 1}); }
  void switchOff(int light);
  void clear() { runs_.clear(); }
  /// Returns those that the other list, of ascending numbers, has too.
  LightList among(const LightList& ascending) const;

 private:
  template <class A>
  friend void fields(A& a, LightList& x);  // state_fields.h

  void append(Run run);

  std::vector<Run> runs_;  ///< None is empty, and none goes on where the one before it ends.
};

}  // namespace tomales
