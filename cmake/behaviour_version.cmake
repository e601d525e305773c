# Writes OUT: the behaviour version, a digest of the golden hashes in the file GOLDENS, as a function of the library.
# Whoever changes a result changes a golden, and so the version: nobody bumps it by hand.
file(READ ${GOLDENS} lines)
string(REPLACE "\r" "" lines "${lines}")
string(SHA256 digest "${lines}")
string(SUBSTRING ${digest} 0 16 version)
file(WRITE ${OUT} "// Written by the build from replays/goldens.txt.\n#include \"isostep/core/version.hpp\"\n\n"
  "namespace isostep {\n\nstd::uint64_t behaviour_version() { return 0x${version}u; }\n\n}  // namespace isostep\n")
