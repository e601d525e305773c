// The writer of replays: the specification is replays/README.md.
// SPDX-License-Identifier: MIT
#include <cstring>

#include "isostep/core/crc32c.hpp"
#include "isostep/state/archive.hpp"
#include "isostep/state/replay_format.hpp"

namespace isostep {
namespace {

constexpr std::size_t kBlockStart = 8 + 4;  // first frame and count

bool append(void* context, const std::uint8_t* bytes, std::size_t size) {
  auto& out = *static_cast<std::vector<std::uint8_t>*>(context);
  out.insert(out.end(), bytes, bytes + size);
  return true;
}

}  // namespace

std::uint32_t replay_payload_cap(std::uint32_t type) {
  switch (type) {
    case replay_chunk::kHead: return kReplayHeadCap;
    case replay_chunk::kInit: return kReplayStateCap + 8;
    case replay_chunk::kInput: return kReplayInputCap;
    case replay_chunk::kHash: return kBlockStart + 8 * kReplayBlockFrames;
    case replay_chunk::kKeyframe: return kReplayStateCap + 16;
    case replay_chunk::kDone: return 16;
    default: return kReplayUnknownCap;
  }
}

ReplaySink sink_to(std::vector<std::uint8_t>& out) { return {append, &out}; }

ReplayWriter::ReplayWriter(ReplaySink sink, std::uint32_t block_frames)
    : sink_(sink), phase_(Phase::fresh), error_{}, frame_count_(0), block_cap_(block_frames), block_frames_(0) {}
ReplayWriter::~ReplayWriter() = default;

std::uint64_t ReplayWriter::frame_count() const { return frame_count_; }

Result<void> ReplayWriter::refuse(ErrorCode code, const char* message) {
  phase_ = Phase::failed;
  error_ = {code, message, "replay writer, frame "};
  error_.place.append_number(frame_count_);
  return error_;
}

Result<void> ReplayWriter::require_open() {
  if (phase_ == Phase::failed) return error_;
  if (phase_ != Phase::open) return refuse(ErrorCode::invalid, "not between begin and finish");
  return {};
}

Result<void> ReplayWriter::put(Bytes bytes) {
  if (phase_ == Phase::failed) return error_;
  if (bytes.empty()) return {};
  digest_.update(bytes.data(), bytes.size());
  if (!sink_.write(sink_.context, bytes.data(), bytes.size())) return refuse(ErrorCode::sink, "the sink refused");
  return {};
}

Result<void> ReplayWriter::put_chunk(std::uint32_t type, Bytes payload) {
  if (payload.size() > replay_payload_cap(type)) return refuse(ErrorCode::limit, "a chunk above its cap");
  const auto length = static_cast<std::uint32_t>(payload.size());
  std::uint8_t head[12];
  store_le(head, type);
  store_le(head + 4, length);
  store_le(head + 8, length);
  std::uint8_t tail[4];
  store_le(tail, crc32c(payload, crc32c(head)));
  if (Result<void> result = put(head); !result) return result;
  if (Result<void> result = put(payload); !result) return result;
  return put(tail);
}

Result<void> ReplayWriter::flush_sink() {
  if (sink_.flush == nullptr || sink_.flush(sink_.context)) return {};
  return refuse(ErrorCode::sink, "the sink refused to flush");
}

Result<void> ReplayWriter::begin(const ReplayHeader& header, Bytes state, std::uint64_t hash) {
  if (phase_ == Phase::failed) return error_;
  if (phase_ != Phase::fresh) return refuse(ErrorCode::invalid, "begin comes once");
  if (state.size() > kReplayStateCap) return refuse(ErrorCode::limit, "the initial state is above its cap");
  if (block_cap_ > kReplayBlockFrames) return refuse(ErrorCode::limit, "a block has at most 60 frames");
  if (block_cap_ == 0) {
    const Result<std::uint64_t> hz = header.number("hz");
    block_cap_ = hz ? second_of_frames(hz.value()) : kReplayBlockFrames;
  }
  phase_ = Phase::open;

  std::uint8_t preamble[kReplayPreambleSize] = {};
  std::memcpy(preamble, kReplayMagic, sizeof kReplayMagic);
  store_le(preamble + 8, kReplayMajor);
  store_le(preamble + 10, kReplayMinor);
  store_le(preamble + 12, static_cast<std::uint32_t>(kReplayPreambleSize));
  store_le(preamble + 28, crc32c({preamble, 28}));
  if (Result<void> result = put(preamble); !result) return result;

  scratch_.clear();
  write_replay_header(header, scratch_);
  if (Result<void> result = put_chunk(replay_chunk::kHead, scratch_); !result) return result;

  scratch_.clear();
  Writer writer(scratch_);
  writer.write(hash);
  writer.write_raw(state);
  if (Result<void> result = put_chunk(replay_chunk::kInit, scratch_); !result) return result;
  return flush_sink();
}

Result<void> ReplayWriter::frame(Bytes input, std::uint64_t hash) {
  if (Result<void> result = require_open(); !result) return result;
  if (input.size() > kReplayFrameInputCap) return refuse(ErrorCode::limit, "one frame's input is above its cap");
  if (kBlockStart + block_inputs_.size() + 4 + input.size() > kReplayInputCap) {
    if (Result<void> result = flush(); !result) return result;
  }
  Writer(block_inputs_).write_bytes(input);
  Writer(block_hashes_).write(hash);
  ++block_frames_;
  ++frame_count_;
  if (block_frames_ == block_cap_) return flush();
  return {};
}

Result<void> ReplayWriter::flush() {
  if (Result<void> result = require_open(); !result) return result;
  if (block_frames_ == 0) return flush_sink();
  const struct {
    std::uint32_t type;
    std::vector<std::uint8_t>* body;
  } chunks[] = {{replay_chunk::kInput, &block_inputs_}, {replay_chunk::kHash, &block_hashes_}};
  for (const auto& chunk : chunks) {
    scratch_.clear();
    Writer writer(scratch_);
    writer.write(frame_count_ - block_frames_);
    writer.write(block_frames_);
    writer.write_raw(*chunk.body);
    chunk.body->clear();
    if (Result<void> result = put_chunk(chunk.type, scratch_); !result) return result;
  }
  block_frames_ = 0;
  return flush_sink();
}

Result<void> ReplayWriter::keyframe(Bytes state, std::uint64_t hash) {
  if (Result<void> result = flush(); !result) return result;
  if (state.size() > kReplayStateCap) return refuse(ErrorCode::limit, "the keyframe is above its cap");
  scratch_.clear();
  Writer writer(scratch_);
  writer.write(frame_count_);
  writer.write(hash);
  writer.write_raw(state);
  return put_chunk(replay_chunk::kKeyframe, scratch_);
}

Result<void> ReplayWriter::ancillary(std::uint32_t type, Bytes payload) {
  if (Result<void> result = flush(); !result) return result;
  for (int shift = 0; shift < 32; shift += 8) {
    const std::uint32_t letter = (type >> shift & 0xffu) | replay_chunk::kAncillaryBit;
    if (letter < 'a' || letter > 'z') return refuse(ErrorCode::invalid, "a chunk type is four letters");
  }
  if ((type & replay_chunk::kAncillaryBit) == 0) {
    return refuse(ErrorCode::invalid, "an ancillary type starts with a lower-case letter");
  }
  return put_chunk(type, payload);
}

Result<void> ReplayWriter::finish() {
  if (Result<void> result = flush(); !result) return result;
  std::uint8_t payload[16];
  store_le(payload, frame_count_);
  store_le(payload + 8, digest_.value());
  if (Result<void> result = put_chunk(replay_chunk::kDone, payload); !result) return result;
  if (Result<void> result = flush_sink(); !result) return result;
  phase_ = Phase::done;
  return {};
}

}  // namespace isostep
