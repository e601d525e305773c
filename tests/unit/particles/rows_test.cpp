// The geometry of constraints: normals and separations of links, contacts and touches.
// SPDX-License-Identifier: MIT
#include "isostep/particles/step/rows.hpp"

#include "unit/particles/step_scene.hpp"

namespace isostep {
namespace rows_test {

template <class S> class RowsTest : public testing::Test {
 protected:
  using Row = ParticleConstraint<S>;
  static Row row(ConstraintKind kind, ParticleId a, std::uint32_t b, std::uint32_t other, double radius = 0) {
    Row made = {};
    made.kind = kind;
    made.a = a.slot;
    made.b = b;
    made.other = other;
    made.radius = from_double<S>(radius);
    return made;
  }
  void expect(const Row& row, D3 normal, double separation) {
    EXPECT_NEAR(to_double(row.normal.x), normal.x, 1e-4);
    EXPECT_NEAR(to_double(row.normal.y), normal.y, 1e-4);
    EXPECT_NEAR(to_double(row.normal.z), normal.z, 1e-4);
    EXPECT_NEAR(to_double(row.separation), separation, 16 * grain<S>(4));
  }
  StepScene<S> scene_;
  ParticleRows<S> rows_{scene_.state, scene_.step};
};
TYPED_TEST_SUITE(RowsTest, Scalars);

TYPED_TEST(RowsTest, LinksContactsAndTouchesStandWhereTheirSidesAreNow) {
  StepScene<TypeParam>& scene = this->scene_;
  const ParticleId a = scene.add(kNowhere), b = scene.add({0, 3, 4});
  const LinkId rod = scene.add_link(LinkType::rod, a, b, 4), cable = scene.add_link(LinkType::cable, a, b, 6);
  scene.state.colliders.add(Collider<TypeParam>{});  // the plane y = 0
  scene.begin();
  this->rows_.add(this->row(ConstraintKind::rod, a, b.slot, rod.slot));
  this->rows_.add(this->row(ConstraintKind::cable, a, b.slot, cable.slot));
  this->rows_.end_links();
  this->rows_.add(this->row(ConstraintKind::contact, a, b.slot, kNoParticle, 1));
  this->rows_.add(this->row(ConstraintKind::contact, b, kNoParticle, 0, 0.5));
  this->rows_.end_contacts();
  this->rows_.look();
  EXPECT_EQ(this->rows_.links().size(), 2u);
  EXPECT_EQ(this->rows_.contacts().size(), 2u);
  EXPECT_EQ(this->rows_.touches().size(), 0u);
  this->expect(this->rows_.all()[0], {0, 0.6, 0.8}, 1);
  this->expect(this->rows_.all()[1], {0, -0.6, -0.8}, 1);
  this->expect(this->rows_.all()[2], {0, 0.6, 0.8}, 4);
  this->expect(this->rows_.all()[3], {0, -1, 0}, 2.5);
}

TYPED_TEST(RowsTest, ParticlesInOnePlacePartUpwards) {
  StepScene<TypeParam>& scene = this->scene_;
  const ParticleId a = scene.add(kRight), b = scene.add(kRight);
  scene.begin();
  this->rows_.end_links();
  this->rows_.add(this->row(ConstraintKind::contact, a, b.slot, kNoParticle, 1));
  this->rows_.end_contacts();
  this->rows_.look();
  this->expect(this->rows_.all()[0], kUp, -1);
}

TYPED_TEST(RowsTest, ATouchedSurfaceGoesOnByItself) {
  using S = TypeParam;
  using V = Velocity<S>;
  StepScene<S>& scene = this->scene_;
  const ParticleId a = scene.add(kNowhere);
  scene.begin();
  this->rows_.end_links();
  this->rows_.end_contacts();
  ParticleConstraint<S> touch = this->row(ConstraintKind::contact, a, kNoParticle, kNoParticle, -1);
  touch.normal = {Unit<S>(0), Unit<S>(1), Unit<S>(0)};
  touch.surface_gain.y = V(2);
  this->rows_.add(touch);
  for (int i = 0; i < 2; ++i) {
    this->rows_.accelerate_surfaces();
    this->rows_.move_surfaces();
  }
  this->rows_.look();
  this->expect(this->rows_.touches()[0], kUp, 1 + (2 + 4) * scene.h());
}

}  // namespace rows_test
}  // namespace isostep
