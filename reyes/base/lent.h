// Memory that several lists use, one after the other.
#pragma once
#include <vector>

namespace tomales {

/// Lends `memory` to an empty list while this object lives. At the end the list gets a copy of its elements that is no
/// larger than needed, and `memory` is taken back.
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
