// Handles: what pointers of the C interface point to, so that one that is used too late or wrongly is found out.
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>

#include "status.hpp"

namespace isostep::c {

/// The word of each kind of handle: "WRLD" and the like.
enum class HandleKind : std::uint32_t {
  none = 0,
  world = 0x444c5257,
  snapshot = 0x50414e53,
  tape = 0x45504154,
  replay = 0x4c505245,
  blob = 0x424f4c42,
  session = 0x53534553,
  network = 0x4b54454e
};

/// A cell is never freed, and used again only after hundreds of others: a handle that was destroyed points to memory
/// that says so. A cell takes 16 bytes.
struct Cell {
  std::atomic<HandleKind> kind = HandleKind::none;
  void* object = nullptr;
};

/// Opens a cell for an object. Throws std::bad_alloc, like all that allocates here.
Cell* open_cell(HandleKind kind, void* object);
/// Closes a cell; the object is the caller's again.
void close_cell(Cell* cell);
/// Finds the object of a handle of that kind. On ISO_NULL and ISO_NOT_ALIVE `object` is null.
iso_status find_object(const void* handle, HandleKind kind, const char* call, const char* name, void*& object);

/// The kind of handle and the object that a C type stands for: specialised beside the object.
template <class Handle> struct HandleOf;

/// The object behind a handle, or the status to return.
template <class Handle> struct Found {
  using Object = typename HandleOf<Handle>::Object;
  Object* object = nullptr;
  iso_status status;

  Found(const Handle* handle, const char* call) {
    void* found = nullptr;
    status = find_object(handle, HandleOf<Handle>::kKind, call, HandleOf<Handle>::kName, found);
    object = static_cast<Object*>(found);
  }
};

template <class Handle> Handle* open_handle(typename HandleOf<Handle>::Object* object) {
  return reinterpret_cast<Handle*>(open_cell(HandleOf<Handle>::kKind, object));
}
/// Destroys the object; null is no error.
template <class Handle> iso_status destroy_handle(Handle* handle, const char* call) {
  if (handle == nullptr) return kOk;
  const Found<Handle> found(handle, call);
  if (found.status != kOk) return found.status;
  close_cell(reinterpret_cast<Cell*>(handle));
  delete found.object;
  return kOk;
}

}  // namespace isostep::c
