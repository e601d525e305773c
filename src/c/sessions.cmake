# Sessions of the C interface: the simulated network is in the library itself. UDP is in one of its own, for ENet is a
# shared library, and isostep::c is to need none but the C library.
foreach(source simulated_network network_profile impaired_direction)
  target_sources(isostep_c PRIVATE ${PROJECT_SOURCE_DIR}/src/transport/${source}.cpp)
endforeach()
target_include_directories(isostep_c PRIVATE ${PROJECT_SOURCE_DIR}/src)
if(TARGET isostep_transport)
  add_subdirectory(udp)
endif()
