// Copies a recording with one bit of one frame's hash flipped: flip_hash FROM TO FRAME. Its checksums are right, so
// that nothing but replaying it can tell. Exits 64 on wrong words, 65 on no such frame, 74 where TO cannot be written.
// SPDX-License-Identifier: MIT
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "isostep/state/replay_format.hpp"

namespace {

std::vector<std::uint8_t> read(const char* path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

bool copy_flipped(const isostep::ReplayReader& from, std::uint64_t flipped, std::vector<std::uint8_t>& to) {
  isostep::ReplayWriter writer(isostep::sink_to(to));
  bool ok = bool(writer.begin(from.header(), from.state(), from.state_hash()));
  for (std::uint64_t i = 0; ok && i < from.frame_count(); ++i) {
    const isostep::ReplayFrame frame = from.frame(i);
    ok = bool(writer.frame(frame.input, frame.hash ^ std::uint64_t(i == flipped)));
  }
  return ok && writer.finish();
}

bool is_number(const char* word, std::uint64_t& value) {
  const char* const end = word + std::strlen(word);
  const std::from_chars_result parsed = std::from_chars(word, end, value);
  return parsed.ec == std::errc() && parsed.ptr == end;
}

// The stream is closed before it is asked: what is still buffered has not been written.
bool write(const char* path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  return bool(out);
}

}  // namespace

int main(int count, char** words) {
  std::uint64_t frame = 0;
  if (count != 4 || !is_number(words[3], frame)) {
    std::fprintf(stderr, "usage: flip_hash FROM TO FRAME\n");
    return 64;
  }
  const std::vector<std::uint8_t> file = read(words[1]);
  const isostep::ReplayReader reader({file.data(), file.size()});
  std::vector<std::uint8_t> flipped;
  if (reader.status() != isostep::ReplayStatus::complete || frame >= reader.frame_count() ||
      !copy_flipped(reader, frame, flipped)) {
    std::fprintf(stderr, "%s: no recording with a frame %s\n", words[1], words[3]);
    return 65;
  }
  if (!write(words[2], flipped)) {
    std::fprintf(stderr, "%s: cannot be written\n", words[2]);
    return 74;
  }
  return 0;
}
