// A host without guests, whose game is a tally.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include "tally_game.hpp"

namespace isostep::test {

struct Alone : testing::Test {
  Tally tally;
  iso_session* session = nullptr;
  iso_session_config config = tally_config(ISO_ROLLBACK);

  Alone() {
    config.host = 1;
    config.seed = 9;
    const iso_game game = tally.describe(false);
    EXPECT_EQ(iso_session_create(&config, &game, nullptr, 0, &session), ISO_OK) << iso_last_error();
    EXPECT_EQ(iso_session_start(session, 0), ISO_OK);
    tally.session = session;
  }
  ~Alone() override { EXPECT_EQ(iso_session_destroy(session), ISO_OK); }
  iso_status create(const iso_session_config& with, const iso_game& game) {
    iso_session* other = reinterpret_cast<iso_session*>(1);
    const iso_status status = iso_session_create(&with, &game, nullptr, 0, &other);
    EXPECT_EQ(other == nullptr, status != ISO_OK);
    EXPECT_EQ(iso_session_destroy(other), ISO_OK);
    return status;
  }
};

}  // namespace isostep::test
