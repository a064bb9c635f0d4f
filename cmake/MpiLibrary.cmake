# SPDX-License-Identifier: BSD-2-Clause
#   pm_mpi  pbrt-mpi (libopenmpi-dev); without it that program and its tests are left out
# Only the C interface of MPI is used: its C++ classes are no part of the standard any more.
find_package(MPI QUIET COMPONENTS CXX)
if(MPI_CXX_FOUND)
  add_library(pm_mpi INTERFACE)
  target_link_libraries(pm_mpi INTERFACE MPI::MPI_CXX)
  target_compile_definitions(pm_mpi INTERFACE OMPI_SKIP_MPICXX=1 MPICH_SKIP_MPICXX=1)
else()
  message(STATUS "MPI not found (libopenmpi-dev): pbrt-mpi and its tests are left out")
endif()
