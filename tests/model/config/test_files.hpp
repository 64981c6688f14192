// A folder of files that lives as long as one test, and the specs of the source tree.
#pragma once

#include <string>

#include "model/config/spec_path.hpp"
#include "tests/files.hpp"

namespace stormproof::model::config {

class TestFiles {
 public:
  /// Writes a file, with its folders, and returns its path.
  std::string write(const std::string& name, const std::string& text) const {
    files::write(folder_.path() / name, text);
    return path(name);
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string root() const { return folder_.path().string(); }

 private:
  files::Folder folder_;
};

/// The profiles and scenarios of the source tree.
inline SpecPath source_specs() { return {{STORMPROOF_SPECS_DIR}}; }

}  // namespace stormproof::model::config
