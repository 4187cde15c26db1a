#include "error.h"
#include "store/atomic_file.h"
#include "store/folder.h"
#include "store/frame.h"
#include "store/history.h"
#include "store/run_status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <xxhash.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

#include <sys/resource.h>
#include <unistd.h>

namespace lamella {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

void put(const fs::path& file, std::string_view content) {
  std::ofstream(file, std::ios::binary) << content;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const StoreError& error) {
    return error.what();
  }
  return "no StoreError";
}

/// Lets files grow to a size and no further, as a full disk does.
class FileSizeLimit {
public:
  explicit FileSizeLimit(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }

private:
  rlimit before_{};
  void (*signal_)(int);
};

class Store : public testing::Test {
protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("lamella store " + std::to_string(::getpid()));
    fs::create_directory(folder_);
  }
  void TearDown() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }

  std::size_t files() const {
    return std::size_t(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}));
  }

  fs::path folder_;
};

class FrameStore : public Store {
protected:
  static Frame sample() {
    Frame frame{{{16, 12, 10}, 0.1 / 3}, 1.25e-4, {}, {3, 0, -12}};
    for (std::size_t n = 0; n < frame.grid.size(); ++n) {
      const auto [x, y, z] = frame.grid.position(n);
      frame.phi.push_back(std::sin(7 * x) + y * y - std::exp(z));
    }
    frame.phi[3] = -0.0;
    frame.phi[4] = std::numeric_limits<double>::denorm_min();
    return frame;
  }

  static Frame sample_with_phases() {
    Frame frame = sample();
    for (std::size_t n = 0; n < frame.grid.size(); ++n) {
      const auto [x, y, z] = frame.grid.position(n);
      frame.fields["psi"].push_back(std::cos(5 * y) - x * z);
      frame.fields["c"].push_back(1 + 0.01 * std::sin(9 * z + x));
    }
    return frame;
  }

  /// Equal to the last bit.
  static void expect_same(const std::vector<double>& values, const std::vector<double>& expected) {
    ASSERT_EQ(values.size(), expected.size());
    EXPECT_TRUE(values.empty() ||
                std::memcmp(values.data(), expected.data(), values.size() * sizeof(double)) == 0);
  }

  fs::path file() const { return folder_ / "frame_0001.hdf"; }

  static std::string checksum_line(std::string_view image) {
    char line[64];
    std::snprintf(line, sizeof line, "lamella frame, XXH3 %016llx\n",
                  static_cast<unsigned long long>(XXH3_64bits(image.data(), image.size())));
    return line;
  }

  /// A frame in which a run of values is replaced by another, and which has the right checksum all
  /// the same.
  template <class T>
  std::string forged(const std::vector<T>& from, const std::vector<T>& to,
                     const Frame& frame = sample()) const {
    write_frame(file(), frame);
    std::string bytes = content_of(file());
    bytes.resize(bytes.size() - checksum_line("").size());
    const std::string_view pattern(reinterpret_cast<const char*>(from.data()),
                                   from.size() * sizeof(T));
    const auto at = bytes.find(pattern);
    EXPECT_NE(at, bytes.npos);
    bytes.replace(at, pattern.size(), reinterpret_cast<const char*>(to.data()),
                  to.size() * sizeof(T));
    return bytes + checksum_line(bytes);
  }

  std::string message_for(std::string_view content) const {
    put(file(), content);
    return message_of([&] { read_frame(file()); });
  }
};

TEST_F(FrameStore, ReadsWhatItWroteToTheLastBit) {
  for (const Frame& frame : {sample(), sample_with_phases()}) {
    write_frame(file(), frame);
    const Frame back = read_frame(file());
    EXPECT_EQ(back.grid, frame.grid);
    EXPECT_EQ(back.time, frame.time);
    EXPECT_EQ(back.cells, frame.cells);
    expect_same(back.phi, frame.phi);
    ASSERT_EQ(back.fields.size(), frame.fields.size());
    for (const auto& [name, values] : frame.fields) expect_same(back.fields.at(name), values);
    EXPECT_EQ(files(), 1u);
  }
}

TEST_F(FrameStore, StoresEachFieldByItself) {
  Frame frame = sample_with_phases();
  frame.fields.erase("psi");
  write_frame(file(), frame);
  EXPECT_FALSE(read_frame(file()).has("psi"));
  expect_same(read_frame(file()).fields.at("c"), frame.fields.at("c"));
  EXPECT_THAT(content_of(file()), HasSubstr("Scalars")) << "readers are told which comes first";

  frame.fields.erase("c");
  write_frame(file(), frame);
  write_frame(folder_ / "plain.hdf", sample());
  EXPECT_EQ(content_of(file()), content_of(folder_ / "plain.hdf")) << "no trace of fields";
}

TEST_F(FrameStore, PutsTheVesicleWhereTheBoxHasMovedTo) {
  Frame frame = sample();
  for (const int cells : {0, 1, -1'000'000, 1'000'000}) {
    frame.cells = {cells, -cells, 0};
    write_frame(file(), frame);
    EXPECT_EQ(read_frame(file()).cells, frame.cells);
  }
  frame.cells = {7, 0, 0};
  write_frame(file(), frame);
  const double h = frame.grid.spacing,
               origin[]{frame.grid.origin(0) + 7 * h, frame.grid.origin(1), frame.grid.origin(2)};
  EXPECT_THAT(content_of(file()),
              HasSubstr(std::string(reinterpret_cast<const char*>(origin), sizeof origin)));
}

TEST_F(FrameStore, EqualFramesMakeEqualFiles) {
  write_frame(file(), sample());
  write_frame(folder_ / "again.hdf", sample());
  EXPECT_EQ(content_of(file()), content_of(folder_ / "again.hdf"));
  write_frame(file(), sample_with_phases());
  EXPECT_NE(content_of(file()), content_of(folder_ / "again.hdf"));
  write_frame(folder_ / "again.hdf", sample_with_phases());
  EXPECT_EQ(content_of(file()), content_of(folder_ / "again.hdf"));
}

TEST_F(FrameStore, ReplacesAnOlderFrame) {
  put(file(), "older");
  write_frame(file(), sample());
  EXPECT_EQ(read_frame(file()).time, sample().time);
  EXPECT_EQ(files(), 1u);
}

TEST_F(FrameStore, RefusesFramesThatNoReaderWouldTake) {
  put(file(), "older");
  const auto message = [&](auto change) {
    Frame frame = sample_with_phases();
    change(frame);
    return message_of([&] { write_frame(file(), frame); });
  };
  EXPECT_THAT(message([](Frame& f) { f.phi[100] = nan; }),
              HasSubstr("phi has values that are not finite"));
  EXPECT_THAT(message([](Frame& f) { f.phi.back() = infinity; }), HasSubstr("not finite"));
  EXPECT_THAT(message([](Frame& f) { f.time = nan; }), HasSubstr("the time is nan"));
  EXPECT_THAT(message([](Frame& f) { f.phi.pop_back(); }),
              HasSubstr("phi has 1919 values, the grid 1920"));
  EXPECT_THAT(message([](Frame& f) { f.phi.clear(); }),
              HasSubstr("phi has 0 values, the grid 1920"));
  EXPECT_THAT(message([](Frame& f) { f.fields["psi"].push_back(1); }),
              HasSubstr("psi has 1921 values"));
  EXPECT_THAT(message([](Frame& f) { f.fields["c"].resize(5); }), HasSubstr("c has 5 values"));
  EXPECT_THAT(message([](Frame& f) { f.fields["psi"][0] = infinity; }),
              HasSubstr("psi has values that are not finite"));
  EXPECT_THAT(message([](Frame& f) { f.fields["c"][7] = nan; }),
              HasSubstr("c has values that are not"));
  EXPECT_THAT(message([](Frame& f) { f.grid.spacing = 0; }), HasSubstr("spacing"));
  EXPECT_THAT(message([](Frame& f) { f.grid.nodes[1] = -12; }), HasSubstr("16 x -12 x 10 nodes"));
  EXPECT_THAT(message([](Frame& f) { f.cells[2] = -1000001; }),
              HasSubstr("the box has moved by (3, 0, -1000001) cells"));
  EXPECT_EQ(content_of(file()), "older");
  EXPECT_EQ(files(), 1u);
}

TEST_F(FrameStore, SaysWhyTheSystemRefuses) {
  const fs::path lost = folder_ / "no folder" / "x.hdf", below_a_file = folder_ / "file" / "x.hdf";
  put(folder_ / "file", "");
  EXPECT_THAT(message_of([&] { write_frame(lost, sample()); }),
              HasSubstr("No such file or directory"));
  EXPECT_THAT(message_of([&] { write_frame(below_a_file, sample()); }),
              HasSubstr("Not a directory"));
  EXPECT_THAT(message_of([&] { write_frame(folder_, sample()); }), HasSubstr("not a regular file"));
  EXPECT_THAT(message_of([&] { write_frame("/dev/full", sample()); }),
              HasSubstr("not a regular file"));
  EXPECT_THAT(message_of([&] { read_frame(lost); }), HasSubstr("No such file or directory"));
  EXPECT_NE(message_of([&] { read_frame(folder_); }), "no StoreError");
}

TEST_F(FrameStore, RespectsAFolderThatIsReadOnly) {
  if (::geteuid() == 0) GTEST_SKIP() << "nothing is read-only for root";
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THAT(message_of([&] { write_frame(file(), sample()); }), HasSubstr("Permission denied"));
}

TEST_F(FrameStore, KeepsTheOlderFrameWhenTheDiskIsFull) {
  put(file(), "older");
  std::string message;
  {
    const FileSizeLimit limit(4096);
    message = message_of([&] { write_frame(file(), sample()); });
  }
  EXPECT_THAT(message, HasSubstr("cannot be written: File too large"));
  EXPECT_EQ(content_of(file()), "older");
  EXPECT_EQ(files(), 1u);
}

TEST_F(FrameStore, RefusesEveryTruncatedFile) {
  for (const Frame& frame : {sample(), sample_with_phases()}) {
    write_frame(file(), frame);
    const std::string whole = content_of(file());
    for (std::size_t size = 0; size < whole.size(); size += 97)
      ASSERT_THAT(message_for(whole.substr(0, size)),
                  StartsWith(file().string() + ": cannot be read as a frame"))
          << size;
    EXPECT_THAT(message_for(whole.substr(0, whole.size() - 1)), HasSubstr("cut off"));
    EXPECT_THAT(message_for(whole + "\n"), HasSubstr("cut off"));
  }
}

TEST_F(FrameStore, RefusesEveryFlippedBit) {
  for (const Frame& frame : {sample(), sample_with_phases()}) {
    write_frame(file(), frame);
    const std::string whole = content_of(file());
    for (std::size_t n = 0; n < whole.size(); n += 61) {
      std::string damaged = whole;
      damaged[n] = static_cast<char>(damaged[n] ^ (1 << (n % 8)));
      ASSERT_THAT(message_for(damaged), HasSubstr("cannot be read as a frame")) << n;
    }
  }
}

TEST_F(FrameStore, RefusesForeignFiles) {
  EXPECT_THAT(message_for(""), HasSubstr("size is out of range"));
  EXPECT_THAT(message_for(std::string(5000, 'x')), HasSubstr("it is not one"));
  const std::string signed_text(5000, 'x');
  EXPECT_THAT(message_for(signed_text + checksum_line(signed_text)), HasSubstr("not an HDF5 file"));
}

TEST_F(FrameStore, RefusesForgedFilesBeforeAllocating) {
  using Integers = std::vector<std::int64_t>;
  const Integers extent{0, 15, 0, 11, 0, 9};
  const auto with_extent = [&](const Integers& other) {
    return message_for(forged(extent, other));
  };
  EXPECT_EQ(with_extent(extent), "no StoreError");
  EXPECT_THAT(with_extent({0, 15, 0, 11, 0, 1 << 30}), HasSubstr("WholeExtent is out of range"));
  EXPECT_THAT(with_extent({0, std::int64_t(1) << 40, 0, 11, 0, 9}), HasSubstr("WholeExtent"));
  EXPECT_THAT(with_extent({0, -2, 0, 11, 0, 9}), HasSubstr("WholeExtent is out of range"));
  EXPECT_THAT(with_extent({1, 16, 0, 11, 0, 9}), HasSubstr("WholeExtent is out of range"));
  EXPECT_THAT(with_extent({0, 1023, 0, 1023, 0, 1023}), HasSubstr("WholeExtent is out of range"));
  EXPECT_THAT(with_extent({0, 31, 0, 11, 0, 9}), HasSubstr("does not agree with WholeExtent"));

  using Numbers = std::vector<double>;
  const double h = sample().grid.spacing;
  const auto with_spacing = [&](const Numbers& other) {
    return message_for(forged(Numbers{h, h, h}, other));
  };
  EXPECT_THAT(with_spacing({h, h, 2 * h}), HasSubstr("the same along all axes"));
  EXPECT_THAT(with_spacing({nan, nan, nan}), HasSubstr("must be positive"));
  EXPECT_THAT(with_spacing({-h, -h, -h}), HasSubstr("must be positive"));
  EXPECT_THAT(message_for(forged(Numbers{sample().time}, Numbers{nan})), HasSubstr("not finite"));

  const Frame frame = sample();
  Numbers origin;
  for (int i = 0; i < 3; ++i) origin.push_back(frame.grid.origin(i) + frame.cells[i] * h);
  const auto with_origin_moved_by = [&](double x) {
    return message_for(forged(origin, Numbers{origin[0] + x, origin[1], origin[2]}));
  };
  EXPECT_EQ(with_origin_moved_by(2 * h), "no StoreError");
  for (const double x : {0.5 * h, 1.001 * h, 2e6 * h, nan, infinity})
    EXPECT_THAT(with_origin_moved_by(x), HasSubstr("Origin is not a whole number of cells")) << x;

  // The size that the data set itself states, along z, y, x and once more as the largest allowed.
  const Integers size{10, 12, 16, 10, 12, 16}, huge{1000, 1000, 1000, 1000, 1000, 1000};
  EXPECT_THAT(message_for(forged(size, huge)), HasSubstr("does not agree with WholeExtent"));
}

TEST_F(FrameStore, RefusesForgedPhases) {
  const Frame frame = sample_with_phases();
  using Bytes = std::vector<char>;
  const auto renamed = [&](const Bytes& from, const Bytes& to) {
    return message_for(forged(from, to, frame));
  };
  const Bytes psi{'\0', 'p', 's', 'i', '\0'}, phi{'\0', 'p', 'h', 'i', '\0'};
  EXPECT_EQ(renamed(psi, psi), "no StoreError");
  EXPECT_THAT(renamed(phi, {'\0', 'p', 'h', 'j', '\0'}), HasSubstr("PointData/phi is missing"));

  // The size of the second field in the file, beside that of the first.
  using Integers = std::vector<std::int64_t>;
  const Integers size{10, 12, 16, 10, 12, 16}, other{10, 16, 12, 10, 16, 12};
  std::string bytes = forged(size, size, frame);
  const auto pattern = [](const Integers& values) {
    return std::string(reinterpret_cast<const char*>(values.data()), values.size() * 8);
  };
  const auto second = bytes.find(pattern(size), bytes.find(pattern(size)) + 1);
  ASSERT_NE(second, bytes.npos);
  bytes.replace(second, pattern(size).size(), pattern(other));
  bytes.resize(bytes.size() - checksum_line("").size());
  EXPECT_THAT(message_for(bytes + checksum_line(bytes)),
              HasSubstr("PointData/c does not agree with WholeExtent"));
}

class HistoryStore : public Store {
protected:
  static Measures row(double time) {
    Measures m;
    double value = time;
    for (double* x : {&m.time, &m.dt, &m.energy, &*m.terms[Term::bending], &m.int_KM2, &m.P,
                      &m.sigma, &m.K_multiplier, &m.area, &m.volume, &m.reduced_volume,
                      &m.area_difference, &m.area_drift, &m.volume_drift, &m.max_speed})
      *x = value, value = -1.01 * value - 1e-7;
    m.components = 2;
    m.genus = -3;
    return m;
  }

  /// Every column of phases and stretch has a value of its own.
  static Measures row_with_phases(double time) {
    Measures m = row(time);
    m.phases = {18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30};
    m.stretch = {31, 32};
    return m;
  }

  /// 1, 2, 3 ... in the order of the columns.
  static Measures numbered(Measures m) {
    int n = 0;
    for (const Field& field : row_of(m)) {
      n++;
      if (auto* const* number = std::get_if<double*>(&field.value)) **number = n;
      if (auto* const* count = std::get_if<int*>(&field.value)) **count = n;
    }
    return m;
  }

  static std::string line_of(int number, const std::string& text) {
    std::stringstream stream(text);
    std::string line;
    while (number-- > 0) std::getline(stream, line);
    return line;
  }

  fs::path file() const { return folder_ / "history.csv"; }
};

const std::string history_header =
    "t,dt,energy,bending_energy,int_KM2,P,sigma,K_multiplier,A,V,v,Da,"
    "dA_rel,dV_rel,max_speed,components,genus";

TEST_F(HistoryStore, KeepsRowsToTwelveDigits) {
  HistoryWriter writer(file());
  for (const double t : {0.0, 1.25e-4, 123456.789}) writer.add(row(t));
  const auto rows = read_history(file()); // the writer is still open: every row is there at once
  ASSERT_EQ(rows.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n) {
    const Measures expected = row(rows[n].time);
    EXPECT_NEAR(rows[n].energy, expected.energy, 1e-11 * std::abs(expected.energy));
    EXPECT_NEAR(rows[n].max_speed, expected.max_speed, 1e-11 * std::abs(expected.max_speed));
    EXPECT_EQ(rows[n].components, 2);
    EXPECT_EQ(rows[n].genus, -3);
  }
  EXPECT_EQ(rows[2].time, 123456.789);
}

TEST_F(HistoryStore, NamesItsColumnsInTheOrderOfMeasures) {
  HistoryWriter(file()).add(numbered({}));
  EXPECT_EQ(content_of(file()), history_header + "\n1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17\n");
}

TEST_F(HistoryStore, NamesTheColumnsOfPhasesAndOfStretchWhereThereAreSome) {
  Measures m;
  m.phases.emplace();
  m = numbered(m);
  const std::string phases_header = history_header +
                                    ",bending_Ld,bending_Lo,line_energy,sigma_Ld,"
                                    "sigma_Lo,A_Ld,A_Lo,dA_Ld_rel,line_length,line_radius,"
                                    "max_line_speed,domains_Ld,domains_Lo",
                    phases_row = "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,"
                                 "25,26,27,28,29,30";
  HistoryWriter(file(), m).add(m);
  EXPECT_EQ(content_of(file()), phases_header + "\n" + phases_row + "\n");
  m.stretch.emplace();
  m.terms[Term::stretch] = 0;
  m = numbered(m);
  HistoryWriter(file(), m).add(m);
  EXPECT_EQ(content_of(file()),
            phases_header + ",c_min,c_max,stretch_energy\n" + phases_row + ",31,32,33\n");
}

TEST_F(HistoryStore, ReadsPhasesAndStretchWhereThereAreSome) {
  Measures with_stretch = row_with_phases(2);
  with_stretch.phases.reset();
  for (const Measures& like : {row(1), row_with_phases(1), with_stretch}) {
    HistoryWriter writer(file(), like);
    EXPECT_TRUE(read_history(file()).empty());
    writer.add(like);
    const Measures back = read_history(file()).at(0);
    ASSERT_EQ(back.phases.has_value(), like.phases.has_value());
    if (like.phases) {
      EXPECT_EQ(back.phases->bending_energy_Ld, 18);
      EXPECT_EQ(back.phases->domains_Lo, 30);
    }
    ASSERT_EQ(back.stretch.has_value(), like.stretch.has_value());
    if (like.stretch) {
      EXPECT_EQ(back.stretch->greatest, 32);
    }
  }
}

TEST_F(HistoryStore, KeepsTheTermsOfTheEnergyThatThereAre) {
  Measures m = row_with_phases(1);
  m.terms[Term::film] = 35;
  m.terms[Term::line_tension] = 36;
  m.terms[Term::torsion] = 37;
  HistoryWriter(file(), m).add(m);
  EXPECT_THAT(line_of(1, content_of(file())),
              testing::EndsWith(",c_max,line_tension_energy,tau_g_energy,film_energy"));
  EXPECT_THAT(line_of(2, content_of(file())), testing::EndsWith(",32,36,37,35"));
  const Measures back = read_history(file()).at(0);
  EXPECT_EQ(back.terms[Term::film], 35);
  EXPECT_EQ(back.terms[Term::line_tension], 36);
  EXPECT_EQ(back.terms[Term::torsion], 37);
  EXPECT_FALSE(back.terms[Term::pressure] || back.terms[Term::area_difference]);
  EXPECT_FALSE(back.terms[Term::normal] || back.terms[Term::geodesic]);
}

TEST_F(HistoryStore, RefusesRowsOfOtherColumns) {
  HistoryWriter writer(file(), row_with_phases(0));
  EXPECT_THAT(message_of([&] { writer.add(row(1)); }),
              HasSubstr("row not written: it has 17 values for 32 columns"));
  writer.add(row_with_phases(2));
  EXPECT_EQ(read_history(file()).size(), 1u);
  Measures bad = row_with_phases(3);
  bad.phases->sigma_Lo = infinity;
  EXPECT_THAT(message_of([&] { writer.add(bad); }), HasSubstr("sigma_Lo is inf at t = 3"));
}

TEST_F(HistoryStore, RefusesRowsThatAreNotFinite) {
  HistoryWriter writer(file());
  Measures bad = row(2);
  bad.sigma = nan;
  EXPECT_THAT(message_of([&] { writer.add(bad); }),
              HasSubstr("row not written: sigma is nan at t = 2"));
  writer.add(row(3));
  EXPECT_EQ(read_history(file()).size(), 1u);
}

TEST_F(HistoryStore, SaysWhyTheSystemRefuses) {
  EXPECT_THAT(message_of([] { HistoryWriter("/dev/full"); }),
              HasSubstr("/dev/full: cannot be replaced: it is not a regular file"));
  EXPECT_THAT(message_of([] { HistoryWriter("/no/folder/history.csv"); }),
              HasSubstr("No such file"));
  EXPECT_THAT(message_of([] { read_history("/no/folder/history.csv"); }),
              HasSubstr("No such file"));
  EXPECT_NE(message_of([&] { read_history(folder_); }), "no StoreError");
}

TEST_F(HistoryStore, EndsWithAWholeRowWhenTheDiskIsFull) {
  HistoryWriter writer(file());
  int rows = 0;
  std::string message = "no StoreError";
  {
    const FileSizeLimit limit(1000);
    for (; message == "no StoreError" && rows < 100; ++rows)
      message = message_of([&] { writer.add(row(rows)); });
  }
  EXPECT_THAT(message, HasSubstr("File too large"));
  EXPECT_EQ(read_history(file()).size(), std::size_t(rows - 1));
  writer.add(row(100));
  EXPECT_EQ(read_history(file()).size(), std::size_t(rows));
}

TEST_F(HistoryStore, GoesOnAfterAMarkInAFileOfItsOwn) {
  TableMark mark;
  std::string marked;
  {
    HistoryWriter writer(file());
    for (int n = 0; n < 3; ++n) writer.add(row(n));
    mark = writer.mark();
    marked = content_of(file());
    writer.add(row(3));
  }
  const std::string longer = content_of(file());
  fs::create_hard_link(file(), folder_ / "other name");
  HistoryWriter writer(file(), row(0), mark);
  EXPECT_EQ(content_of(file()), marked);
  writer.add(row(3));
  EXPECT_EQ(content_of(file()), longer);
  EXPECT_EQ(content_of(folder_ / "other name"), longer) << "which is another file now";
  writer.add(row(4));
  EXPECT_EQ(content_of(folder_ / "other name"), longer);
  EXPECT_EQ(writer.mark().size, long(content_of(file()).size()));
}

TEST_F(HistoryStore, GoesOnAfterNothingButWhatWasWritten) {
  TableMark mark;
  {
    HistoryWriter writer(file());
    for (int n = 0; n < 3; ++n) writer.add(row(n));
    mark = writer.mark();
  }
  const std::string whole = content_of(file());
  const auto message = [&](const std::string& text) {
    put(file(), text);
    const std::string said = message_of([&] { HistoryWriter(file(), row(0), mark); });
    EXPECT_EQ(content_of(file()), text) << "left as it is";
    return said;
  };
  for (std::size_t n = 0; n < whole.size(); n += 7) {
    std::string damaged = whole;
    damaged[n] = char(damaged[n] ^ 1);
    EXPECT_THAT(message(damaged), HasSubstr("it is damaged: its rows are not those that were"))
        << n;
  }
  EXPECT_THAT(message(whole.substr(0, whole.size() - 1)), HasSubstr("rows are missing"));
  put(file(), whole + "more");
  EXPECT_EQ(message_of([&] { HistoryWriter(file(), row(0), mark); }), "no StoreError");
  EXPECT_EQ(content_of(file()), whole);
}

TEST_F(Store, StatusIsReadAsItWasWritten) {
  const fs::path file = folder_ / "status.toml";
  for (const double time : {0., 1., 2e-5, 8e-4, 1. / 3, 123456., 1e300, 5e-324}) {
    RunStatus status;
    status.state = RunStatus::State::stopped;
    status.time = time;
    status.reason = "\"quoted\" \\ and more";
    status.origin = "a folder, t = 1";
    status.scene_hash = hash_of("scene");
    write_status(Place(file), status);
    const RunStatus back = read_status(file);
    EXPECT_EQ(back.time, time);
    EXPECT_EQ(back.state, status.state);
    EXPECT_EQ(back.reason, status.reason);
    EXPECT_EQ(back.origin, status.origin);
    EXPECT_EQ(back.scene_hash, status.scene_hash);
  }
  for (const char* other : {"", "state = \"finished\"\n", "scene_hash = \"0123456789abcdef\"\n"}) {
    put(file, other);
    EXPECT_THAT(message_of([&] { read_status(file); }), HasSubstr("not the status of a run"));
  }
}

TEST_F(Store, ReplacesLinksNeitherNorWhatTheyStandFor) {
  put(folder_ / "outside", "precious");
  for (const char* target : {"outside", "nothing"}) {
    const fs::path link = folder_ / "link";
    fs::create_symlink(target, link);
    EXPECT_THAT(message_of([&] { write_text_atomically(link, "text"); }),
                HasSubstr("link: cannot be replaced: it is a symbolic link"));
    EXPECT_THAT(message_of([&] { HistoryWriter{link}; }), HasSubstr("symbolic link"));
    EXPECT_EQ(fs::read_symlink(link), target);
    fs::remove(link);
  }
  EXPECT_EQ(content_of(folder_ / "outside"), "precious");
  EXPECT_EQ(files(), 1u);
}

TEST_F(Store, OpensNoFolderOfItsOwnThroughALink) {
  fs::create_directory(folder_ / "outside");
  fs::create_directory_symlink("outside", folder_ / "link");
  const Folder folder(folder_);
  EXPECT_THAT(message_of([&] { folder.inner("link"); }), HasSubstr("link: is a symbolic link"));
  EXPECT_THAT(message_of([&] { folder.find("link"); }), HasSubstr("link: is a symbolic link"));
  EXPECT_EQ(Folder(folder_ / "link").path(), folder_ / "link") << "as a user may name one";
  const Folder inner = folder.inner("frames");
  fs::rename(folder_ / "frames", folder_ / "moved");
  fs::create_directory_symlink("outside", folder_ / "frames");
  write_text_atomically(Place(inner, "file"), "text");
  EXPECT_EQ(content_of(folder_ / "moved" / "file"), "text") << "it stays the same folder";
  EXPECT_TRUE(fs::is_empty(folder_ / "outside"));
}

TEST_F(HistoryStore, ReadsNothingButHistories) {
  const std::string good = "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17";
  const auto message = [&](const std::string& text) {
    put(file(), text);
    return message_of([&] { read_history(file()); });
  };
  const std::string start = history_header + "\n" + good + "\n";
  EXPECT_EQ(message(start), "no StoreError");
  EXPECT_THAT(message(""), HasSubstr("it is empty"));
  EXPECT_THAT(message("t,dt\n"), HasSubstr("csv:1: not a history: the first line"));
  EXPECT_THAT(message(history_header), HasSubstr("csv:1:"));
  EXPECT_THAT(message(history_header + ",x\n"), HasSubstr("csv:1:"));
  EXPECT_THAT(message(history_header + ",A_Ld\n"), HasSubstr("csv:1:")) << "not without the others";
  for (const std::string& bad :
       {good + ",18\n", good + ",\n", good, std::string("1,2,3\n"), std::string("\n"),
        "x" + good + "\n", " " + good + "\n", good + " \n",
        std::string("nan,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17\n"),
        std::string("1,inf,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17\n"),
        std::string("1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16.5,17\n"),
        std::string("1,,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17\n"),
        std::string("1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,99999999999\n")})
    EXPECT_THAT(message(start + bad), HasSubstr("csv:3: not a history: expected 17 finite values"))
        << bad;
}

class EventStore : public Store {
protected:
  static Event event() {
    return {Event::Kind::thin_outside,
            1,
            {2, 3, 4},
            5,
            6,
            7,
            8,
            9,
            10,
            11,
            12,
            13,
            14,
            15,
            {16, 17, 18}};
  }

  fs::path file() const { return folder_ / "events.csv"; }
};

const std::string event_header =
    "t,kind,x,y,z,size,components_before,components_after,genus_before,"
    "genus_after,domains_before,domains_after,A_before,A_cut,energy_before,energy_after,cells_x,"
    "cells_y,cells_z";

TEST_F(EventStore, WritesARowForEveryEvent) {
  EventWriter(file()).add(event());
  EXPECT_EQ(content_of(file()),
            event_header + "\n1,thin_outside,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18\n");
}

TEST_F(EventStore, ReadsWhatItWrote) {
  EventWriter writer(file());
  EXPECT_TRUE(read_events(file()).empty());
  std::vector<Event> events(2, event());
  events[1].kind = Event::Kind::fission;
  events[1].place = {-0.125, 1e-9, 0};
  for (const Event& e : events) writer.add(e);
  EXPECT_EQ(read_events(file()), events);
}

TEST_F(EventStore, RefusesEventsThatAreNotFinite) {
  EventWriter writer(file());
  Event bad = event();
  bad.place[1] = infinity;
  EXPECT_THAT(message_of([&] { writer.add(bad); }),
              HasSubstr("row not written: y is inf at t = 1"));
  EXPECT_TRUE(read_events(file()).empty());
}

TEST_F(Store, KeepsWhatEachVesicleHas) {
  for (const bool phases : {false, true}) {
    ComponentMeasures m{.time = 0.5,
                        .component = 2,
                        .center = {0.1, -0.2, 0.3},
                        .volume = 1.25,
                        .area = 7,
                        .reduced_volume = 0.75,
                        .P = -12,
                        .sigma = 3.5,
                        .K_multiplier = 0.25,
                        .int_KM = -11};
    if (phases) m.area_Ld = 2.5;
    const auto file = folder_ / "components.csv";
    ComponentWriter(file, m).add(m);
    const std::vector<ComponentMeasures> read = read_components(file);
    ASSERT_EQ(read.size(), 1u);
    EXPECT_EQ(read[0], m);
  }
}

TEST_F(EventStore, ReadsNothingButEvents) {
  const auto message = [&](const std::string& kind) {
    put(file(), event_header + "\n1," + kind + ",2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18\n");
    return message_of([&] { read_events(file()); });
  };
  EXPECT_EQ(message("fission"), "no StoreError");
  for (const char* bad : {"fissions", "", "0"})
    EXPECT_THAT(message(bad), HasSubstr("csv:2: not a table of events: expected 19 finite values"));
  put(file(), history_header + "\n");
  EXPECT_THAT(message_of([&] { read_events(file()); }), HasSubstr("csv:1: not a table of events"));
}

TEST_F(Store, SeriesListsFramesForParaView) {
  const fs::path file = folder_ / "frames.hdf.series";
  const std::vector<SeriesEntry> entries{{"frame_0000.hdf", 0}, {"fr\"ame.hdf", 1.25e-4}};
  write_series(file, entries);
  EXPECT_EQ(content_of(file), R"({
  "file-series-version": "1.0",
  "files": [
    {"name": "frame_0000.hdf", "time": 0},
    {"name": "fr\"ame.hdf", "time": 0.000125}
  ]
}
)");
  const std::vector<SeriesEntry> bad{{"frame_0000.hdf", nan}};
  EXPECT_THAT(message_of([&] { write_series(file, bad); }),
              HasSubstr("the time of frame_0000.hdf is nan"));
  EXPECT_EQ(files(), 1u);
}

TEST_F(Store, TextAppearsWholeOrNotAtAll) {
  const fs::path file = folder_ / "summary.json";
  write_text_atomically(file, "first");
  {
    const FileSizeLimit limit(100);
    EXPECT_THROW(write_text_atomically(file, std::string(1000, 'x')), StoreError);
  }
  EXPECT_EQ(content_of(file), "first");
  write_text_atomically(file, "");
  EXPECT_EQ(content_of(file), "");
  EXPECT_EQ(files(), 1u);
}

} // namespace
} // namespace lamella
