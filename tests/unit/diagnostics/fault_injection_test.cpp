// A fault is injected into what may be written, and of anything else it is said that none was.
// SPDX-License-Identifier: MIT
#include "diagnostics/fault_injection.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "diagnostics/field_editing.inl"
#include "isostep/scalar/exact.hpp"
#include "isostep/scalar/fixed.hpp"

namespace isostep {
namespace fault_injection_test {

/// A field of every way in which fields are reached: bare, in an Exact, as a sum of products narrow and wide.
struct Numbers {
  std::uint32_t count = 5;
  float number = 1.5f;
  Exact<float> exact = Exact<float>(2.5f);
  FixedSum<std::int32_t, 16> narrow = {7};
  FixedSum<std::int64_t, 32> wide = {Wide<std::int64_t>(9)};

  ISO_FIELDS(count, number, exact, narrow, wide)
};
struct Engine {
  Numbers own, shared;

  static std::uint64_t hash(const void*) { return 0; }
  static void walk(void* engine, FieldGroup group, std::uint32_t, const FieldSink& sink) {
    visit_fields(engine, group, FieldReading{sink});
  }
  static void edit(void* engine, FieldGroup group, std::uint32_t, const FieldEditor& editor) {
    visit_fields(engine, group, FieldEditing{editor});
  }
  template <class Access> static void visit_fields(void* engine, FieldGroup group, const Access& access) {
    if (group != FieldGroup::state) return;
    Engine& e = *static_cast<Engine*>(engine);
    const FieldVisitor visit(nullptr, access);
    visit("own", e.own);
    visit("shared", std::as_const(e.shared));
  }
  StageView view() { return StageView({this, &hash, &walk}, 0); }
};

std::vector<NamedField> fields_of(Engine& engine) {
  std::vector<NamedField> fields;
  const FieldSink sink = {[](void* user, const PathPart& path, FieldFormat format, std::uint64_t bits) {
                            static_cast<std::vector<NamedField>*>(user)->push_back({path_text(path), format, bits});
                          },
                          &fields};
  engine.view().visit(sink);
  return fields;
}

TEST(FaultInjection, TurnsTheOneBitAndNoOther) {
  Engine engine;
  const std::vector<NamedField> before = fields_of(engine);
  int injected = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].path.rfind("own.", 0) != 0) continue;
    ++injected;
    EXPECT_TRUE(FaultInjection(before[i].path, 3).inject(engine.view(), &Engine::edit)) << before[i].path;
    const std::vector<NamedField> after = fields_of(engine);
    for (std::size_t j = 0; j < before.size(); ++j)
      EXPECT_EQ(after[j].bits, before[j].bits ^ (i == j ? 8u : 0u)) << before[i].path << " at " << before[j].path;
    EXPECT_TRUE(FaultInjection(before[i].path, 3).inject(engine.view(), &Engine::edit));  // back
  }
  EXPECT_EQ(injected, 6) << "two words of the wide sum";
}

TEST(FaultInjection, WritesNothingThatIsShared) {
  Engine engine;
  int tried = 0;
  for (const NamedField& field : fields_of(engine)) {
    if (field.path.rfind("shared.", 0) != 0) continue;
    ++tried;
    EXPECT_FALSE(FaultInjection(field.path, 3).inject(engine.view(), &Engine::edit)) << field.path;
  }
  EXPECT_EQ(tried, 6);
}

TEST(FaultInjection, WritesNothingThatIsNotThere) {
  Engine engine;
  EXPECT_FALSE(FaultInjection("own.cuont", 3).inject(engine.view(), &Engine::edit));
  EXPECT_FALSE(FaultInjection("own.count", 32).inject(engine.view(), &Engine::edit));
}

}  // namespace fault_injection_test
}  // namespace isostep
