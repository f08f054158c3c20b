# What is compiled and linked with, found in one place: all that is missing is told at once, by its Debian packages
# (cmake/debian_packages.txt says what each is for).
set(missing "")

# unsnarl_package(DEBIAN_PACKAGE NAME ...): find_package(NAME ...).
macro(unsnarl_package debian name)
  find_package(${name} ${ARGN} QUIET)
  if(NOT ${name}_FOUND)
    list(APPEND missing ${debian})
  endif()
endmacro()

# unsnarl_library(DEBIAN_PACKAGE VARIABLE NAME): for those whose packages bring no file for find_package, or one that asks
# for more than the library.
macro(unsnarl_library debian variable name)
  find_library(${variable} ${name})
  if(NOT ${variable})
    list(APPEND missing ${debian})
  endif()
endmacro()

find_package(Threads REQUIRED)
unsnarl_package(libeigen3-dev Eigen3 3.4 NO_MODULE)
if(UNSNARL_USE_TBB)
  unsnarl_package(libtbb-dev TBB)
endif()
set(UNSNARL_TBB_LIBRARY "")  # what library and tests are linked with for it
if(UNSNARL_USE_TBB)
  set(UNSNARL_TBB_LIBRARY TBB::tbb)
endif()
unsnarl_package(libboost-dev Boost 1.74)  # headers only: integers of any size
unsnarl_package(libfmt-dev fmt)
set(UNSNARL_FMT fmt::fmt)
if(NOT UNSNARL_BUILD_IO)
  set(UNSNARL_FMT fmt::fmt-header-only)  # nothing is linked with
endif()
if(UNSNARL_BUILD_IO)
  unsnarl_package(nlohmann-json3-dev nlohmann_json 3.11)
  unsnarl_package(libpng-dev PNG)
  unsnarl_package(libgif-dev GIF)
  unsnarl_package(zlib1g-dev ZLIB)
  unsnarl_package(libpugixml-dev pugixml)  # SVG, GIFTI, VTP, 3MF
  unsnarl_library(libzip-dev ZIP_LIBRARY zip)  # Debian's libzip-config.cmake asks for its programs too
endif()
if(UNSNARL_BUILD_APPS OR UNSNARL_BUILD_BENCHMARKS)
  unsnarl_package(libcli11-dev CLI11)
endif()
if(UNSNARL_BUILD_TESTS OR UNSNARL_BUILD_BENCHMARKS)
  unsnarl_package(libgtest-dev GTest)
endif()
if(UNSNARL_BUILD_TESTS AND UNSNARL_TEST_ORACLE)
  unsnarl_library(libgmp-dev GMP_LIBRARY gmp)
  unsnarl_library(libmpfr-dev MPFR_LIBRARY mpfr)
  if(GMP_LIBRARY AND MPFR_LIBRARY AND Boost_FOUND)  # else its own messages are in the way
    unsnarl_package(libcgal-dev CGAL 5.5)
  else()
    list(APPEND missing libcgal-dev)
  endif()
endif()
if(UNSNARL_BUILD_BENCHMARKS)
  unsnarl_package(libbenchmark-dev benchmark)
endif()

if(missing)
  list(JOIN missing " " names)
  set(advice "")
  if("libgtest-dev" IN_LIST missing OR "libcgal-dev" IN_LIST missing)
    set(advice "GoogleTest, CGAL, GMP and MPFR are for the tests alone: -DUNSNARL_BUILD_TESTS=OFF does without.")
  endif()
  # CMake leaves lines that begin with a space as they are, to be copied.
  message(FATAL_ERROR "Missing, or too old. On Debian:\n  apt-get install --no-install-recommends ${names}\n${advice}")
endif()

# What a program is linked with that is linked with the static libraries, by the target that asks for it: as CMake
# packages, names for the linker, and Debian packages.
set(UNSNARL_CORE_PACKAGES Threads)
set(UNSNARL_LINKED_LIBRARIES "")
set(UNSNARL_LINKED_DEBIAN "")
if(UNSNARL_USE_TBB)
  list(APPEND UNSNARL_CORE_PACKAGES TBB)
  list(APPEND UNSNARL_LINKED_LIBRARIES tbb)
  list(APPEND UNSNARL_LINKED_DEBIAN libtbb-dev)
endif()
list(APPEND UNSNARL_CORE_PACKAGES fmt)
set(UNSNARL_LINKED_PACKAGES "")
if(UNSNARL_BUILD_IO)
  set(UNSNARL_LINKED_PACKAGES PNG GIF ZLIB pugixml)
  list(APPEND UNSNARL_LINKED_LIBRARIES fmt png gif z pugixml zip)
  list(APPEND UNSNARL_LINKED_DEBIAN libfmt-dev libpng-dev libgif-dev zlib1g-dev libpugixml-dev libzip-dev)
else()
  list(APPEND UNSNARL_LINKED_DEBIAN libfmt-dev)
endif()
