// BodySet<S>: bodies side by side. StaticBodies<S>: those that stay where they are, in pages that copies share.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/core/lower_bound.hpp"
#include "isostep/core/remembered.hpp"
#include "isostep/core/shared.hpp"
#include "isostep/dynamics/body.hpp"

namespace isostep {

/// Bodies side by side, ascending by slot.
template <class S> struct BodySet {
  std::vector<BodyState<S>> states;
  std::vector<BodyProperties<S>> properties;

  // These are as the compiler makes them, but no weak functions in each of the files that copy what is Shared.
  ISO_INLINE BodySet() = default;
  ISO_INLINE BodySet(const BodySet&) = default;
  ISO_INLINE BodySet(BodySet&&) = default;
  ISO_INLINE BodySet& operator=(const BodySet&) = default;
  ISO_INLINE BodySet& operator=(BodySet&&) = default;
};

/// Static bodies, ascending by slot too. A page holds the bodies of kPageSlots slots in a row, so the slot alone gives
/// the page. A body that comes, goes or changes copies at most one page; copies share all others. A place, which is a
/// page and a row, names a body until that page changes.
template <class S> class StaticBodies {
 public:
  using Page = BodySet<S>;
  static constexpr std::uint32_t kPageSlots = 64;  // a page of 20 kB: copied in some microseconds

  ISO_INLINE StaticBodies() : size_(0) {}
  ISO_INLINE StaticBodies(const StaticBodies&) = default;
  ISO_INLINE StaticBodies& operator=(const StaticBodies&) = default;
  ISO_INLINE ~StaticBodies() {}

  ISO_INLINE std::size_t size() const { return size_; }
  ISO_INLINE bool empty() const { return size_ == 0; }
  ISO_INLINE const BodyState<S>& state(std::uint32_t place) const {
    return pages_[place / kPageSlots]->states[place % kPageSlots];
  }
  ISO_INLINE const BodyProperties<S>& properties(std::uint32_t place) const {
    return pages_[place / kPageSlots]->properties[place % kPageSlots];
  }
  /// Returns the page of a place for writing, valid until the next copy. Bodies keep their slots.
  ISO_INLINE Page& change_page_of(std::uint32_t place) { return own(place / kPageSlots); }

  /// Inserts a body and returns its place.
  ISO_INLINE std::uint32_t insert(const BodyState<S>& state, const BodyProperties<S>& body) {
    const std::uint32_t p = state.slot / kPageSlots;
    if (pages_.size() <= p) pages_.resize(p + 1, Shared<Page>());
    Page& page = own(p);
    const std::size_t row = place_of_slot(page.states, state.slot);
    const auto at = static_cast<std::ptrdiff_t>(row);
    page.states.insert(page.states.begin() + at, state);
    page.properties.insert(page.properties.begin() + at, body);
    ++size_;
    return place_of(p, row);
  }
  ISO_INLINE void erase(std::uint32_t place) {
    Page& page = own(place / kPageSlots);
    const auto row = static_cast<std::ptrdiff_t>(place % kPageSlots);
    page.states.erase(page.states.begin() + row);
    page.properties.erase(page.properties.begin() + row);
    --size_;
  }

  // Pages, for those who read them whole. Some are empty.
  ISO_INLINE std::size_t pages() const { return pages_.size(); }
  ISO_INLINE const Page& page(std::size_t p) const { return *pages_[p]; }
  ISO_INLINE static std::uint32_t place_of(std::size_t page, std::size_t row) {
    return static_cast<std::uint32_t>(page) * kPageSlots + static_cast<std::uint32_t>(row);
  }
  /// Calls visit(state, properties) for all bodies, ascending by slot.
  template <class Visit> ISO_INLINE void each(const Visit& visit) const {
    for (const Shared<Page>& page : pages_) {
      for (std::size_t i = 0; i < page->states.size(); ++i) visit(page->states[i], page->properties[i]);
    }
  }
  ISO_INLINE bool shares_page(std::size_t p, const StaticBodies& other) const {
    return p < pages_.size() && p < other.pages_.size() && pages_[p].is_same(other.pages_[p]);
  }

  /// Returns a value that was computed of a page, `which` 0 to 2. Hashes use 0 and 1.
  ISO_INLINE const Remembered& remembered(std::size_t p, int which) const { return pages_[p].remembered(which); }
  /// Returns a value that was computed of all pages, `which` 0 or 1. The hash uses 0.
  ISO_INLINE const Remembered& remembered_of_all(int which) const { return remembered_[which]; }

  /// The rows of all pages in one list, of states or of properties.
  template <class Row> struct Rows {
    std::vector<Row*> rows;
    ISO_INLINE std::size_t size() const { return rows.size(); }
    ISO_INLINE Row& operator[](std::size_t i) const { return *rows[i]; }
  };
  /// Calls visit("name", list) with the states, then with the properties: for code that looks at every field.
  template <class Visit> void arrays(Visit&& visit) const {
    Rows<const BodyState<S>> states;
    Rows<const BodyProperties<S>> properties;
    each([&](const BodyState<S>& state, const BodyProperties<S>& body) {
      states.rows.push_back(&state);
      properties.rows.push_back(&body);
    });
    visit("static_bodies", states);
    visit("static_properties", properties);
  }
  /// Visits both lists for writing.
  template <class Visit> void change_arrays(Visit&& visit) {
    Rows<BodyState<S>> states;
    Rows<BodyProperties<S>> properties;
    for (std::uint32_t p = 0; p < pages_.size(); ++p) {
      Page& page = own(p);
      for (std::size_t i = 0; i < page.states.size(); ++i) {
        states.rows.push_back(&page.states[i]);
        properties.rows.push_back(&page.properties[i]);
      }
    }
    visit("static_bodies", states);
    visit("static_properties", properties);
  }

 private:
  ISO_INLINE Page& own(std::uint32_t p) {
    for (Remembered& remembered : remembered_) remembered.forget();
    return pages_[p].change();
  }

  std::vector<Shared<Page>> pages_;
  std::size_t size_;
  Remembered remembered_[2];
};

}  // namespace isostep
