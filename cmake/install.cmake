# Install rules and the package that find_package(isostep CONFIG) finds.
include(CMakePackageConfigHelpers)

set_target_properties(isostep_deterministic_flags PROPERTIES EXPORT_NAME deterministic_flags)
install(TARGETS isostep isostep_scalar isostep_deterministic_flags EXPORT isostep
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
set(isostep_left_out "")
if(NOT ISOSTEP_BOOK)
  set(isostep_left_out REGEX "/isostep/book$" EXCLUDE)
endif()
install(DIRECTORY scalar/include/ include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp" PATTERN "*.inl"
  ${isostep_left_out})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/licenses/isostep)

set(isostep_package ${CMAKE_INSTALL_LIBDIR}/cmake/isostep)
# What was built beside them; each is found if what it needs is.
foreach(extra transport sealed threads)
  if(TARGET isostep_${extra})
    install(TARGETS isostep_${extra} EXPORT isostep-${extra} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(DIRECTORY src/${extra}/ DESTINATION ${isostep_extras}/${extra} FILES_MATCHING PATTERN "*.hpp")
    install(EXPORT isostep-${extra} NAMESPACE isostep:: FILE isostep-${extra}.cmake DESTINATION ${isostep_package})
  endif()
endforeach()
# pkg-config: the prefix as seen from the file, which is right wherever it is installed and moved to; that of the system,
# /usr, by its name, for pkg-config leaves its folders out of what it prints.
set(isostep_pc_prefix ${CMAKE_INSTALL_PREFIX})
set(isostep_pc_libdir ${CMAKE_INSTALL_FULL_LIBDIR})
set(isostep_pc_includedir ${CMAKE_INSTALL_FULL_INCLUDEDIR})
if(NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr" AND NOT IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}"
    AND NOT IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  string(REGEX REPLACE "[^/]+" ".." isostep_pc_prefix "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
  set(isostep_pc_prefix "\${pcfiledir}/${isostep_pc_prefix}")
  set(isostep_pc_libdir "\${prefix}/${CMAKE_INSTALL_LIBDIR}")
  set(isostep_pc_includedir "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
endif()
function(isostep_install_pc template)
  get_filename_component(name ${template} NAME_WLE)
  configure_file(${template} ${CMAKE_CURRENT_BINARY_DIR}/${name} @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name} DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
get_target_property(isostep_pc_definitions isostep INTERFACE_COMPILE_DEFINITIONS)
if(isostep_pc_definitions)
  list(TRANSFORM isostep_pc_definitions PREPEND "-D")
  list(JOIN isostep_pc_definitions " " isostep_pc_definitions)
else()
  set(isostep_pc_definitions "")
endif()
isostep_install_pc(cmake/isostep-cpp.pc.in)

if(TARGET isostep_c)
  foreach(library c c_udp)
    if(TARGET isostep_${library})
      install(TARGETS isostep_${library} EXPORT isostep-c LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    endif()
  endforeach()
  install(FILES src/c/include/isostep.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  if(TARGET isostep_c_udp)
    install(FILES src/c/include/isostep_udp.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  endif()
  if(TARGET isostep_csharp_package)
    get_target_property(package isostep_csharp_package PACKAGE)
    install(DIRECTORY ${package}/Runtime/ DESTINATION ${CMAKE_INSTALL_DATADIR}/isostep/csharp OPTIONAL
      FILES_MATCHING PATTERN "*.cs")
  endif()
  isostep_install_pc(src/c/isostep.pc.in)
  install(EXPORT isostep-c NAMESPACE isostep:: FILE isostep-c.cmake DESTINATION ${isostep_package})
endif()
install(EXPORT isostep NAMESPACE isostep:: FILE isostep-targets.cmake DESTINATION ${isostep_package})
configure_package_config_file(cmake/isostep-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/isostep-config.cmake
  INSTALL_DESTINATION ${isostep_package} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change hashes and interface.
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/isostep-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/isostep-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/isostep-config-version.cmake
  cmake/add_scalar.cmake
  cmake/speed_flags.cmake
  DESTINATION ${isostep_package})
if(ISOSTEP_TOOL AND TARGET isostep_tool)
  install(TARGETS isostep_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

# All that is installed, and the programs that packages are tried with: what `./isostep package` needs of this build.
add_custom_target(isostep_packaged)
foreach(target isostep isostep_scalar isostep_c isostep_c_udp isostep_csharp_package isostep_python isostep_transport
    isostep_sealed isostep_threads isostep_tool example_four_scalars example_four_scalars_c js_hello_hashes js_enet_host match_host match_client_q32)
  if(TARGET ${target})
    add_dependencies(isostep_packaged ${target})
  endif()
endforeach()
