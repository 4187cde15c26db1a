#pragma once
#include "program.h"

#include "store/frame.h"
#include "store/history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <sstream>
#include <sys/mount.h>
#include <thread>

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

inline std::vector<fs::path> frames_of(const fs::path& run) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(run / "frames"))
    if (entry.path().extension() == ".hdf") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// A run of about a second's tenth, without pictures.
inline Arguments quick(const Arguments& more = {}) {
  return words("run fig3_oblate --no-pictures --set grid.nodes=32 --set run.end_time=2e-5 "
               "--set output.frames=5",
               more);
}

/// Rows in order, frames that can be read, nothing half-written.
inline std::vector<Measures> check_stored(const fs::path& run) {
  const std::vector<Measures> history = read_history(run / "history.csv");
  for (std::size_t i = 1; i < history.size(); ++i)
    EXPECT_GT(history[i].time, history[i - 1].time) << "row " << i;
  for (const fs::path& file : frames_of(run)) EXPECT_NO_THROW(read_frame(file)) << file;
  for (const fs::path& folder : {run, run / "frames"})
    for (const std::string& name : names_in(folder)) EXPECT_FALSE(name.starts_with(".")) << name;
  return history;
}

/// All files below a folder by their names, with their contents; of links, where they lead.
inline std::map<std::string, std::string> contents_of(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder);
    contents[name] = entry.is_symlink()        ? fs::read_symlink(entry.path()).string()
                     : entry.is_regular_file() ? text_of(entry.path())
                                               : "";
  }
  return contents;
}

/// Until it is true, for a minute at most: it comes, the machine may only be slow.
template <class Condition>
bool comes_true(Condition condition) {
  for (int tries = 0; tries < 12000; ++tries) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

/// Waits until a run has stored some steps.
inline void wait_for_rows(const fs::path& run) {
  ASSERT_TRUE(comes_true([&] {
    return std::ranges::count(text_of(run / "history.csv"), '\n') > 5;
  })) << "no rows in "
      << run;
}

/// A run of many small steps.
inline Arguments slow(const std::string& end_time, const Arguments& more = {}) {
  return words("run sphere --set grid.nodes=16 --set shape.radius=0.45 "
               "--set numerics.max_time_step=1e-5 --set run.end_time=" +
                   end_time,
               more);
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

#ifdef LAMELLA_FAULTS
  /// A setting in which a system call goes wrong, see faults.c.
  Setting with_fault(const std::string& fault) const {
    Setting setting = setting_;
    setting.environment = {{"LD_PRELOAD", LAMELLA_FAULTS}, {"LAMELLA_FAULT", fault}};
    return setting;
  }
#endif

  fs::path base_;
  Setting setting_;
};

} // namespace lamella
