# The engine for a scalar that the library does not hold.

# isostep_add_scalar(target "isostep::Fixed<std::int64_t, 40>" [header]): `target` gets one more source, which
# instantiates World<S>, ParticleWorld<S> and everything beneath. `header` is what the scalar's name needs beyond
# isostep's own: a path from the calling folder, or anything that `target` can include. The other sources of `target`, and
# of what links it, may use any scalar then: the linker says which one is missing.
function(isostep_add_scalar target scalar)
  string(MD5 digest "${scalar}")
  string(SUBSTRING ${digest} 0 8 digest)
  set(file ${CMAKE_CURRENT_BINARY_DIR}/${target}_scalar_${digest}.cpp)
  set(include "")
  if(ARGC GREATER 2)
    get_filename_component(here "${ARGV2}" ABSOLUTE)
    if(EXISTS "${here}")
      set(include "#include \"${here}\"\n")
    else()
      set(include "#include \"${ARGV2}\"\n")
    endif()
  endif()
  file(CONFIGURE OUTPUT ${file} @ONLY CONTENT [[
// The engine for @scalar@.
@include@#include "isostep/instantiate/engine.inl"
ISO_INSTANTIATE_ENGINE(@scalar@)
]])
  target_sources(${target} PRIVATE ${file})
  target_link_libraries(${target} PRIVATE isostep::isostep)
  target_compile_definitions(${target} PUBLIC ISOSTEP_OWN_SCALARS)
  # A source's options come after its target's, so a target built with -mfma keeps exactness here.
  # The compiler chooses what it inlines, in a quarter of the time, and leaves weak copies for the target's processor: a
  # program with targets for several gives its scalar to the one for the oldest.
  get_target_property(flags isostep::deterministic_flags INTERFACE_COMPILE_OPTIONS)
  isostep_speed_flags(speed)
  set_source_files_properties(${file} TARGET_DIRECTORY ${target} PROPERTIES COMPILE_OPTIONS "${flags};${speed}"
    COMPILE_DEFINITIONS ISOSTEP_OUR_FLAGS)
endfunction()
