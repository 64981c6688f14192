// Puts something of the test's own choice where the program looks for cvc5: a script, or nothing.
// The variables are restored afterwards, and every temporary file has to be gone.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "tests/files.hpp"

namespace stormproof::smt {

using files::Folder;

/// Sets an environment variable until the end of its life.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_{name} {
    if (const char* const old = std::getenv(name)) old_ = old;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() {
    if (old_)
      setenv(name_, old_->c_str(), 1);
    else
      unsetenv(name_);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

/// While it lives, `cvc5` is a shell script: `--version` answers, anything else runs `body`.
class FakeSolver {
 public:
  explicit FakeSolver(const std::string& body) {
    const auto file = folder_.path() / "cvc5";
    std::ofstream{file} << "#!/bin/sh\nif [ \"$1\" = --version ]; then\n"
                        << "  echo 'This is cvc5 version 0.0.7'; exit 0\nfi\n"
                        << body << "\n";
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    path_.emplace("PATH", folder_.path().string() + ":/usr/bin:/bin");
  }

 private:
  Folder folder_;
  std::optional<Variable> path_;
};

}  // namespace stormproof::smt
