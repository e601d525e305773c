// The header of a replay: what it was made with, field by field, so that a refusal can say which one differs.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "isostep/core/bytes.hpp"
#include "isostep/core/result.hpp"
#include "isostep/core/short_text.hpp"
#include "isostep/core/version.hpp"
#include "isostep/state/hash.hpp"

namespace isostep {

inline constexpr std::size_t kReplayFieldCap = 32;
inline constexpr std::size_t kReplayKeyCap = 32;     // [characters]
inline constexpr std::size_t kReplayValueCap = 128;  // [characters]

/// A `required` field shapes the results: whoever replays the file must have the same value. Others are informative.
struct ReplayField {
  ShortText<kReplayKeyCap> key;
  ShortText<kReplayValueCap> value;
  bool required;
};

/// The HEAD chunk: fields in the order in which they were set, no key twice.
class ReplayHeader {
 public:
  ReplayHeader();

  /// Adds or replaces a field. Returns false and does nothing if the key or value is too long, empty or not printable
  /// ASCII, or if the header is full.
  bool set(std::string_view key, std::string_view value, bool required);
  /// Returns null when there is none.
  const ReplayField* find(std::string_view key) const;
  /// Returns the value of a decimal field, or an error that names the key.
  Result<std::uint64_t> number(std::string_view key) const;
  /// Returns the value of a field of 16 hexadecimal digits.
  Result<std::uint64_t> digest(std::string_view key) const;

  ISO_INLINE std::size_t size() const { return size_; }
  ISO_INLINE const ReplayField& operator[](std::size_t i) const { return fields_[i]; }

 private:
  std::size_t size_;
  ReplayField fields_[kReplayFieldCap];
};

/// The header's key for the kind of world. Files of rigid bodies, the first kind, do not have it.
inline constexpr std::string_view kWorldKey = "world";
/// The header's key for the number that the game or session gives to the file's frame 0, if it is not 0.
inline constexpr std::string_view kFirstFrameKey = "first_frame";

/// The typed fields that every replay of a world has. Texts are views of the caller's strings, or of the header.
struct ReplayIdentity {
  std::uint64_t behaviour;  // digest of the golden hashes: the version of the results
  std::string_view scalar;  // ScalarTraits::kName
  std::uint32_t scalar_id;  // ScalarTraits::kId
  std::uint32_t hz;         // [1/s]
  std::uint32_t substeps;
  std::string_view solver;
  std::uint64_t settings_digest;  // hash of all settings
  std::string_view scene;
  std::string_view world;  // its kind, as "particles"; empty: rigid bodies
  std::string_view hash_algorithm = kHashName;
  std::string_view engine = kVersionText;  // informative: two releases of one behaviour replay each other's files
};

/// Hashes all settings of a kind of world, also those that the header names itself, so that none is forgotten.
template <class Settings> ISO_INLINE std::uint64_t settings_digest(const Settings& settings) {
  return hash_records_by_fields(&settings, 1);
}

/// Makes a header. Compiler and architecture are added as informative fields.
Result<ReplayHeader> make_replay_header(const ReplayIdentity& identity);
Result<ReplayIdentity> identity_of(const ReplayHeader& header);

/// The first required field in which two headers differ. `key` is empty if none does.
struct HeaderMismatch {
  ShortText<kReplayKeyCap> key;
  ShortText<kReplayValueCap> in_file;  // empty: the field is missing there
  ShortText<kReplayValueCap> here;
};
HeaderMismatch compare_headers(const ReplayHeader& file, const ReplayHeader& here);

/// HEAD's payload: see replays/README.md.
void write_replay_header(const ReplayHeader& header, std::vector<std::uint8_t>& out);
Result<ReplayHeader> read_replay_header(Bytes payload);

}  // namespace isostep
