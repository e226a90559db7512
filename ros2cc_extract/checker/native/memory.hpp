// Large zeroed blocks on huge pages: random looks at them otherwise wait for page tables.
#pragma once

#include <sys/mman.h>

#include <cstdint>
#include <new>
#include <utility>

namespace core {

template <class T>
class Block {
 public:
  Block() = default;
  explicit Block(size_t count) : bytes_((count * sizeof(T) + kHuge - 1) / kHuge * kHuge) {
    // One huge page more than needed, so that the block can start at a multiple of its size.
    reserved_ = bytes_ + kHuge;
    base_ = mmap(nullptr, reserved_, PROT_READ | PROT_WRITE,
                 MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (base_ == MAP_FAILED) throw std::bad_alloc();
    const uintptr_t start = (reinterpret_cast<uintptr_t>(base_) + kHuge - 1) / kHuge * kHuge;
    data_ = reinterpret_cast<T*>(start);
#ifdef MADV_HUGEPAGE
    if (count * sizeof(T) >= kHuge) madvise(data_, bytes_, MADV_HUGEPAGE);
#endif
  }
  Block(Block&& other) noexcept { swap(other); }
  Block& operator=(Block&& other) noexcept {
    swap(other);
    return *this;
  }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;
  ~Block() {
    if (data_ != nullptr) munmap(base_, reserved_);
  }

  T& operator[](size_t i) { return data_[i]; }
  const T& operator[](size_t i) const { return data_[i]; }
  T* data() { return data_; }
  const T* data() const { return data_; }

 private:
  static constexpr size_t kHuge = size_t{1} << 21;

  void swap(Block& other) {
    std::swap(data_, other.data_);
    std::swap(base_, other.base_);
    std::swap(bytes_, other.bytes_);
    std::swap(reserved_, other.reserved_);
  }

  T* data_ = nullptr;
  void* base_ = nullptr;
  size_t bytes_ = 0, reserved_ = 0;
};

}  // namespace core
