// The cells of all handles: taken from a list of blocks that only grows, given back to the end of a queue.
// SPDX-License-Identifier: MIT
#include "handle.hpp"

#include <deque>
#include <memory>
#include <mutex>
#include <vector>

namespace isostep::c {
namespace {

constexpr std::size_t kBlock = 256;  // cells that are allocated at once
constexpr std::size_t kQuarantine =
    1024;  // closed cells that wait, so that a stale handle is not another object's soon

#if defined(__wasm__)  // one thread, and a library without mutexes
struct Mutex {};
struct Lock {
  explicit Lock(Mutex&) {}
};
#else
using Mutex = std::mutex;
using Lock = std::lock_guard<Mutex>;
#endif

struct Cells {
  Mutex mutex;
  std::vector<std::unique_ptr<Cell[]>> blocks;
  std::deque<Cell*> closed;
  std::size_t fresh = kBlock;  // the next cell of the last block
};
/// The cells are never destroyed: handles may be used until the process ends.
Cells& cells() {
  static Cells* const all = new Cells;
  return *all;
}

Cell* take(Cells& all) {
  if (all.closed.size() > kQuarantine) {
    Cell* const oldest = all.closed.front();
    all.closed.pop_front();
    return oldest;
  }
  if (all.fresh == kBlock) {
    all.blocks.push_back(std::make_unique<Cell[]>(kBlock));
    all.fresh = 0;
  }
  return &all.blocks.back()[all.fresh++];
}

}  // namespace

Cell* open_cell(HandleKind kind, void* object) {
  Cells& all = cells();
  [[maybe_unused]] const Lock lock(all.mutex);
  Cell* const cell = take(all);
  cell->object = object;
  cell->kind.store(kind, std::memory_order_release);
  return cell;
}

void close_cell(Cell* cell) {
  Cells& all = cells();
  [[maybe_unused]] const Lock lock(all.mutex);
  cell->kind.store(HandleKind::none, std::memory_order_release);
  cell->object = nullptr;
  all.closed.push_back(cell);
}

iso_status find_object(const void* handle, HandleKind kind, const char* call, const char* name, void*& object) {
  if (handle == nullptr) return refuse(ISO_NULL, call, name);
  const bool aligned = reinterpret_cast<std::uintptr_t>(handle) % alignof(Cell) == 0;
  const auto* const cell = static_cast<const Cell*>(handle);
  if (!aligned || cell->kind.load(std::memory_order_acquire) != kind) return refuse(ISO_NOT_ALIVE, call, name);
  object = cell->object;
  return kOk;
}

}  // namespace isostep::c
