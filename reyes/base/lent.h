// Memory that lists take turns to use.
#pragma once
#include <vector>

namespace tomales {

/// Lends an empty list memory, and takes it back for a copy that has no more than it needs.
template <class T>
class Lent {
 public:
  Lent(std::vector<T>& list, std::vector<T>& memory) : list_(list), memory_(memory) {
    list_.swap(memory_);
    list_.clear();
  }
  ~Lent() {
    memory_.assign(list_.begin(), list_.end());
    list_.swap(memory_);
  }
  Lent(const Lent&) = delete;

 private:
  std::vector<T>&list_, &memory_;
};

}  // namespace tomales
