// The parts of Writer and Reader that need no template.
// SPDX-License-Identifier: MIT
#include "isostep/state/archive.hpp"

#include <cstring>

namespace isostep {

void Writer::write_count(std::size_t count) {
  if (count > 0xffffffffu) ISO_TRAP();
  write(static_cast<std::uint32_t>(count));
}

void Writer::write_raw(Bytes bytes) { out_->insert(out_->end(), bytes.begin(), bytes.end()); }

std::size_t Writer::size() const { return out_->size(); }

std::uint8_t* Writer::grow(std::size_t more) {
  const std::size_t before = out_->size();
  out_->resize(before + more);
  return out_->data() + before;
}

const std::uint8_t* Reader::take(std::size_t size) {
  if (!ok_) return nullptr;
  if (bytes_.size() - offset_ < size) {
    fail(ErrorCode::truncated, "the data end here");
    return nullptr;
  }
  const std::uint8_t* at = bytes_.data() + offset_;
  offset_ += size;
  return at;
}

bool Reader::read_raw(void* to, std::size_t n, std::size_t size) {
  if (ok_ && n > (bytes_.size() - offset_) / size) fail(ErrorCode::truncated, "the data end before the last record");
  if (!ok_) {
    if (n > 0) std::memset(to, 0, n * size);
    return false;
  }
  if (n > 0) std::memcpy(to, take(n * size), n * size);
  return true;
}

std::uint32_t Reader::read_count(std::uint32_t cap, std::size_t packed_size) {
  const auto count = read<std::uint32_t>();
  if (!ok_) return 0;
  if (count > cap) {
    fail(ErrorCode::limit, "a count above its cap");
  } else if (packed_size != 0 && count > (bytes_.size() - offset_) / packed_size) {
    fail(ErrorCode::truncated, "a count of more than is there");
  }
  return ok_ ? count : 0;
}

Bytes Reader::read_view(std::size_t size) {
  const std::uint8_t* at = take(size);
  return at == nullptr ? Bytes() : Bytes(at, size);
}

Bytes Reader::read_bytes(std::uint32_t cap) { return read_view(read_count(cap, 1)); }

std::string_view Reader::read_text(std::uint32_t cap) {
  const Bytes bytes = read_bytes(cap);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void Reader::fail(ErrorCode code, const char* reason) {
  if (!ok_) return;
  ok_ = false;
  code_ = code;
  reason_ = reason;
}

std::uint8_t Reader::refuse_bool() {
  --offset_;
  fail(ErrorCode::invalid, "a bool is 0 or 1");
  return 0;
}

void Reader::expect_end() {
  if (ok_ && offset_ != bytes_.size()) fail(ErrorCode::corrupt, "bytes are left over");
}

std::uint64_t Reader::read_leb128(std::uint64_t most) {
  if (!ok_) return 0;
  const Leb128 number = load_leb128(bytes_.subspan(offset_), most);
  switch (number.flaw) {
    case Leb128Flaw::none: break;
    case Leb128Flaw::cut: fail(ErrorCode::truncated, "the data end here"); break;
    case Leb128Flaw::overlong: fail(ErrorCode::corrupt, "a number in more bytes than it needs"); break;
    case Leb128Flaw::too_large: fail(ErrorCode::corrupt, "a number above its type's largest"); break;
  }
  offset_ += number.size;
  return number.value;
}

Result<void> Reader::result(std::string_view what) const {
  if (ok_) return {};
  Error error{code_, {}, what};
  error.message.append(reason_);
  error.place.append(" byte ").append_number(offset_);
  if (field_ != nullptr) error.place.append(", at or after field ").append(field_);
  return error;
}

}  // namespace isostep
