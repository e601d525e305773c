// What games ask between steps, and systems in them. Compiled apart from both.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/query/asked_shape.inl"
#include "isostep/query/cast_queries.inl"
#include "isostep/query/joint_queries.inl"
#include "isostep/query/overlap_queries.inl"
#include "isostep/query/query_batches.inl"
#include "isostep/query/query_sight.inl"

#define ISO_INSTANTIATE_WORLD_QUERIES(S) \
  ISO_QUERY_SIGHT_OF(, S)                \
  ISO_ASKED_SHAPE_OF(, S)                \
  ISO_CAST_QUERIES_OF(, S)               \
  ISO_OVERLAP_QUERIES_OF(, S)            \
  ISO_JOINT_QUERIES_OF(, S)
