// Files by the C library, whose errors have names.
// SPDX-License-Identifier: MIT
#include "files.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "tool.hpp"

namespace isostep::tool {
namespace {

[[noreturn]] void fail(int status, const std::string& path) {
  throw ToolError(status, path + ": " + std::generic_category().message(errno));
}

/// Errors name `path`, for which `aside` stands until it is whole.
void write_aside(const std::string& aside, const std::string& path, const void* bytes, std::size_t size) {
  std::FILE* file = std::fopen(aside.c_str(), "wb");
  if (file == nullptr) fail(exit_status::kOutput, path);
  const bool written = std::fwrite(bytes, 1, size, file) == size;
  const int error = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written) errno = error;
  if (!written || !closed) fail(exit_status::kOutput, path);
}

/// The path at which a file for `path` grows: beside it, or itself where it is a device or a pipe.
std::string aside_of(const std::string& path) {
  std::error_code error;
  const bool special = std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error);
  return special ? path : path + ".part";
}
void move_into_place(const std::string& aside, const std::string& path) {
  if (aside == path) return;
  std::error_code error;
  std::filesystem::rename(aside, path, error);
  if (!error) return;
  const std::string message = path + ": " + error.message();
  std::filesystem::remove(aside, error);
  throw ToolError(exit_status::kOutput, message);
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
  const std::string aside = aside_of(path);
  write_aside(aside, path, content.data(), content.size());
  move_into_place(aside, path);
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

ReplayFile::ReplayFile(const std::string& path)
    : path_(path), aside_(aside_of(path)), file_(std::fopen(aside_.c_str(), "wb")) {
  if (file_ == nullptr) fail(exit_status::kOutput, path);
}
ReplayFile::~ReplayFile() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  std::error_code error;
  if (aside_ != path_) std::filesystem::remove(aside_, error);
}
ReplaySink ReplayFile::sink() {
  const auto write = [](void* self, const std::uint8_t* bytes, std::size_t size) {
    ReplayFile& to = *static_cast<ReplayFile*>(self);
    if (std::fwrite(bytes, 1, size, to.file_) == size) return true;
    if (to.error_ == 0) to.error_ = errno;
    return false;
  };
  const auto flush = [](void* self) {
    ReplayFile& to = *static_cast<ReplayFile*>(self);
    if (std::fflush(to.file_) == 0) return true;
    if (to.error_ == 0) to.error_ = errno;
    return false;
  };
  return {write, this, flush};
}
void ReplayFile::check(const Result<void>& result) const {
  if (result) return;
  const std::string reason =
      error_ != 0 ? std::generic_category().message(error_) : std::string(result.error().message.view());
  throw ToolError(exit_status::kOutput, path_ + ": " + reason);
}
void ReplayFile::close() {
  if (std::fflush(file_) != 0) fail(exit_status::kOutput, path_);
  std::FILE* const file = std::exchange(file_, nullptr);
  if (std::fclose(file) != 0) fail(exit_status::kOutput, path_);
  move_into_place(aside_, path_);
}

void expect_written(const Result<void>& result) {
  if (!result)
    throw ToolError(exit_status::kOutput, "the recording stopped: " + std::string(result.error().message.view()));
}

}  // namespace isostep::tool
