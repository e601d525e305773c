// Writer and Reader: the portable form of state, for files and late joiners. Both are visitors of `fields`.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <vector>

#include "isostep/core/bytes.hpp"
#include "isostep/core/result.hpp"
#include "isostep/state/pack.hpp"

namespace isostep {

namespace detail {
template <class T> constexpr bool has_bool();
struct BoolVisitor {
  bool* found;
  template <class T> constexpr void operator()(const char*, const T&) const { *found = *found || has_bool<T>(); }
};
/// Returns true if T holds a bool: then its bytes must be checked before they become a T.
template <class T> constexpr bool has_bool() {
  if constexpr (std::is_bounded_array_v<T>) {
    return has_bool<std::remove_extent_t<T>>();
  } else if constexpr (HasFields<T>) {
    bool found = false;
    const T value{};
    T::fields(BoolVisitor{&found}, value);
    return found;
  } else {
    return std::is_same_v<T, bool>;
  }
}
}  // namespace detail

/// Records whose canonical bytes may be copied to and from memory whole.
template <class T>
inline constexpr bool kCopiesWhole = kHasNoPadding<T> && !detail::has_bool<T>() && std::is_trivially_copyable_v<T> &&
                                     std::endian::native == std::endian::little;

class Reader;

namespace detail {
struct ShortReadVisitor {
  Reader* reader;
  template <class T> ISO_INLINE void operator()(const char* name, T& value) const;
};
}  // namespace detail

/// Appends to the caller's bytes. Never fails.
class Writer {
 public:
  ISO_INLINE explicit Writer(std::vector<std::uint8_t>& out) : out_(&out) {}

  template <class T> ISO_INLINE void write(const T& value) { pack(grow(kPackedSize<T>), value); }
  template <class T> ISO_INLINE void operator()(const char*, const T& value) { write(value); }
  /// Writes the short form, see pack_short.
  template <class T> ISO_INLINE void write_short(const T& value) {
    std::uint8_t bytes[kMostShort<T> + 1];
    write_raw({bytes, pack_short(bytes, value)});
  }

  /// Writes n records, with no count before them.
  template <class T> ISO_INLINE void write_records(const T* first, std::size_t n) {
    if constexpr (kCopiesWhole<T>) {
      write_raw({reinterpret_cast<const std::uint8_t*>(first), n * sizeof(T)});
    } else {
      std::uint8_t* at = grow(n * kPackedSize<T>);
      for (std::size_t i = 0; i < n; ++i) at = pack(at, first[i]);
    }
  }
  /// Writes a u32 count and the records.
  template <class T> ISO_INLINE void write_array(const T* first, std::size_t n) {
    write_count(n);
    write_records(first, n);
  }
  template <class T> ISO_INLINE void write_array(const std::vector<T>& records) {
    write_array(records.data(), records.size());
  }
  /// Writes a u32 count and the bytes.
  ISO_INLINE void write_bytes(Bytes bytes) {
    write_count(bytes.size());
    write_raw(bytes);
  }
  ISO_INLINE void write_text(std::string_view text) {
    write_bytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }

  /// A count of 2^32 or more is the caller's bug.
  void write_count(std::size_t count);
  void write_raw(Bytes bytes);
  std::size_t size() const;

 private:
  /// Appends `more` bytes. The pointer is valid until the next call.
  std::uint8_t* grow(std::size_t more);

  std::vector<std::uint8_t>* out_;
};

/// Reads what a Writer wrote, from untrusted bytes. The first failure sticks: every later read returns zero, so a
/// caller may read a whole record and check once.
class Reader {
 public:
  ISO_INLINE explicit Reader(Bytes bytes)
      : bytes_(bytes), offset_(0), code_(ErrorCode::truncated), ok_(true), reason_(nullptr), field_(nullptr) {}

  ISO_INLINE bool ok() const { return ok_; }
  ISO_INLINE std::size_t remaining() const { return ok_ ? bytes_.size() - offset_ : 0; }
  /// Returns the offset of the next byte, or of the byte where reading failed.
  ISO_INLINE std::size_t offset() const { return offset_; }

  template <class T> ISO_INLINE bool read(T& value) {
    if constexpr (std::is_bounded_array_v<T>) {
      return read_records(value, std::extent_v<T>);
    } else if constexpr (HasFields<T>) {
      T::fields(*this, value);
    } else {
      static_assert(FieldValue<T>, "a stored member is a number, a struct with fields or an array of them");
      FieldBits<T> bits = 0;
      if (const std::uint8_t* at = take(sizeof(T))) bits = load_le<FieldBits<T>>(at);
      if constexpr (std::is_same_v<T, bool>) {
        if (bits > 1) bits = refuse_bool();
      }
      value = field_from_bits<T>(bits);
    }
    return ok_;
  }
  template <class T> ISO_INLINE T read() {
    T value{};
    read(value);
    return value;
  }
  template <class T> ISO_INLINE void operator()(const char* name, T& value) {
    if (ok_) field_ = name;
    read(value);
  }

  /// Reads what write_short wrote. A number in more bytes than it needs, or above its type's largest, is corrupt, so
  /// that a value has one form.
  template <class T> ISO_INLINE bool read_short(T& value) {
    if constexpr (std::is_bounded_array_v<T>) {
      for (auto& element : value) read_short(element);
    } else if constexpr (HasFields<T>) {
      T::fields(detail::ShortReadVisitor{this}, value);
    } else if constexpr (kIsLeb128<T>) {
      constexpr std::uint64_t kMost = static_cast<FieldBits<T>>(~FieldBits<T>{});
      value = field_from_bits<T>(static_cast<FieldBits<T>>(read_leb128(kMost)));
    } else {
      read(value);
    }
    return ok_;
  }
  /// Reads the short form of a field of that name.
  template <class T> ISO_INLINE void read_short_field(const char* name, T& value) {
    if (ok_) field_ = name;
    read_short(value);
  }

  template <class T> ISO_INLINE bool read_records(T* first, std::size_t n) {
    if constexpr (kCopiesWhole<T>) {
      return read_raw(first, n, sizeof(T));
    } else {
      for (std::size_t i = 0; i < n; ++i) read(first[i]);
      return ok_;
    }
  }
  /// Reads a count that is at most `cap` and whose records of `packed_size` bytes each are all there. Else it fails and
  /// returns 0. Call it before allocating.
  std::uint32_t read_count(std::uint32_t cap, std::size_t packed_size);
  /// Replaces the content of `records`. On failure it is empty.
  template <class T> ISO_INLINE bool read_array(std::vector<T>& records, std::uint32_t cap) {
    records.clear();
    records.resize(read_count(cap, kPackedSize<T>));
    if (!records.empty() && !read_records(records.data(), records.size())) records.clear();
    return ok_;
  }
  /// Returns a view into the input.
  Bytes read_bytes(std::uint32_t cap);
  std::string_view read_text(std::uint32_t cap);
  /// Returns a view of `size` bytes, with no count before them.
  Bytes read_view(std::size_t size);

  /// Fails by a rule of the caller: an index past the end, a number that is not finite. `reason` is a literal.
  void fail(ErrorCode code, const char* reason);
  /// Fails if bytes are left over.
  void expect_end();
  /// Returns the result of reading `what`.
  Result<void> result(std::string_view what) const;

 private:
  /// Returns the next `size` bytes, or null.
  const std::uint8_t* take(std::size_t size);
  bool read_raw(void* to, std::size_t n, std::size_t size);
  std::uint8_t refuse_bool();
  /// Reads a number up to `most`. Else it fails and returns 0.
  std::uint64_t read_leb128(std::uint64_t most);

  Bytes bytes_;
  std::size_t offset_;
  ErrorCode code_;
  bool ok_;
  const char* reason_;
  const char* field_;
};

template <class T> ISO_INLINE void detail::ShortReadVisitor::operator()(const char* name, T& value) const {
  reader->read_short_field(name, value);
}

}  // namespace isostep
