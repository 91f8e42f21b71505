# Every library from outside, as one target each. A missing one says which Debian package brings it.

function(perimorph_missing what package)
  message(FATAL_ERROR "${what} was not found. Install it with: apt-get install ${package}   (tools/install-dependencies installs everything)")
endfunction()

macro(perimorph_find what debian_package)
  find_package(${what} QUIET ${ARGN})
  if(NOT ${what}_FOUND)
    perimorph_missing(${what} ${debian_package})
  endif()
endmacro()

perimorph_find(MPI libopenmpi-dev COMPONENTS C CXX)
perimorph_find(Trilinos "trilinos-all-dev libptscotch-dev" COMPONENTS Tpetra Belos Ifpack2 MueLu Zoltan2 Intrepid2 Shards Teuchos)
perimorph_find(Eigen3 libeigen3-dev)
perimorph_find(nanoflann libnanoflann-dev)
perimorph_find(CLI11 libcli11-dev)
perimorph_find(fmt libfmt-dev)
perimorph_find(spdlog libspdlog-dev)
perimorph_find(pugixml libpugixml-dev)

find_path(EXODUSII_INCLUDE_DIR exodusII.h)
find_library(EXODUSII_LIBRARY exoIIv2c)
if(NOT EXODUSII_INCLUDE_DIR OR NOT EXODUSII_LIBRARY)
  perimorph_missing(Exodus libexodusii-dev)
endif()
find_path(HDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/openmpi)
find_library(HDF5_LIBRARY hdf5_openmpi)
if(NOT HDF5_INCLUDE_DIR OR NOT HDF5_LIBRARY)
  perimorph_missing("Parallel HDF5" libhdf5-openmpi-dev)
endif()
find_library(PTSCOTCH_LIBRARY ptscotch)
if(NOT PTSCOTCH_LIBRARY)
  perimorph_missing(PT-Scotch libptscotch-dev)
endif()

add_library(perimorph_trilinos INTERFACE)
target_include_directories(perimorph_trilinos SYSTEM INTERFACE ${Trilinos_INCLUDE_DIRS} ${Trilinos_TPL_INCLUDE_DIRS})
target_link_libraries(perimorph_trilinos INTERFACE ${Trilinos_LIBRARIES} MPI::MPI_CXX)

# libexoIIv2c carries the parallel netCDF and HDF5: never link the serial ones beside it.
add_library(perimorph_exodus INTERFACE)
target_include_directories(perimorph_exodus SYSTEM INTERFACE ${EXODUSII_INCLUDE_DIR})
target_link_libraries(perimorph_exodus INTERFACE ${EXODUSII_LIBRARY} MPI::MPI_CXX)

add_library(perimorph_hdf5 INTERFACE)
target_include_directories(perimorph_hdf5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIR})
target_link_libraries(perimorph_hdf5 INTERFACE ${HDF5_LIBRARY} MPI::MPI_CXX)
