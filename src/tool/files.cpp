// Files by the C library, whose errors have names.
// SPDX-License-Identifier: MIT
#include "files.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "tool.hpp"

namespace isostep::tool {
namespace {

[[noreturn]] void fail(int status, const std::string& path) {
  throw ToolError(status, path + ": " + std::generic_category().message(errno));
}

void write_to(const std::string& path, const void* bytes, std::size_t size) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) fail(exit_status::kOutput, path);
  const bool written = std::fwrite(bytes, 1, size, file) == size;
  const int error = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written) errno = error;
  if (!written || !closed) fail(exit_status::kOutput, path);
}

}  // namespace

std::vector<std::uint8_t> read_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw ToolError(exit_status::kNoInput, path + ": is a directory");
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) fail(exit_status::kNoInput, path);
  std::vector<std::uint8_t> bytes;
  std::uint8_t block[65536];
  for (std::size_t n = 1; n != 0;) {
    n = std::fread(block, 1, sizeof block, file);
    bytes.insert(bytes.end(), block, block + n);
  }
  const bool failed = std::ferror(file) != 0;
  std::fclose(file);
  if (failed) fail(exit_status::kNoInput, path);
  return bytes;
}

void write_file(const std::string& path, std::string_view content) {
  std::error_code error;
  const bool special = std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error);
  const std::string aside = special ? path : path + ".part";
  write_to(aside, content.data(), content.size());
  if (special) return;
  std::filesystem::rename(aside, path, error);
  if (!error) return;
  const std::string message = path + ": " + error.message();
  std::filesystem::remove(aside, error);
  throw ToolError(exit_status::kOutput, message);
}
void write_file(const std::string& path, Bytes content) {
  write_file(path, std::string_view(reinterpret_cast<const char*>(content.data()), content.size()));
}

void expect_writable(const std::string& path) {
  if (path.empty()) return;
  std::error_code error;
  const bool existed = std::filesystem::exists(path, error);
  std::FILE* file = std::fopen(path.c_str(), "ab");
  if (file == nullptr) fail(exit_status::kOutput, path);
  std::fclose(file);
  if (!existed) std::filesystem::remove(path, error);
}

ReplayFile::ReplayFile(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "wb")) {
  if (file_ == nullptr) fail(exit_status::kOutput, path);
}
ReplayFile::~ReplayFile() {
  if (file_ != nullptr) std::fclose(file_);
}
ReplaySink ReplayFile::sink() {
  const auto write = [](void* file, const std::uint8_t* bytes, std::size_t size) {
    return std::fwrite(bytes, 1, size, static_cast<std::FILE*>(file)) == size;
  };
  return {write, file_};
}
void ReplayFile::close() {
  const bool flushed = std::fflush(file_) == 0;
  const bool closed = std::fclose(file_) == 0;
  file_ = nullptr;
  if (!flushed || !closed) fail(exit_status::kOutput, path_);
}

void expect_written(const Result<void>& result) {
  if (!result)
    throw ToolError(exit_status::kOutput, "the recording stopped: " + std::string(result.error().message.view()));
}

}  // namespace isostep::tool
