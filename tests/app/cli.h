#pragma once
#include "program.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <sys/mount.h>

namespace lamella {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

/// The words of a text, then more.
inline Arguments words(const std::string& text, const Arguments& more = {}) {
  std::istringstream stream(text);
  Arguments all{std::istream_iterator<std::string>(stream), {}};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

inline void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

inline std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

/// Calls of the program in a new folder work(), which is gone afterwards.
class Cli : public testing::Test {
protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "lamella-cli-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    base_ = name;
    setting_.folder = base_ / "work";
    fs::create_directory(work());
    fs::permissions(base_, fs::perms::all);
  }
  void TearDown() override {
    umount2((base_ / "small").c_str(), MNT_DETACH);
    fs::permissions(work(), fs::perms::owner_all);
    fs::remove_all(base_);
  }

  const fs::path& work() const { return setting_.folder; }
  Result call(const Arguments& arguments) const { return Program(arguments, setting_).wait(); }

  fs::path base_;
  Setting setting_;
};

} // namespace lamella
