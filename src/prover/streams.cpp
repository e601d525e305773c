// Files and standard streams by stdio alone.
// SPDX-License-Identifier: MIT
#include "streams.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#endif

namespace isostep::prover {
namespace {

int digit_of(std::uint8_t c) {
  if (c >= '0' && c <= '9') return c - '0';
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/// [bytes] It is above any recording: what never ends must end.
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 31;

/// Makes room for more bytes. Without exceptions a vector that cannot grow ends the program; so it grows by what can be
/// had.
bool make_room(std::vector<std::uint8_t>& bytes, std::size_t more) {
  if (bytes.capacity() - bytes.size() >= more) return true;
  const std::uint64_t wanted = 2 * static_cast<std::uint64_t>(bytes.capacity()) + more;
  if (wanted > bytes.max_size()) return false;
  void* volatile room = std::malloc(static_cast<std::size_t>(wanted));  // volatile: it is asked for in earnest
  if (room == nullptr) return false;
  std::free(room);
  bytes.reserve(static_cast<std::size_t>(wanted));
  return true;
}

/// Returns an empty text, or why it could not read.
std::string read_all(std::FILE* file, std::vector<std::uint8_t>& bytes) {
  std::uint8_t block[4096];
  for (std::size_t n = 1; n != 0;) {
    n = std::fread(block, 1, sizeof block, file);
    if (bytes.size() + std::uint64_t{n} > kMostBytes) return "more than " + std::to_string(kMostBytes) + " bytes";
    if (!make_room(bytes, n)) return "does not fit in memory";
    bytes.insert(bytes.end(), block, block + n);
  }
  return std::ferror(file) != 0 ? std::strerror(errno) : "";
}

}  // namespace

void make_streams_binary() {
#if defined(_WIN32)
  _setmode(_fileno(stdin), _O_BINARY);
  _setmode(_fileno(stdout), _O_BINARY);
#endif
}

std::string read_file(std::string_view path, std::vector<std::uint8_t>& bytes) {
  const std::string name(path);
  std::FILE* const file = name == "-" ? stdin : std::fopen(name.c_str(), "rb");
  if (file == nullptr) return std::strerror(errno);
  bytes.clear();
  const std::string error = read_all(file, bytes);
  if (file != stdin) std::fclose(file);
  if (!error.empty()) bytes = {};
  return error;
}

void print(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); }

std::string hex_text(Bytes bytes) {
  constexpr std::size_t kBytesPerLine = 32;
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    text += "0123456789abcdef"[bytes[i] >> 4];
    text += "0123456789abcdef"[bytes[i] & 15];
    if (i % kBytesPerLine == kBytesPerLine - 1 || i + 1 == bytes.size()) text += '\n';
  }
  return text;
}

bool read_hex(Bytes text, std::vector<std::uint8_t>& bytes) {
  bytes.clear();
  int high = -1;
  for (const std::uint8_t c : text) {
    if (c == '\n' || c == '\r' || c == ' ') continue;
    const int digit = digit_of(c);
    if (digit < 0) return false;
    if (high < 0) {
      high = digit;
    } else {
      bytes.push_back(static_cast<std::uint8_t>(high << 4 | digit));
      high = -1;
    }
  }
  return high < 0;
}

}  // namespace isostep::prover
