# A project without a build type compiles at -O0, and steps ten times slower. The engine inside it does not.

# isostep_speed_flags(variable): optimisation where the project chose neither a build type nor a level; else nothing. The
# results are the same.
function(isostep_speed_flags variable)
  get_property(many_types GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
  set(${variable} "" PARENT_SCOPE)
  if(NOT many_types AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CXX_FLAGS MATCHES "(^| )[-/]O")
    set(${variable} $<IF:$<CXX_COMPILER_ID:MSVC>,/O2,-O2> PARENT_SCOPE)
  endif()
endfunction()
