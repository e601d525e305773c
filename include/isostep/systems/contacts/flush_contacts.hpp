// FlushContacts<S>: contacts with edges that a body slides over, because another part lies flush with them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_frames.hpp"

namespace isostep {

/// Input:   a step's contacts with their geometry.
/// Output:  the same without those that stop a body as it slides from one tile, belt or part to the next one.
/// Keeps:   nothing from step to step but memory.
/// Method:  a body rests on the plane of one contact, so it gets no deeper than that in this step, and cannot hit what
///          lies behind the plane. A contact with that along another normal is with a side or an edge that the surfaces
///          beside it hide. It is left out or, if it leans little, gets the normal of the plane: an overhanging body
///          may rest on it. Two parts that are each behind the other's plane form a ridge: both count. Only parts of
///          static and kinematic bodies hide one another. Triangles of one surface know their neighbours.
template <class S> class FlushContacts {
 public:
  using U = Unit<S>;

  ISO_INLINE FlushContacts(const WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  void update(std::vector<Contact<S>>& contacts, std::vector<ContactGeometry<S>>& geometry);

 private:
  static constexpr std::uint32_t kNone = ~0u;
  static constexpr double kAlike = 0x1p-7;  // [1] of normals: those of one plane
  static constexpr double kLeans = 0.98;    // [1] cosine, of 11 degrees
  static constexpr S kFlush = S(0x1p-9);    // [m] what stands out by less is pushed over as overlap

  /// A contact, seen from its moving body.
  struct Seen {
    Vec3<U> normal;            // [1] out of the ground
    std::uint32_t mover, row;  // slot and row of the moving body
    std::uint32_t ground, leaf;
    S plane;  // [m] of the ground along the normal, from the moving body's centre of mass
  };
  /// The ground part of a contact, relative to the moving body's centre of mass.
  struct Part {
    ShapeView<S> shape;
    Transform<S> at;
    std::uint32_t triangle;
    LeafRange leaves;  // of the surface that it is of

    ISO_INLINE bool is_of_surface() const { return is_surface(shape.primitive.type); }
  };

  bool chain(const std::vector<ContactGeometry<S>>& geometry);
  bool stands(std::uint32_t row) const { return row == 0 || stands_[row] != 0; }
  Seen seen(const Contact<S>& contact, const ContactGeometry<S>& g) const;
  Part part_of(const Seen& seen) const;
  static bool is_behind(const Part& part, Vec3<U> normal, S plane);
  void judge(std::uint32_t at, const std::vector<Contact<S>>& contacts, std::vector<ContactGeometry<S>>& geometry);

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  std::vector<std::uint8_t> stands_;  // by row
  std::vector<std::uint32_t> last_;   // by row: of its contacts with what stands
  std::vector<std::uint32_t> next_;   // by contact: the one before it of that body
  std::vector<std::uint8_t> left_out_;
  bool any_left_out_ = false;
};

#define ISO_FLUSH_CONTACTS_OF(extern, S) extern template class FlushContacts<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_FLUSH_CONTACTS_OF)

}  // namespace isostep
