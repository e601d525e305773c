// A shape that is added to the list alone does not compile, and the errors name each place that has to know it; with
// those six files changed it compiles, and it works with every other shape. Tried on copies of the headers, with the
// compiler of this build.
// SPDX-License-Identifier: MIT
#include "lists/probe.hpp"

namespace isostep {
namespace shapes_test {

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
  void add_submersion() {
    constexpr const char* kAfterTheOthers = "template <class S, class Shape>\nrequires(!Shape::kBounded)";
    edit("include/isostep/geometry/submersion.inl", kAfterTheOthers,
         "template <class S> Submersion<S> submersion_of(const Probe<S>& c, Vec3<Unit<S>> up, S level) {\n"
         "  return revolved_below(c.radius, c.half_height, c.centre_of_mass(), up, level, [](CutSlices<S>& slices) {\n"
         "    using U = Unit<S>;\n"
         "    slices.add_straight(U(-1), U(1), U(0.75), U(-0.25));\n"
         "    return U(7.0 / 12);\n  });\n}\n" +
             std::string(kAfterTheOthers));
  }
  void add_keys() {
    edit("src/scenes/shape_keys.hpp", "template <class Part, class Visit> void visit_sizes(Part& part",
         "template <class Part, class Visit> void visit_sizes(ShapeClass<Probe>, Part& part, const Visit& visit) {\n"
         "  visit(\"radius\", part.radius, SizeRule::positive);\n"
         "  visit(\"half_height\", part.half_height, SizeRule::positive);\n}\n"
         "template <class S, class Read> Probe<S> shape_of(ShapeClass<Probe>, const ScenePart& part, const Read& read) "
         "{\n"
         "  return {read.size(\"radius\", part.radius), read.size(\"half_height\", part.half_height)};\n}\n"
         "template <class Part, class Visit> void visit_sizes(Part& part");
  }
  void add_oracle() { edit("src/scenes/distance.cpp", "kShapeTypes == 9", "kShapeTypes == 10"); }
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

TEST_F(ShapeList, a_face_that_its_file_lacks_is_named) {
  add_to_list();
  add_file();
  edit("include/isostep/geometry/shapes/probe.hpp", "void find_face(", "void find_side(");
  EXPECT_THAT(errors_of("isostep/geometry/shape.hpp"), HasSubstr("find_face"));
}

TEST_F(ShapeList, a_shape_that_nobody_can_swim_with_does_not_compile) {
  add_to_list();
  add_file();
  EXPECT_EQ(errors_of("isostep/geometry/mass_properties.inl"), "");
  EXPECT_EQ(errors_of("isostep/collision/narrowphase/collide.inl"), "");
  const std::string asked =
      "template isostep::Submersion<float> isostep::submersion<float>(isostep::ShapeView<float>, "
      "isostep::Vec3<float>, float);";
  EXPECT_THAT(errors_of("isostep/geometry/submersion.inl", asked), HasSubstr("submersion_of"));
  add_submersion();
  EXPECT_EQ(errors_of("isostep/geometry/submersion.inl", asked), "");
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
  add_submersion();
  add_keys();
  add_oracle();
  EXPECT_EQ(errors_of("scenes/distance.cpp"), "");
  EXPECT_EQ(output_of("tests/lists/shape_probe.cpp"),
            "probe mass 0.916298 fault 0 ray 1 0.875 top 0.5 below 0.5 keys 2\n"
            "sphere 1 -0.03125\nbox 4 -0.03125\ncapsule 2 -0.03125\nhalf_space 4 -0.03125\nhull 4 -0.03125\n"
            "mesh 4 -0.03125\nheight_field 4 -0.03125\ncylinder 4 -0.03125\ncone 1 -0.03125\nprobe 4 -0.03125\n");
}

}  // namespace shapes_test
}  // namespace isostep
