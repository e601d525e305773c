// The HEAD chunk of a replay.
// SPDX-License-Identifier: MIT
#include "isostep/state/replay_header.hpp"

#include "isostep/state/archive.hpp"

namespace isostep {
namespace {

bool is_printable(std::string_view text) {
  for (const char c : text) {
    if (c < ' ' || c > '~') return false;
  }
  return !text.empty();
}

Error bad_field(std::string_view key, std::string_view what) {
  Error error{ErrorCode::incompatible, what, "HEAD "};
  error.place.append(key);
  return error;
}

ShortText<20> decimal(std::uint64_t number) { return ShortText<20>().append_number(number); }
ShortText<16> hexadecimal(std::uint64_t number) { return ShortText<16>().append_hex(number); }

int digit_of(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return 16;
}

}  // namespace

ReplayHeader::ReplayHeader() : size_(0), fields_{} {}

bool ReplayHeader::set(std::string_view key, std::string_view value, bool required) {
  if (key.size() > kReplayKeyCap || value.size() > kReplayValueCap || !is_printable(key) || !is_printable(value)) {
    return false;
  }
  std::size_t at = 0;
  while (at < size_ && fields_[at].key.view() != key) ++at;
  if (at == kReplayFieldCap) return false;
  fields_[at] = {key, value, required};
  if (at == size_) ++size_;
  return true;
}

const ReplayField* ReplayHeader::find(std::string_view key) const {
  for (std::size_t i = 0; i < size_; ++i) {
    if (fields_[i].key.view() == key) return &fields_[i];
  }
  return nullptr;
}

Result<std::uint64_t> ReplayHeader::number(std::string_view key) const {
  const ReplayField* field = find(key);
  if (field == nullptr) return bad_field(key, "the field is missing");
  const std::string_view text = field->value.view();
  if (text.size() > 19) return bad_field(key, "not a decimal number");
  std::uint64_t number = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return bad_field(key, "not a decimal number");
    number = 10 * number + static_cast<std::uint64_t>(c - '0');
  }
  return number;
}

Result<std::uint64_t> ReplayHeader::digest(std::string_view key) const {
  const ReplayField* field = find(key);
  if (field == nullptr) return bad_field(key, "the field is missing");
  const std::string_view text = field->value.view();
  if (text.size() != 16) return bad_field(key, "not 16 hexadecimal digits");
  std::uint64_t number = 0;
  for (const char c : text) {
    const int digit = digit_of(c);
    if (digit > 15) return bad_field(key, "not 16 hexadecimal digits");
    number = number << 4 | static_cast<std::uint64_t>(digit);
  }
  return number;
}

Result<ReplayHeader> make_replay_header(const ReplayIdentity& identity) {
  const auto behaviour = hexadecimal(identity.behaviour);
  const auto settings = hexadecimal(identity.settings_digest);
  const auto scalar_id = decimal(identity.scalar_id);
  const auto hz = decimal(identity.hz);
  const auto substeps = decimal(identity.substeps);
  const struct {
    std::string_view key, value;
    bool required;
  } rows[] = {
      {"engine", identity.engine, false},
      {"behaviour", behaviour.view(), true},
      {"scalar", identity.scalar, true},
      {"scalar_id", scalar_id.view(), true},
      {"hz", hz.view(), true},
      {"substeps", substeps.view(), true},
      {"solver", identity.solver, true},
      {"settings", settings.view(), true},
      {"hash", identity.hash_algorithm, true},
      {"scene", identity.scene, true},
      {kWorldKey, identity.world, true},
      {"compiler", std::string_view(compiler_name()).substr(0, kReplayValueCap), false},
      {"architecture", architecture_name(), false},
  };
  ReplayHeader header;
  for (const auto& row : rows) {
    if (row.key == kWorldKey && row.value.empty()) continue;
    if (!header.set(row.key, row.value, row.required)) return bad_field(row.key, "empty, too long or not ASCII");
  }
  return header;
}

Result<ReplayIdentity> identity_of(const ReplayHeader& header) {
  ReplayIdentity identity{};
  const struct {
    std::string_view key;
    std::string_view* to;
  } texts[] = {{"engine", &identity.engine},
               {"scalar", &identity.scalar},
               {"solver", &identity.solver},
               {"scene", &identity.scene},
               {"hash", &identity.hash_algorithm}};
  for (const auto& text : texts) {
    const ReplayField* field = header.find(text.key);
    if (field == nullptr) return bad_field(text.key, "the field is missing");
    *text.to = field->value.view();
  }
  if (const ReplayField* world = header.find(kWorldKey)) identity.world = world->value.view();
  const struct {
    std::string_view key;
    std::uint32_t* to;
  } numbers[] = {{"scalar_id", &identity.scalar_id}, {"hz", &identity.hz}, {"substeps", &identity.substeps}};
  for (const auto& number : numbers) {
    const Result<std::uint64_t> value = header.number(number.key);
    if (!value) return value.error();
    if (value.value() > 0xffffffffu) return bad_field(number.key, "above 2^32 - 1");
    *number.to = static_cast<std::uint32_t>(value.value());
  }
  const Result<std::uint64_t> behaviour = header.digest("behaviour");
  if (!behaviour) return behaviour.error();
  const Result<std::uint64_t> settings = header.digest("settings");
  if (!settings) return settings.error();
  identity.behaviour = behaviour.value();
  identity.settings_digest = settings.value();
  return identity;
}

HeaderMismatch compare_headers(const ReplayHeader& file, const ReplayHeader& here) {
  for (std::size_t i = 0; i < here.size(); ++i) {
    if (!here[i].required) continue;
    const ReplayField* other = file.find(here[i].key.view());
    if (other == nullptr) return {here[i].key, {}, here[i].value};
    if (!(other->value == here[i].value)) return {here[i].key, other->value, here[i].value};
  }
  for (std::size_t i = 0; i < file.size(); ++i) {
    if (file[i].required && here.find(file[i].key.view()) == nullptr) return {file[i].key, file[i].value, {}};
  }
  return {};
}

void write_replay_header(const ReplayHeader& header, std::vector<std::uint8_t>& out) {
  Writer writer(out);
  writer.write_count(header.size());
  for (std::size_t i = 0; i < header.size(); ++i) {
    writer.write(header[i].required);
    writer.write_text(header[i].key.view());
    writer.write_text(header[i].value.view());
  }
}

Result<ReplayHeader> read_replay_header(Bytes payload) {
  constexpr std::size_t least_field = 1 + 4 + 4;
  Reader reader(payload);
  ReplayHeader header;
  const std::uint32_t count = reader.read_count(kReplayFieldCap, least_field);
  for (std::uint32_t i = 0; i < count && reader.ok(); ++i) {
    const bool required = reader.read<bool>();
    const std::string_view key = reader.read_text(kReplayKeyCap);
    const std::string_view value = reader.read_text(kReplayValueCap);
    if (!reader.ok()) break;
    if (header.find(key) != nullptr) reader.fail(ErrorCode::corrupt, "a key comes twice");
    if (!header.set(key, value, required)) reader.fail(ErrorCode::corrupt, "an empty or unprintable key or value");
  }
  reader.expect_end();
  if (Result<void> read = reader.result("HEAD"); !read) return read.error();
  return header;
}

}  // namespace isostep
