# Writes OUT: the behaviour version, a digest of the golden hashes in GOLDENS, as a function of the library. Whoever
# changes a result changes a golden, and so the version: nobody bumps it by hand.
file(GLOB goldens RELATIVE ${GOLDENS} ${GOLDENS}/*.txt)
list(SORT goldens)
set(all "")
foreach(golden IN LISTS goldens)
  file(READ ${GOLDENS}/${golden} lines)
  string(REPLACE "\r" "" lines "${lines}")
  string(APPEND all "${golden}\n${lines}")
endforeach()
string(SHA256 digest "${all}")
string(SUBSTRING ${digest} 0 16 version)
file(WRITE ${OUT} "// Written by the build from replays/goldens.\n#include \"isostep/core/version.hpp\"\n\n"
  "namespace isostep {\n\nstd::uint64_t behaviour_version() { return 0x${version}u; }\n\n}  // namespace isostep\n")
