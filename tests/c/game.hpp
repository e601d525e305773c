// A small world made through the C interface, for tests that ask and attack it: a ground, a crate, a joint.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "isostep.h"

namespace isostep::test {

/// Destroys what it holds; a test takes it by `release` to do so itself.
struct Q32Game {
  iso_world* world = nullptr;
  iso_shape box = 0;
  iso_body ground = 0, crate = 0, lid = 0;
  iso_joint joint = 0;

  explicit Q32Game(std::uint32_t id_space = 0) {
    iso_q32_settings settings;
    iso_q32_settings_init(&settings);
    settings.id_space = id_space;
    EXPECT_EQ(iso_q32_world_create(&settings, &world), ISO_OK) << iso_last_error();
    iso_q32_box shape;
    iso_q32_box_init(&shape);
    shape.half_extents = {half(), half(), half()};
    EXPECT_EQ(iso_q32_add_box(world, &shape, &box), ISO_OK) << iso_last_error();
    ground = create(0, ISO_BODY_TYPE_STATIC);
    crate = create(2, ISO_BODY_TYPE_DYNAMIC);
    lid = create(4, ISO_BODY_TYPE_DYNAMIC);
    iso_q32_hinge hinge;
    iso_q32_hinge_init(&hinge);
    hinge.a = crate;
    hinge.b = lid;
    hinge.frame.position.y = whole(3);
    hinge.has_limit = 1;
    hinge.limit = {-lean(), lean()};
    EXPECT_EQ(iso_q32_create_hinge(world, &hinge, &joint), ISO_OK) << iso_last_error();
  }
  ~Q32Game() { iso_world_destroy(world); }
  Q32Game(const Q32Game&) = delete;
  Q32Game& operator=(const Q32Game&) = delete;

  iso_body create(int y, iso_body_type type) {
    iso_q32_body_definition definition;
    iso_q32_body_definition_init(&definition);
    definition.type = type;
    definition.shape = box;
    definition.position.y = whole(y);
    definition.report_contacts = 1;
    iso_body made = 0;
    EXPECT_EQ(iso_q32_body_create(world, &definition, &made), ISO_OK) << iso_last_error();
    return made;
  }
  void step(int frames) {
    for (int i = 0; i < frames; ++i) EXPECT_EQ(iso_world_step(world, nullptr), ISO_OK) << iso_last_error();
  }
  static std::int64_t lean() { return iso_q32_from_double(0.0625); }  // [rad] the tower does not tip over
  static std::int64_t half() { return iso_q32_from_double(0.5); }
  static std::int64_t whole(int n) { return iso_q32_from_double(n); }
};

/// The bytes that a call of the form (bytes, &size) writes.
template <class Write> std::vector<std::uint8_t> bytes_of(const Write& write) {
  std::size_t size = 0;
  EXPECT_EQ(write(nullptr, &size), ISO_SMALL_BUFFER);
  std::vector<std::uint8_t> bytes(size);
  EXPECT_EQ(write(bytes.data(), &size), ISO_OK) << iso_last_error();
  EXPECT_EQ(size, bytes.size());
  return bytes;
}

/// A recording of so many frames of a game.
inline std::vector<std::uint8_t> recording_of(Q32Game& game, int frames) {
  iso_tape* tape = nullptr;
  EXPECT_EQ(iso_tape_create(&tape), ISO_OK);
  EXPECT_EQ(iso_world_record(game.world, tape, "two crates"), ISO_OK) << iso_last_error();
  for (int i = 0; i < frames; ++i) {
    const iso_q32_vec3 push = {iso_q32_from_double(i % 7), 0, 0};
    EXPECT_EQ(iso_q32_body_apply_force(game.world, game.crate, &push, nullptr), ISO_OK);
    game.step(1);
    EXPECT_EQ(iso_tape_end_frame(tape), ISO_OK) << iso_last_error();
  }
  EXPECT_EQ(iso_tape_finish(tape), ISO_OK) << iso_last_error();
  const void* bytes = nullptr;
  std::size_t size = 0;
  EXPECT_EQ(iso_tape_bytes(tape, &bytes, &size), ISO_OK);
  const auto* const first = static_cast<const std::uint8_t*>(bytes);
  const std::vector<std::uint8_t> file(first, first + size);
  EXPECT_EQ(iso_tape_destroy(tape), ISO_OK);
  return file;
}

}  // namespace isostep::test
