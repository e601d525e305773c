// A shape whose content is a blob: kept while it is named, carried once or brought by the game, refused when it is not
// what its name says. Tried with a shape of the tests in copies of the headers, for the engine itself has none.
// SPDX-License-Identifier: MIT
#include "lists/probe.hpp"

namespace isostep {
namespace geometry_store_test {

class BlobShape : public ListProbe {
 protected:
  void add_shape() {
    copy("tests/lists/probe_blob_shape.hpp", "include/isostep/geometry/shapes/probe.hpp");
    edit("include/isostep/geometry/shape_type.hpp", "X(cone, Cone)", "X(cone, Cone) X(probe, Probe)");
    edit("include/isostep/geometry/shape.hpp", "#include \"isostep/geometry/shapes/sphere.hpp\"",
         "#include \"isostep/geometry/shapes/sphere.hpp\"\n#include \"isostep/geometry/shapes/probe.hpp\"");
    edit("include/isostep/collision/narrowphase/shape_pairs.hpp", "    add(hull, hull, collide_hull_hull<S>);",
         "    add(hull, hull, collide_hull_hull<S>);\n    add(sphere, probe, collide_never<S>);\n"
         "    add(box, probe, collide_never<S>);\n    add(capsule, probe, collide_never<S>);\n"
         "    add(half_space, probe, collide_never<S>);\n    add(hull, probe, collide_never<S>);\n"
         "    add(mesh, probe, collide_never<S>);\n    add(height_field, probe, collide_never<S>);\n"
         "    add(cylinder, probe, collide_never<S>);\n    add(cone, probe, collide_never<S>);\n"
         "    add(probe, probe, collide_never<S>);");
  }
};

TEST_F(BlobShape, without_a_look_at_its_blob_it_does_not_compile) {
  add_shape();
  edit("include/isostep/geometry/shapes/probe.hpp", "ShapeFault fault_of(", "ShapeFault flaw_of(");
  EXPECT_THAT(output_of("tests/lists/blob_probe.cpp"), HasSubstr("fault_of"));
}

TEST_F(BlobShape, is_kept_carried_brought_and_refused) {
  add_shape();
  EXPECT_EQ(output_of("tests/lists/blob_probe.cpp"), "all as it should be\n");
}

}  // namespace geometry_store_test
}  // namespace isostep
