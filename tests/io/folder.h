#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "platform/files.h"

namespace unsnarl {

/// A folder for the files of one test.
class TestFolder {
 public:
  TestFolder() {
    const int error = platform::make_temporary_folder(std::filesystem::temp_directory_path(), "unsnarl-", path_);
    if (error != 0) throw std::system_error(error, std::generic_category(), "no temporary folder");
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  ~TestFolder() { std::filesystem::remove_all(path_); }

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace unsnarl
