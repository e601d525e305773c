// The reader of replays: the specification is replays/README.md.
// SPDX-License-Identifier: MIT
//
// Nothing in the file is believed before it is checked, in this order: is it there, is it undamaged, is it known, does
// it make sense.
#include <cstring>

#include "isostep/core/crc32c.hpp"
#include "isostep/state/archive.hpp"
#include "isostep/state/replay_format.hpp"

namespace isostep {
namespace {

constexpr std::size_t kChunkHead = 12;  // type, length, raw length
constexpr std::size_t kChunkTail = 4;   // checksum
// A power failure leaves of a file that grew its length, and zeros where bytes were not written yet. Systems write
// whole pages, in any order.
constexpr std::size_t kPage = 4096;  // [bytes]
// [bytes] A shorter run of zeros before the end of a page may be an input's.
constexpr std::size_t kLeastHole = 64;

bool is_type(std::uint32_t type) {
  for (int shift = 0; shift < 32; shift += 8) {
    const std::uint32_t letter = (type >> shift & 0xffu) | 0x20u;
    if (letter < 'a' || letter > 'z') return false;
  }
  return true;
}

/// The place where the zeros begin in which the bytes end.
std::size_t end_of_data(Bytes bytes) {
  std::size_t end = bytes.size();
  while (end > 0 && bytes[end - 1] == 0) --end;
  return end;
}

/// The damaged bytes, `size` of them, are zeros from some place to their end. A checksum is torn only where its bytes
/// before that place are right.
bool ends_in_zeros(Bytes file, std::size_t offset, std::size_t size) {
  const std::size_t end = end_of_data(file);
  if (end >= offset + size) return false;
  if (size <= kChunkHead || end <= offset + size - kChunkTail) return true;
  const std::size_t covered = size - kChunkTail;
  std::uint8_t checksum[kChunkTail];
  store_le(checksum, crc32c(file.subspan(offset, covered)));
  return std::memcmp(checksum, file.data() + offset + covered, end - offset - covered) == 0;
}

/// Zeros that begin in the `size` damaged bytes reach the end of a page, and what follows was written.
bool has_hole(Bytes file, std::size_t offset, std::size_t size) {
  const std::size_t end = offset + size;
  for (std::size_t page = (offset / kPage + 1) * kPage; page <= file.size() && page - kPage < end; page += kPage) {
    const std::size_t least = page - kPage > offset ? page - kPage : offset;
    const std::size_t begin = least + end_of_data(file.subspan(least, page - least));
    if (begin < end && (page - begin >= kLeastHole || (begin == offset && begin < page))) return true;
  }
  return false;
}

}  // namespace

bool has_replay_magic(Bytes file) {
  return file.size() >= sizeof kReplayMagic && std::memcmp(file.data(), kReplayMagic, sizeof kReplayMagic) == 0;
}

ReplayReader::ReplayReader(Bytes file)
    : file_(file),
      status_(ReplayStatus::complete),
      place_(0),
      error_{},
      expect_(Expect::head),
      has_header_(false),
      has_state_(false),
      state_hash_(0),
      frame_count_(0),
      open_block_{} {
  if (!read_preamble()) return;
  std::size_t offset = kReplayPreambleSize;
  while (expect_ != Expect::end) {
    Chunk chunk{};
    if (!read_chunk(offset, chunk) || !accept(chunk)) return;
    offset = chunk.offset + kChunkHead + chunk.payload.size() + kChunkTail;
  }
  if (offset == file_.size()) return;
  const bool is_zeros = end_of_data(file_) <= offset;
  stop(is_zeros ? ReplayStatus::truncated : ReplayStatus::corrupt, offset,
       is_zeros ? "zeros after the last chunk" : "bytes after the last chunk");
}
ReplayReader::~ReplayReader() = default;

bool ReplayReader::stop(ReplayStatus status, std::size_t place, const char* message) {
  const ErrorCode code = status == ReplayStatus::truncated      ? ErrorCode::truncated
                         : status == ReplayStatus::incompatible ? ErrorCode::incompatible
                                                                : ErrorCode::corrupt;
  status_ = status;
  place_ = place;
  error_ = {code, message, "byte "};
  error_.place.append_number(place);
  return false;
}

/// `size` bytes at `offset` are not what a chunk is: one that was not written whole, or damage.
bool ReplayReader::stop_at_damage(std::size_t offset, std::size_t size, std::size_t place, const char* message) {
  if (!ends_in_zeros(file_, offset, size) && !has_hole(file_, offset, size)) {
    return stop(ReplayStatus::corrupt, place, message);
  }
  return stop(ReplayStatus::truncated, offset, "zeros stand where a chunk was to be written");
}

bool ReplayReader::read_preamble() {
  const std::size_t written = end_of_data(file_);
  const std::size_t have = written < sizeof kReplayMagic ? written : sizeof kReplayMagic;
  if (have > 0 && std::memcmp(file_.data(), kReplayMagic, have) != 0) {
    return stop(ReplayStatus::corrupt, 0, "not a replay: the first eight bytes are others");
  }
  if (file_.size() < kReplayPreambleSize) return stop(ReplayStatus::truncated, 0, "the file ends in its preamble");
  if (load_le<std::uint32_t>(file_.data() + 28) != crc32c(file_.first(28))) {
    if (written < kReplayPreambleSize) return stop(ReplayStatus::truncated, 0, "zeros stand in the preamble");
    return stop(ReplayStatus::corrupt, 0, "the preamble's checksum does not match");
  }
  if (load_le<std::uint16_t>(file_.data() + 8) != kReplayMajor) {
    return stop(ReplayStatus::incompatible, 8, "format major version");
  }
  // A later minor version adds chunks, whose types say whether they may be skipped; it is not refused for its number.
  if (load_le<std::uint32_t>(file_.data() + 12) != kReplayPreambleSize) {
    return stop(ReplayStatus::incompatible, 12, "format preamble length");
  }
  for (std::size_t i = 16; i < 28; ++i) {
    if (file_[i] != 0) return stop(ReplayStatus::incompatible, i, "format flags");
  }
  return true;
}

bool ReplayReader::read_chunk(std::size_t offset, Chunk& chunk) {
  const std::size_t left = file_.size() - offset;
  if (left < kChunkHead) return stop(ReplayStatus::truncated, offset, "the file ends before its DONE chunk");
  const std::uint8_t* head = file_.data() + offset;
  const auto type = load_le<std::uint32_t>(head);
  const auto length = load_le<std::uint32_t>(head + 4);
  if (!is_type(type)) return stop_at_damage(offset, kChunkHead, offset, "a chunk type is four letters");
  // Payloads are stored as they are; two equal lengths also tell a damaged length from a file that ends early.
  if (load_le<std::uint32_t>(head + 8) != length) {
    return stop_at_damage(offset, kChunkHead, offset + 4, "the lengths differ");
  }
  if (length > replay_payload_cap(type)) return stop(ReplayStatus::corrupt, offset + 4, "a chunk above its cap");
  if (left - kChunkHead < std::size_t{length} + kChunkTail) {
    return stop(ReplayStatus::truncated, offset, "the file ends inside a chunk");
  }
  const std::size_t covered = kChunkHead + length;
  if (load_le<std::uint32_t>(head + covered) != crc32c({head, covered})) {
    return stop_at_damage(offset, covered + kChunkTail, offset, "a chunk's checksum does not match");
  }
  chunk = {type, offset, {head + kChunkHead, length}};
  return true;
}

bool ReplayReader::accept(const Chunk& chunk) {
  switch (chunk.type) {
    case replay_chunk::kHead: return accept_head(chunk);
    case replay_chunk::kInit: return accept_init(chunk);
    case replay_chunk::kInput: return accept_inputs(chunk);
    case replay_chunk::kHash: return accept_hashes(chunk);
    case replay_chunk::kKeyframe: return accept_keyframe(chunk);
    case replay_chunk::kDone: return accept_done(chunk);
    default: break;
  }
  if ((chunk.type & replay_chunk::kAncillaryBit) != 0) {
    ancillaries_.push_back({chunk.type, chunk.payload});
    return true;
  }
  return stop(ReplayStatus::incompatible, chunk.offset, "format chunk type that this reader must know and does not");
}

bool ReplayReader::accept_head(const Chunk& chunk) {
  if (expect_ != Expect::head) return stop(ReplayStatus::corrupt, chunk.offset, "HEAD out of place");
  Result<ReplayHeader> header = read_replay_header(chunk.payload);
  if (!header) {
    stop(ReplayStatus::corrupt, chunk.offset, "");
    error_.message = header.error().message;
    return false;
  }
  header_ = header.value();
  has_header_ = true;
  expect_ = Expect::init;
  return true;
}

bool ReplayReader::accept_init(const Chunk& chunk) {
  if (expect_ != Expect::init) return stop(ReplayStatus::corrupt, chunk.offset, "INIT out of place");
  if (chunk.payload.size() < 8) return stop(ReplayStatus::corrupt, chunk.offset, "INIT without a hash");
  state_hash_ = load_le<std::uint64_t>(chunk.payload.data());
  state_ = chunk.payload.subspan(8);
  has_state_ = true;
  expect_ = Expect::inputs;
  return true;
}

bool ReplayReader::accept_inputs(const Chunk& chunk) {
  if (expect_ != Expect::inputs) return stop(ReplayStatus::corrupt, chunk.offset, "INPT out of place");
  Reader reader(chunk.payload);
  open_block_.first = reader.read<std::uint64_t>();
  open_block_.count = reader.read<std::uint32_t>();
  open_block_.inputs = chunk.payload.data() + reader.offset();
  if (reader.ok() && (open_block_.first != frame_count_ || open_block_.count - 1 >= kReplayBlockFrames)) {
    reader.fail(ErrorCode::corrupt, "frames out of sequence");
  }
  for (std::uint32_t i = 0; i < open_block_.count && reader.ok(); ++i) reader.read_bytes(kReplayFrameInputCap);
  reader.expect_end();
  if (!reader.ok()) return stop(ReplayStatus::corrupt, chunk.offset, "INPT does not hold what it says");
  expect_ = Expect::hashes;
  return true;
}

bool ReplayReader::accept_hashes(const Chunk& chunk) {
  if (expect_ != Expect::hashes) return stop(ReplayStatus::corrupt, chunk.offset, "HASH out of place");
  Reader reader(chunk.payload);
  const auto first = reader.read<std::uint64_t>();
  const auto count = reader.read<std::uint32_t>();
  const Bytes hashes = reader.read_view(std::size_t{8} * open_block_.count);
  reader.expect_end();
  if (!reader.ok() || first != open_block_.first || count != open_block_.count) {
    return stop(ReplayStatus::corrupt, chunk.offset, "HASH does not match the INPT before it");
  }
  open_block_.hashes = hashes.data();
  blocks_.push_back(open_block_);
  frame_count_ += open_block_.count;
  expect_ = Expect::inputs;
  return true;
}

bool ReplayReader::accept_keyframe(const Chunk& chunk) {
  if (expect_ != Expect::inputs) return stop(ReplayStatus::corrupt, chunk.offset, "KEYF out of place");
  if (chunk.payload.size() < 16) return stop(ReplayStatus::corrupt, chunk.offset, "KEYF without a frame and a hash");
  const auto frames = load_le<std::uint64_t>(chunk.payload.data());
  if (frames != frame_count_) return stop(ReplayStatus::corrupt, chunk.offset, "KEYF of another frame than the last");
  if (!keyframes_.empty() && keyframes_.back().frames == frames) {
    return stop(ReplayStatus::corrupt, chunk.offset, "KEYF of a frame that has one");
  }
  keyframes_.push_back(
      {frames, load_le<std::uint64_t>(chunk.payload.data() + 8), chunk.payload.subspan(16), chunk.offset});
  return true;
}

bool ReplayReader::accept_done(const Chunk& chunk) {
  if (expect_ != Expect::inputs) return stop(ReplayStatus::corrupt, chunk.offset, "DONE out of place");
  if (chunk.payload.size() != 16) return stop(ReplayStatus::corrupt, chunk.offset, "DONE is not 16 bytes");
  if (load_le<std::uint64_t>(chunk.payload.data()) != frame_count_) {
    return stop(ReplayStatus::corrupt, chunk.offset, "DONE counts other frames than the file holds");
  }
  if (load_le<std::uint64_t>(chunk.payload.data() + 8) != hash_bytes(file_.data(), chunk.offset)) {
    return stop(ReplayStatus::corrupt, chunk.offset, "DONE has another digest than the file");
  }
  expect_ = Expect::end;
  return true;
}

ReplayStatus ReplayReader::status() const { return status_; }
std::size_t ReplayReader::place() const { return place_; }
const Error& ReplayReader::error() const { return error_; }
bool ReplayReader::has_header() const { return has_header_; }
bool ReplayReader::has_state() const { return has_state_; }
const ReplayHeader& ReplayReader::header() const { return header_; }
Bytes ReplayReader::state() const { return state_; }
std::size_t ReplayReader::state_offset() const { return has_state_ ? offset_of(state_) : 0; }
std::uint64_t ReplayReader::state_hash() const { return state_hash_; }
std::uint64_t ReplayReader::frame_count() const { return frame_count_; }
const std::vector<ReplayKeyframe>& ReplayReader::keyframes() const { return keyframes_; }
const std::vector<ReplayAncillary>& ReplayReader::ancillaries() const { return ancillaries_; }

std::size_t ReplayReader::offset_of(Bytes view) const { return static_cast<std::size_t>(view.data() - file_.data()); }

ReplayFrame ReplayReader::frame(std::uint64_t i) const {
  if (i >= frame_count_) ISO_TRAP();
  std::size_t low = 0;
  std::size_t high = blocks_.size();
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (blocks_[middle].first <= i ? low : high) = middle;
  }
  const Block& block = blocks_[low];
  const std::uint64_t index = i - block.first;
  const std::uint8_t* at = block.inputs;
  for (std::uint64_t skip = 0; skip < index; ++skip) at += 4 + load_le<std::uint32_t>(at);
  return {{at + 4, load_le<std::uint32_t>(at)}, load_le<std::uint64_t>(block.hashes + 8 * index)};
}

}  // namespace isostep
