// Datagrams changed on their way and still well-formed: another header, or other inputs.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/session/protocol/packet.hpp"
#include "isostep/session/timeline/input_codec.hpp"

namespace isostep::test {

struct NothingAltered {
  void operator()(PacketHeader&) const {}
  void operator()(int, Frame, std::vector<std::uint8_t>&) const {}
};

/// `header(PacketHeader&)` and `input(player, frame, bytes)` may change what they are given. What is no datagram of a
/// session is left alone.
template <class HeaderChange, class InputChange>
void alter_packet(std::vector<std::uint8_t>& bytes, const HeaderChange& header, const InputChange& input) {
  const std::vector<std::uint8_t> original = bytes;
  const Result<Packet> read = read_packet(original);
  if (!read) return;
  Packet packet = read.value();
  header(packet.header);
  std::uint8_t buffer[kDatagramCap];
  PacketWriter writer(packet.header, buffer);
  for (std::uint8_t i = 0; i < packet.slice_count; ++i) {
    const InputSlice& slice = packet.slices[i];
    InputStream stream(kSliceFrames, kInputCap);
    stream.reset(slice.first);
    SliceReader reader(slice);
    InputEntry entry;
    for (Frame frame = slice.first; reader.next(entry); ++frame) {
      std::vector<std::uint8_t> changed(entry.bytes.begin(), entry.bytes.end());
      if (!entry.absent) input(slice.player, frame, changed);
      stream.append({entry.absent, changed});
    }
    writer.add_slice(slice.player, stream, slice.first);
  }
  bytes.assign(writer.bytes().begin(), writer.bytes().end());
}

/// Everything else that the datagram says stays.
inline void drop_inputs_of(int player, std::vector<std::uint8_t>& bytes) {
  const std::vector<std::uint8_t> original = bytes;
  const Result<Packet> read = read_packet(original);
  if (!read || read.value().slice_count != 1 || read.value().slices[0].player != player) return;
  std::uint8_t buffer[kDatagramCap];
  const PacketWriter writer(read.value().header, buffer);
  bytes.assign(writer.bytes().begin(), writer.bytes().end());
}

}  // namespace isostep::test
