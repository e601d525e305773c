// The C# forms of C's names.
// SPDX-License-Identifier: MIT
#pragma once

#include "schema.hpp"

namespace isostep::csharp {

/// A family's namespace and the types of its numbers.
struct Family {
  std::string prefix, space, number, unit;
};
const std::vector<Family>& families();
const Family* find_family(const std::string& prefix);

/// Turns "body_definition" to "BodyDefinition", "ISO_LOCK_X" to "IsoLockX".
std::string pascal(const std::string& name);
/// Turns "id_space" to "idSpace"; keywords get an @.
std::string camel(const std::string& name);

/// The C# name of a struct, enumeration or handle: "iso_q32_vec3" is Vec3, within its family's namespace.
std::string type_name(const std::string& c_name);
/// The C# name of an enumerator.
std::string enumerator_name(const Enum& of, const std::string& value);

/// A comment as <summary> lines of at most 120 columns; none of an empty one.
std::string summary(const std::string& comment, const std::string& indent);

}  // namespace isostep::csharp
