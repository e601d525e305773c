// PagedArray: an array in pages that copies share until one of them changes, so that a copy costs what differs.
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "isostep/core/remembered.hpp"

namespace isostep {

/// One reads it as an array. A page is changed in place while one array alone has it, else copied first; a page that
/// two arrays share is never written, so arrays that share pages may live on different threads. Two arrays with the
/// same page at the same place have equal items there.
template <class T, std::uint32_t kPageSize> class PagedArray {
  static_assert((kPageSize & (kPageSize - 1)) == 0, "an index is split by shift and mask");

 public:
  ISO_INLINE PagedArray() : size_(0) {}
  ISO_INLINE PagedArray(const PagedArray& other) : size_(0) { *this = other; }
  ISO_INLINE PagedArray(PagedArray&& other) noexcept : pages_(std::move(other.pages_)), size_(other.size_) {
    other.pages_.clear();
    other.size_ = 0;
  }
  ISO_INLINE ~PagedArray() { clear(); }
  /// Costs a look at every page, and a count for those that differ. Allocates nothing if the other was as long before.
  ISO_INLINE PagedArray& operator=(const PagedArray& other) {
    if (this == &other) return *this;
    while (pages_.size() > other.pages_.size()) drop_last_page();
    pages_.reserve(other.pages_.size());
    for (std::size_t p = 0; p < other.pages_.size(); ++p) {
      Page* const page = other.pages_[p];
      if (p < pages_.size() && pages_[p] == page) continue;
      page->owners.fetch_add(1, std::memory_order_relaxed);
      if (p < pages_.size()) release(std::exchange(pages_[p], page));
      else pages_.push_back(page);
    }
    size_ = other.size_;
    return *this;
  }
  ISO_INLINE PagedArray& operator=(PagedArray&& other) noexcept {
    std::swap(pages_, other.pages_);
    std::swap(size_, other.size_);
    return *this;
  }

  ISO_INLINE std::size_t size() const { return size_; }
  ISO_INLINE bool empty() const { return size_ == 0; }
  ISO_INLINE const T& operator[](std::size_t i) const { return pages_[i / kPageSize]->items[i % kPageSize]; }

  /// Returns an item to be written. The reference holds until the next call that writes or copies.
  ISO_INLINE T& change(std::size_t i) { return own(i / kPageSize).items[i % kPageSize]; }
  ISO_INLINE void push_back(T item) {
    if (size_ % kPageSize == 0) pages_.push_back(new Page);
    own(size_ / kPageSize).items[size_ % kPageSize] = std::move(item);
    ++size_;
  }
  ISO_INLINE void pop_back() {
    --size_;
    if (size_ % kPageSize == 0) drop_last_page();
    else own(size_ / kPageSize).items[size_ % kPageSize] = T{};
  }
  ISO_INLINE void clear() {
    while (!pages_.empty()) drop_last_page();
    size_ = 0;
  }

  /// Calls visit(index) ascending, for every item that only one array has or that differs. Skips pages that both share.
  template <class Visit> ISO_INLINE void each_difference(const PagedArray& other, const Visit& visit) const {
    const std::size_t most = size_ < other.size_ ? other.size_ : size_;
    const std::size_t common = size_ < other.size_ ? size_ : other.size_;
    for (std::size_t i = 0; i < most; ++i) {
      const std::size_t p = i / kPageSize;
      if (i % kPageSize == 0 && shares_page(p, other)) i += kPageSize - 1;
      else if (i >= common || !((*this)[i] == other[i])) visit(i);
    }
  }

  // Pages, for those who read them whole.
  ISO_INLINE std::size_t pages() const { return pages_.size(); }
  ISO_INLINE const T* page(std::size_t p) const { return pages_[p]->items; }
  /// Returns the number of items in a page: kPageSize, except for the last.
  ISO_INLINE std::size_t page_size(std::size_t p) const {
    return p + 1 < pages_.size() ? kPageSize : size_ - p * kPageSize;
  }
  /// Returns the number computed from a page's items.
  ISO_INLINE const Remembered& remembered(std::size_t p) const { return pages_[p]->remembered; }
  ISO_INLINE bool shares_page(std::size_t p, const PagedArray& other) const {
    return p < pages_.size() && p < other.pages_.size() && pages_[p] == other.pages_[p];
  }

  struct Iterator {
    const PagedArray* array;
    std::size_t at;
    ISO_INLINE const T& operator*() const { return (*array)[at]; }
    ISO_INLINE Iterator& operator++() {
      ++at;
      return *this;
    }
    friend ISO_INLINE bool operator!=(const Iterator& a, const Iterator& b) { return a.at != b.at; }
  };
  ISO_INLINE Iterator begin() const { return {this, 0}; }
  ISO_INLINE Iterator end() const { return {this, size_}; }

 private:
  struct Page {
    ISO_INLINE Page() : owners(1) {}
    ISO_INLINE Page(const Page& other) : owners(1) {
      for (std::uint32_t i = 0; i < kPageSize; ++i) items[i] = other.items[i];
    }
    ISO_INLINE ~Page() {}
    std::atomic<std::uint32_t> owners;
    Remembered remembered;
    T items[kPageSize] = {};
  };

  static ISO_INLINE void release(Page* page) {
    if (page->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) delete page;
  }
  ISO_INLINE void drop_last_page() {
    release(pages_.back());
    pages_.pop_back();
  }
  ISO_INLINE Page& own(std::size_t p) {
    Page*& page = pages_[p];
    if (page->owners.load(std::memory_order_acquire) != 1) release(std::exchange(page, new Page(*page)));
    page->remembered.forget();
    return *page;
  }

  std::vector<Page*> pages_;
  std::size_t size_;
};

}  // namespace isostep
