# Writes OUT: page/assets.hpp's texts, of the files in PAGE and of THREE, which need not exist.
function(embed name)
  set(text "")
  foreach(path ${ARGN})
    if(EXISTS "${path}")
      file(READ "${path}" part)
      string(APPEND text "${part}\n")
    endif()
  endforeach()
  # Compilers need not take a literal longer than 64 KiB; those that follow one another are one.
  set(literals "")
  string(LENGTH "${text}" left)
  set(at 0)
  while(at LESS left)
    string(SUBSTRING "${text}" ${at} 8000 part)
    string(APPEND literals "\n    R\"isostep(${part})isostep\"")
    math(EXPR at "${at} + 8000")
  endwhile()
  if(left EQUAL 0)
    set(literals "\"\"")
  endif()
  file(APPEND "${OUT}" "const std::string_view ${name} = ${literals};\n")
endfunction()

file(WRITE "${OUT}" "// Written by the build from src/tool/page.\n#include \"tool/page/assets.hpp\"\n\n"
  "namespace isostep::tool::page::assets {\n\n")
embed(kPage ${PAGE}/page.html)
embed(kStyle ${PAGE}/player.css)
embed(kScript ${PAGE}/decode.js ${PAGE}/surfaces.js ${PAGE}/extent.js ${PAGE}/overlay.js ${PAGE}/effects.js
  ${PAGE}/view.js ${PAGE}/orbit.js ${PAGE}/player.js)
embed(kThree ${THREE})
file(APPEND "${OUT}" "const std::string_view kBuildDir = R\"isostep(${BUILD})isostep\";\n"
  "\n}  // namespace isostep::tool::page::assets\n")
