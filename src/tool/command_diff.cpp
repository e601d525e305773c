#include "commands.hpp"
namespace isostep::tool { int command_diff(const DiffOptions&) { return 70; } }
