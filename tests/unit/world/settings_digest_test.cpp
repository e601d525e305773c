// The digest of settings by which replays know their worlds: no setting is left out.
// SPDX-License-Identifier: MIT
#include <cstring>
#include <type_traits>

#include "isostep/particles/recorder.hpp"
#include "isostep/replay/recorder.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace settings_digest_test {

template <class S> class SettingsDigest : public ::testing::Test {};
TYPED_TEST_SUITE(SettingsDigest, AllScalars);

/// Visits a record and makes the field of that number another one.
struct ChangeOne {
  int wanted;
  int* seen;

  template <class T> void operator()(const char*, T& value) const {
    if constexpr (HasFields<T>) {
      T::fields(*this, value);
    } else if ((*seen)++ == wanted) {
      if constexpr (std::is_enum_v<T>) value = static_cast<T>(static_cast<std::uint32_t>(value) ^ 1u);
      else if constexpr (std::is_same_v<T, bool>) value = !value;
      else value = value + T(1);
    }
  }
};
/// Returns how many fields there are.
template <class Settings> int expect_all_count() {
  int fields = 1;
  for (int i = 0; i < fields; ++i) {
    Settings plain, changed;
    int seen = 0;
    Settings::fields(ChangeOne{i, &seen}, changed);
    fields = seen;
    EXPECT_NE(settings_digest(plain), settings_digest(changed)) << "field " << i;
    EXPECT_EQ(settings_digest(plain), settings_digest(Settings{}));
  }
  return fields;
}

TYPED_TEST(SettingsDigest, every_setting_of_a_world_changes_it) {
  EXPECT_GE(expect_all_count<Settings<TypeParam>>(), 11);
}
TYPED_TEST(SettingsDigest, every_setting_of_particles_changes_it) {
  EXPECT_GE(expect_all_count<ParticleSettings<TypeParam>>(), 11);
}

}  // namespace settings_digest_test
}  // namespace isostep::test
