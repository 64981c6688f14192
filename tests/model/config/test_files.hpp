// A folder of files that lives as long as one test, and the specs of the source tree.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "model/config/spec_path.hpp"

namespace stormproof::model::config {

class TestFiles {
 public:
  TestFiles() {
    std::string name = (std::filesystem::temp_directory_path() / "stormproof-XXXXXX").string();
    root_ = mkdtemp(name.data());
  }
  ~TestFiles() {
    std::error_code failed;
    std::filesystem::remove_all(root_, failed);
  }
  TestFiles(const TestFiles&) = delete;
  TestFiles& operator=(const TestFiles&) = delete;

  /// Writes a file, with its folders, and returns its path.
  std::string write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = root_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream{path, std::ios::binary} << text;
    return path.string();
  }
  std::string path(const std::string& name) const { return (root_ / name).string(); }
  std::string root() const { return root_.string(); }

 private:
  std::filesystem::path root_;
};

/// The profiles and scenarios of the source tree.
inline SpecPath source_specs() { return {{STORMPROOF_SPECS_DIR}}; }

}  // namespace stormproof::model::config
