// The parts of a game in C, in the order world, block, callbacks.
// SPDX-License-Identifier: MIT
#include "session_game.hpp"

#include <cstring>

#include "isostep/state/hash.hpp"

namespace isostep::c {

SessionGame::SessionGame(const iso_game& game, const iso_session_config& config)
    : game_(game), world_(game.world != nullptr ? session_world_of(game.world) : nullptr), config_(config) {
  if (world_ != nullptr) before_ = world_->make_slot();
}

void SessionGame::save(Snapshot& to) {
  if (world_ != nullptr) {
    if (to.world == nullptr) to.world = world_->make_slot();
    world_->save(*to.world);
  }
  const auto* const block = static_cast<const std::uint8_t*>(game_.block);
  if (block != nullptr) to.block.assign(block, block + game_.block_size);
  if (game_.save != nullptr) {
    if (to.slot == kNoSlot) to.slot = slots_++;
    game_.save(game_.user, to.slot);
  }
}

bool SessionGame::load(const Snapshot& from) {
  if (world_ != nullptr && !world_->load(*from.world)) return false;
  if (!from.block.empty()) std::memcpy(game_.block, from.block.data(), from.block.size());
  if (game_.load != nullptr) game_.load(game_.user, from.slot);
  return true;
}

std::uint64_t SessionGame::hash() const {
  std::uint64_t parts[3];
  std::size_t count = 0;
  if (world_ != nullptr) parts[count++] = world_->hash();
  if (game_.block != nullptr) parts[count++] = hash_bytes(game_.block, game_.block_size);
  if (game_.hash != nullptr) parts[count++] = game_.hash(game_.user);
  if (count == 1) return parts[0];
  HashCombiner combiner;  // as Composite does, so that C and C++ may play one match
  for (std::size_t i = 0; i < count; ++i) combiner.add(parts[i]);
  return combiner.value();
}

void SessionGame::write_portable(Writer& writer) const {
  if (!has_portable()) return;
  if (world_ != nullptr) world_->write_portable(writer);
  if (game_.block != nullptr) writer.write_raw({static_cast<const std::uint8_t*>(game_.block), game_.block_size});
  if (game_.write == nullptr) return;
  std::vector<std::uint8_t> own(game_.write(game_.user, nullptr, 0));
  // A game that changes its mind about the size writes nothing: the receiver's hash shows that.
  if (game_.write(game_.user, own.data(), own.size()) == own.size()) writer.write_raw(own);
}

Result<void> SessionGame::read_portable(Reader& reader) {
  if (world_ == nullptr) return read_own(reader) ? Result<void>() : reader.result("game");
  world_->save(*before_);
  if (Result<void> read = world_->read_portable(reader); !read) return read;
  if (read_own(reader)) return {};
  world_->load(*before_);
  return reader.result("game");
}

/// Reads the block and the state that callbacks keep: both or none. Returns false when the reader says why.
bool SessionGame::read_own(Reader& reader) {
  const Bytes block = reader.read_view(game_.block != nullptr ? game_.block_size : 0);
  if (!reader.ok()) return false;
  if (game_.read == nullptr) {
    reader.expect_end();
  } else {
    const Bytes own = reader.read_view(reader.remaining());
    if (game_.read(game_.user, own.data(), own.size()) != 0) {
      reader.fail(ErrorCode::invalid, "the game refuses its own state");
    }
  }
  if (!reader.ok()) return false;
  if (!block.empty()) std::memcpy(game_.block, block.data(), block.size());
  return true;
}

// ---- inputs

InputRules SessionGame::rules() const {
  InputRules rules{};
  rules.cap = config_.input_cap;
  rules.schema = config_.input_schema;
  if (rules.schema == 0) {
    HashStream stream;
    stream.update(config_.input_text, std::strlen(config_.input_text) + 1);
    for (const std::uint32_t size : {config_.input_least, config_.input_cap, config_.neutral_size}) {
      std::uint8_t bytes[4];
      store_le(bytes, size);
      stream.update(bytes, sizeof bytes);
    }
    stream.update(config_.neutral, config_.neutral_size);
    rules.schema = stream.value();
  }
  rules.is_valid = is_valid;
  rules.guess = guess;
  rules.neutral_size = config_.neutral_size;
  std::memcpy(rules.neutral, config_.neutral, config_.neutral_size);
  rules.user = this;
  return rules;
}

bool SessionGame::is_valid(const InputRules& rules, Bytes input) {
  const auto& self = *static_cast<const SessionGame*>(rules.user);
  if (input.size() < self.config_.input_least || input.size() > rules.cap) return false;
  return self.game_.valid == nullptr || self.game_.valid(self.game_.user, input.data(), input.size()) != 0;
}

std::size_t SessionGame::guess(const InputRules& rules, Bytes last, Frame ahead, std::uint8_t* to) {
  const auto& self = *static_cast<const SessionGame*>(rules.user);
  if (self.game_.predict != nullptr) {
    const std::size_t size = self.game_.predict(self.game_.user, last.data(), last.size(), ahead, to);
    if (size >= self.config_.input_least && size <= rules.cap) return size;
    last = {rules.neutral, rules.neutral_size};
  } else if (self.config_.predictor == ISO_PREDICT_NEUTRAL) {
    last = {rules.neutral, rules.neutral_size};
  }
  if (!last.empty()) std::memcpy(to, last.data(), last.size());
  return last.size();
}

}  // namespace isostep::c
