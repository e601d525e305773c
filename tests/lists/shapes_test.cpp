// A shape that is added to the list alone does not compile, and the errors name each place that has to know it; with
// those places filled it compiles and works. Tried on copies of the headers, with the compiler of this build.
// SPDX-License-Identifier: MIT
#include "lists/probe.hpp"

namespace isostep {
namespace {

class ShapeList : public ListProbe {
 protected:
  void add_to_list() {
    edit("include/isostep/geometry/shape_type.hpp", "X(cone, Cone)", "X(cone, Cone) X(probe, Probe)");
  }
  void add_file() {
    copy("tests/lists/probe_shape.hpp", "include/isostep/geometry/shapes/probe.hpp");
    edit("include/isostep/geometry/shape.hpp", "#include \"isostep/geometry/shapes/sphere.hpp\"",
         "#include \"isostep/geometry/shapes/sphere.hpp\"\n#include \"isostep/geometry/shapes/probe.hpp\"");
  }
  void add_pairs() {
    edit("include/isostep/collision/narrowphase/shape_pairs.hpp", "    add(hull, hull, collide_hull_hull<S>);",
         "    add(hull, hull, collide_hull_hull<S>);\n"
         "    add(sphere, probe, collide_records<S, collide_sphere_box<S>>);\n"
         "    add(box, probe, collide_records<S, collide_box_box<S>>);\n"
         "    add(capsule, probe, collide_never<S>);\n    add(half_space, probe, collide_never<S>);\n"
         "    add(hull, probe, collide_never<S>);\n    add(mesh, probe, collide_never<S>);\n"
         "    add(height_field, probe, collide_never<S>);\n    add(cylinder, probe, collide_never<S>);\n"
         "    add(cone, probe, collide_never<S>);\n"
         "    add(probe, probe, collide_records<S, collide_box_box<S>>);");
  }
  void add_keys() {
    edit("src/scenes/shape_keys.hpp", "// shape_of:",
         "template <class Part, class Visit> void visit_sizes(ShapeClass<Probe>, Part& part, const Visit& visit) {\n"
         "  visit(\"half_side\", part.radius, SizeRule::positive);\n}\n// shape_of:");
  }
};

TEST_F(ShapeList, without_its_file_it_does_not_compile) {
  add_to_list();
  EXPECT_THAT(errors_of("isostep/geometry/shape.hpp"), HasSubstr("Probe"));
}

TEST_F(ShapeList, a_member_that_its_file_lacks_is_named) {
  add_to_list();
  add_file();
  edit("include/isostep/geometry/shapes/probe.hpp", "closest(const Transform<S>& t", "nearest(const Transform<S>& t");
  EXPECT_THAT(errors_of("isostep/geometry/shape.hpp"),
              AllOf(HasSubstr("a shape's file lacks a member"), HasSubstr("shape.closest")));
}

TEST_F(ShapeList, pairs_that_are_missing_do_not_compile) {
  add_to_list();
  add_file();
  EXPECT_EQ(errors_of("isostep/geometry/mass_properties.inl"), "");
  EXPECT_THAT(errors_of("isostep/collision/narrowphase/collide.inl"),
              HasSubstr("two shapes have no function in ShapePairs"));
}

TEST_F(ShapeList, keys_of_scene_files_that_are_missing_do_not_compile) {
  add_to_list();
  add_file();
  EXPECT_THAT(errors_of("scenes/scene_file.cpp"), HasSubstr("visit_sizes"));
  EXPECT_THAT(errors_of("scenes/distance.cpp"), HasSubstr("an oracle knows each shape by itself"));
}

TEST_F(ShapeList, in_all_its_places_it_works) {
  add_to_list();
  add_file();
  add_pairs();
  add_keys();
  EXPECT_EQ(output_of("tests/lists/shape_probe.cpp"),
            "probe mass 2 fault 0 touch 4 -0.03125 ray 1 0.875 top 0.5 keys 1\n");
}

}  // namespace
}  // namespace isostep
