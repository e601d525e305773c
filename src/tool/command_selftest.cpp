#include "commands.hpp"
namespace isostep::tool { int command_selftest(const SelftestOptions&) { return 70; } }
