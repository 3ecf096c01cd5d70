// An array whose elements are written before they are read: filling it with zeros first would touch all of it once
// more, on one thread.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace tangent {

template <class T>
class Unfilled {
 public:
  explicit Unfilled(std::size_t size = 0) : data_(std::make_unique_for_overwrite<T[]>(size)), size_(size) {}

  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  operator std::span<const T>() const { return {data_.get(), size_}; }

 private:
  std::unique_ptr<T[]> data_;
  std::size_t size_;
};

}  // namespace tangent
