// What commands do, one after the other between steps. A command of the list without `execute` does not compile.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/commands/destruction.inl"
#include "isostep/commands/execute_bodies.inl"
#include "isostep/commands/execute_body_changes.inl"
#include "isostep/commands/execute_forces.inl"
#include "isostep/commands/execute_joints.inl"
#include "isostep/commands/execute_records.inl"
#include "isostep/commands/execute_shapes.inl"

#define ISO_INSTANTIATE_EXECUTE(name, Type, Result, S) template Result CommandExecutor<S>::execute(const Type&);
#define ISO_INSTANTIATE_COMMANDS(S)                                              \
  ISO_DESTRUCTION_OF(, S)                                                        \
  template std::size_t CommandExecutor<S>::destroy_all(std::span<const BodyId>); \
  ISO_FOR_EACH_COMMAND(ISO_INSTANTIATE_EXECUTE, S)
