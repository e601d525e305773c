#pragma once
#include <memory>
#include <variant>

#include "isostep.h"
#include "isostep/world/world.hpp"
#include "live_handles.hpp"
struct iso_world {
  std::variant<std::shared_ptr<isostep::World<float>>, std::shared_ptr<isostep::World<double>>,
               std::shared_ptr<isostep::World<isostep::Q16_16>>, std::shared_ptr<isostep::World<isostep::Q32_32>>>
      world;
};
namespace isostep::c {
inline bool is_live(const iso_world* w) { return LiveHandles<iso_world>::has(w); }
template <class F> auto visit_world(iso_world& w, F&& f) { return std::visit(f, w.world); }
}  // namespace isostep::c
