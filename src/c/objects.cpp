// The entry of a world's calls.
// SPDX-License-Identifier: MIT
#include "objects.hpp"

namespace isostep::c {

WorldObject::~WorldObject() = default;
SnapshotObject::~SnapshotObject() = default;
TapeWriter::~TapeWriter() = default;

BlobRef WorldObject::find_asset(void* user, const ContentId& id) {
  for (const BlobRef& asset : static_cast<const WorldObject*>(user)->assets) {
    if (asset->id() == id) return asset;
  }
  return nullptr;
}

iso_status enter(const iso_world* handle, const char* call, Access access, WorldObject*& object) {
  const Found<iso_world> found(handle, call);
  if (found.status != kOk) return found.status;
  object = found.object;
  const std::uint32_t inside = object->inside.load(std::memory_order_relaxed);
  const std::uint32_t forbidden = access == Access::changes ? ~0u : WorldObject::kSteps;
  return (inside & forbidden) != 0 ? refuse(ISO_CALLED_BACK, call) : kOk;
}

}  // namespace isostep::c
