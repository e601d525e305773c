# Writes OUT: the files of RECORDINGS that are named *.SCALAR.replay for one of SCALARS, as constants of the library.
set(arrays "")
set(rows "")
set(count 0)
string(REPEAT "0x..," 16 sixteen)  # a line of bytes: CMake's expressions cannot count
foreach(scalar IN LISTS SCALARS)
  string(TOLOWER ${scalar} scalar)
  string(REPLACE "_" "." scalar ${scalar})
  file(GLOB files ${RECORDINGS}/*.${scalar}.replay)
  list(SORT files)
  foreach(file IN LISTS files)
    file(READ ${file} bytes HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
    string(REGEX REPLACE "(${sixteen})" "\\1\n" bytes "${bytes}")
    get_filename_component(name ${file} NAME_WE)
    string(APPEND arrays "constexpr std::uint8_t kFile${count}[] = {\n${bytes}};\n")
    string(APPEND rows "    {\"${name}\", \"${scalar}\", Bytes(kFile${count})},\n")
    math(EXPR count "${count} + 1")
  endforeach()
endforeach()
file(WRITE ${OUT} "// Written by the build from replays/selfcheck.\n#include \"isostep/replay/selfcheck.hpp\"\n\n"
  "namespace isostep {\nnamespace {\n\n${arrays}constexpr SelfcheckRecording kRecordings[] = {\n${rows}    {nullptr, nullptr, {}}};\n\n"
  "}  // namespace\n\nstd::span<const SelfcheckRecording> detail::selfcheck_recordings() { return {kRecordings, ${count}}; }\n\n"
  "}  // namespace isostep\n")
