#include "unsnarl/libraries.h"

#include <fmt/format.h>
#include <gif_lib.h>
#include <png.h>
#include <zip.h>
#include <zlib.h>

#include <Eigen/Core>
#include <boost/version.hpp>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "geometry/parallel.h"
#include "platform/process.h"

namespace unsnarl {

std::vector<LibraryVersion> libraries() {
  const unsigned png = png_access_version_number();
  std::vector<LibraryVersion> all = {
      {"Boost", fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
#ifdef __clang__
      {"Clang", fmt::format("{}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__)},
#endif
      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
#ifndef __clang__
      {"GCC", fmt::format("{}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__)},
#endif
      {"giflib", fmt::format("{}.{}.{}", GIFLIB_MAJOR, GIFLIB_MINOR, GIFLIB_RELEASE)},
      {"glibc", platform::version_of_glibc()},
      {"libpng", fmt::format("{}.{}.{}", png / 10000, png / 100 % 100, png % 100)},
      {"libzip", zip_libzip_version()},
      {"nlohmann/json",
       fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"oneTBB", version_of_tbb()},
      {"pugixml", fmt::format("{}.{}", PUGIXML_VERSION / 1000, PUGIXML_VERSION / 10 % 100)},
      {"zlib", zlibVersion()},
      {"{fmt}", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
  };
  std::erase_if(all, [](const LibraryVersion& library) { return library.version.empty(); });
  return all;
}

}  // namespace unsnarl
