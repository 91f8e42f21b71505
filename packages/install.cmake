# cmake --install: the packages, for find_package(Perimorph). Each is a target Perimorph::<package> then.
include(CMakePackageConfigHelpers)

# Eigen aligns its matrices by the instructions that it is compiled for. Whoever includes our headers has to align them as our
# libraries do, which the release preset compiles for this very machine.
if(NOT DEFINED PERIMORPH_ALIGNMENT)
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/alignment.cpp
    "#include <Eigen/Core>\n#include <iostream>\nint main() { std::cout << EIGEN_MAX_ALIGN_BYTES; }\n")
  set(CMAKE_TRY_COMPILE_CONFIGURATION ${CMAKE_BUILD_TYPE})
  try_run(perimorph_alignment_ran perimorph_alignment_compiled ${CMAKE_CURRENT_BINARY_DIR} ${CMAKE_CURRENT_BINARY_DIR}/alignment.cpp
    LINK_LIBRARIES Eigen3::Eigen RUN_OUTPUT_VARIABLE alignment)
  if(NOT perimorph_alignment_compiled OR NOT perimorph_alignment_ran EQUAL 0)
    message(FATAL_ERROR "A program that asks Eigen for its alignment could not be compiled or run: ${alignment}")
  endif()
  set(PERIMORPH_ALIGNMENT ${alignment} CACHE INTERNAL "Of Eigen's matrices, in bytes")
endif()
target_compile_definitions(perimorph_base INTERFACE $<INSTALL_INTERFACE:EIGEN_MAX_ALIGN_BYTES=${PERIMORPH_ALIGNMENT}>)

set(folder ${CMAKE_INSTALL_LIBDIR}/cmake/Perimorph)
file(CONFIGURE OUTPUT PerimorphConfig.cmake CONTENT [[
set(Perimorph_PACKAGES @PERIMORPH_PACKAGES@)
include(${CMAKE_CURRENT_LIST_DIR}/libraries.cmake)
if(NOT DEFINED Perimorph_FOUND OR Perimorph_FOUND)
  include(${CMAKE_CURRENT_LIST_DIR}/packages.cmake)
endif()
]] @ONLY)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/PerimorphConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT perimorph DESTINATION ${folder} FILE packages.cmake NAMESPACE Perimorph::)
install(FILES libraries.cmake ${CMAKE_CURRENT_BINARY_DIR}/PerimorphConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/PerimorphConfigVersion.cmake DESTINATION ${folder})
