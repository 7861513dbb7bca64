// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace comptonaut {

/// Allocates from the start of a cache line on: no load or store of up to 64 bytes at a multiple of its size takes two.
template <typename T>
struct LineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kLine{64};

  LineAllocator() = default;
  template <typename U>
  explicit(false) LineAllocator(const LineAllocator<U>&) {}

  [[nodiscard]] T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kLine)); }
  void deallocate(T* at, std::size_t) { ::operator delete(at, kLine); }
  bool operator==(const LineAllocator&) const { return true; }
};

template <typename T>
using AlignedVector = std::vector<T, LineAllocator<T>>;

/// The same, but resizing leaves new values blank, as they are in memory: for those that are written right after.
template <typename T>
struct BlankLineAllocator : LineAllocator<T> {
  template <typename U>
  struct rebind {
    using other = BlankLineAllocator<U>;
  };
  BlankLineAllocator() = default;
  template <typename U>
  explicit(false) BlankLineAllocator(const BlankLineAllocator<U>&) {}

  template <typename U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
};

template <typename T>
using BlankVector = std::vector<T, BlankLineAllocator<T>>;

}  // namespace comptonaut
