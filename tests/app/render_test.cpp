#include "render/run_pictures.h"

#include "render/cross_section.h"
#include "render/energy_plot.h"
#include "render/labels.h"
#include "render/membrane_view.h"
#include "render/occlusion.h"
#include "render/phases.h"
#include "render/studio.h"
#include "render/style.h"
#include "render/surface.h"
#include "render/tradeoff_plot.h"
#include "render/units.h"
#include "scene/scene_toml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <unistd.h>

namespace lamella::render {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

template <class Phi>
Frame frame_of(Phi&& phi, double time = 0, Grid grid = Grid::cube(48, 1)) {
  Frame frame{grid, time, std::vector<double>(grid.size())};
  for (std::size_t n = 0; n < grid.size(); ++n) frame.phi[n] = phi(grid.position(n));
  return frame;
}

Frame sphere(double radius, Vec3 center = {}, double time = 0) {
  return frame_of(
      [=](const Vec3& p) {
        return std::hypot(p[0] - center[0], p[1] - center[1], p[2] - center[2]) - radius;
      },
      time);
}

/// A sphere around the origin with a cap of Ld of so many radians around the z axis, in distances
/// that level off as the engine's do.
Frame capped_sphere(double radius, double cap_angle) {
  Frame frame = sphere(radius);
  for (std::size_t n = 0; n < frame.grid.size(); ++n) {
    const auto [x, y, z] = frame.grid.position(n);
    const double distance = radius * (std::atan2(std::hypot(x, y), z) - cap_angle);
    frame.fields["psi"].push_back(0.3 * std::tanh(distance / 0.3));
  }
  return frame;
}

std::vector<Measures> falling_energy(int rows, double end) {
  std::vector<Measures> history(rows);
  for (int n = 0; n < rows; ++n) {
    history[n].time = end * n / (rows - 1);
    history[n].energy = 40 + 30 * std::exp(-5.0 * n / (rows - 1));
  }
  return history;
}

/// A history with these energies of the phases, which fall too.
std::vector<Measures> with_phases(std::vector<Measures> history, const PhaseMeasures& start,
                                  double gaussian) {
  for (Measures& row : history) {
    const double rest = row.energy / history.front().energy;
    row.phases = start;
    row.terms[Term::line_tension] = start.line_energy;
    row.terms[Term::gaussian] = gaussian;
    for (double* x : {&row.phases->bending_energy_Ld, &row.phases->bending_energy_Lo,
                      &*row.terms[Term::line_tension], &*row.terms[Term::gaussian]})
      *x *= rest;
  }
  return history;
}

double brightness(const Color& c) { return (c.r + c.g + c.b) / 3.0; }

int count_pixels(const Picture& picture, const Color& wanted) {
  return int(std::count(picture.pixels.begin(), picture.pixels.end(), wanted));
}

template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

/// All tests run as a batch job does: without a display.
class Render : public testing::Test {
protected:
  void SetUp() override {
    unsetenv("DISPLAY");
    folder_ = fs::temp_directory_path() / ("lamella-render-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

/// A picture of 400 x 400 pixels on white, 200 to the length of the box.
Picture view_of(const Surface& surface, const std::string& backend, double elevation = 30) {
  Studio studio(backend);
  const auto view = membrane_view(surface, Viewpoint(elevation), {0, 0}, 2, 0.02);
  Sheet sheet(400, 400);
  sheet.picture({0, 0, 400, 400}, studio.shoot(*view, 400, 400));
  return print(sheet, 400);
}

/// The two states side by side with their sections, 1050 pixels wide.
Picture figure_of(const Surface& start, const Surface& end) {
  Studio studio("auto");
  Page page(2100);
  page.add(std::make_unique<Strip>(Heading{}, std::vector{start, end}, View{.section = true}));
  return print(page.draw({studio, 0.5}), 1050);
}

/// 700 pixels wide.
Picture picture_of(const Plot& plot) { return print(sheet_of(plot), 700); }

/// A folder as a run leaves it.
void store_run(const fs::path& folder, const std::vector<Frame>& frames,
               const std::vector<Measures>& history) {
  fs::create_directories(folder / "frames");
  std::ofstream(folder / "scene.toml") << to_toml(Scene{});
  HistoryWriter writer(folder / "history.csv");
  for (const Measures& row : history) writer.add(row);
  std::vector<SeriesEntry> series;
  for (const Frame& frame : frames) {
    series.push_back({"frame_000" + std::to_string(series.size()) + ".hdf", frame.time});
    write_frame(folder / "frames" / series.back().file, frame);
  }
  write_series(folder / "frames" / "frames.hdf.series", series);
}

class Backend : public Render, public testing::WithParamInterface<const char*> {};

TEST_P(Backend, shows_a_sphere_as_a_lit_disc_of_the_right_size) {
  const Picture picture = view_of(extract_surface(sphere(0.5)), GetParam());
  const int covered = int(picture.pixels.size()) - count_pixels(picture, {255, 255, 255});
  const double disc = std::numbers::pi * 100 * 100;
  EXPECT_NEAR(covered, disc, 0.015 * disc); // the rim's half-covered pixels count as covered

  EXPECT_GT(brightness(picture.at(170, 150)), 130) << "the side of the key light";
  EXPECT_LT(brightness(picture.at(240, 270)), brightness(picture.at(170, 150)) - 20) << "the other";
  const Color middle = picture.at(200, 200);
  EXPECT_GT(middle.r, middle.g + 40) << "the membrane is red";
}

INSTANTIATE_TEST_SUITE_P(Offscreen, Backend, testing::Values("auto", "osmesa", "egl"));

constexpr double from_above = 90; ///< along z

bool is_red(const Color& c) { return c.r > c.b + 25; }
bool is_blue(const Color& c) { return c.b > c.r + 25; }

TEST_F(Render, colours_phases_to_either_side_of_a_dark_line) {
  const double angle = 0.9, rim = 100 * std::sin(angle); // pixels
  const Picture picture = view_of(extract_surface(capped_sphere(0.5, angle)), "auto", from_above);
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x) {
      const double distance = std::hypot(x - 199.5, y - 199.5), line = 2 + 1; // half, and a pixel
      const Color c = picture.at(x, y);
      if (distance < rim - line) {
        ASSERT_TRUE(is_red(c)) << x << ' ' << y;
      } else if (std::abs(distance - rim) < 0.5) {
        ASSERT_EQ(c, style::ink) << x << ' ' << y;
      } else if (distance > rim + line && distance < 100 - 1) {
        ASSERT_TRUE(is_blue(c)) << x << ' ' << y;
      } else if (distance > 100 + 1) {
        ASSERT_EQ(c, (Color{255, 255, 255})) << x << ' ' << y;
      }
    }
}

TEST_F(Render, hides_the_phase_behind) {
  const double behind = std::numbers::pi - 0.9;
  const Picture picture = view_of(extract_surface(capped_sphere(0.5, behind)), "auto", from_above);
  EXPECT_GT(std::ranges::count_if(picture.pixels, is_red), 31000);
  EXPECT_EQ(std::ranges::count_if(picture.pixels, is_blue), 0);
  EXPECT_EQ(count_pixels(picture, style::ink), 0);
}

TEST_F(Render, cuts_phases_apart_exactly_also_through_nodes) {
  Frame frame = sphere(0.5);
  const double plane = // through nodes of the lattice that is four times as fine
      frame.grid.position(frame.grid.index(0, 0, 26))[2] + frame.grid.spacing / 8;
  for (std::size_t n = 0; n < frame.grid.size(); ++n)
    frame.fields["psi"].push_back(frame.grid.position(n)[2] - plane);
  const std::vector<Patch> both = patches(*extract_surface(frame).mesh);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].part, Part::Ld);
  std::array<double, 6> bounds{};
  both[0].mesh->GetCellsBounds(bounds.data());
  EXPECT_NEAR(bounds[5], plane, 1e-6);
  EXPECT_EQ(both[1].part, Part::Lo);
  both[1].mesh->GetCellsBounds(bounds.data());
  EXPECT_NEAR(bounds[4], plane, 1e-6);
  EXPECT_GT(count_pixels(view_of(extract_surface(frame), "auto"), style::ink), 500);
}

TEST_F(Render, draws_a_membrane_that_one_of_two_phases_has_left) {
  Frame frame = sphere(0.5);
  frame.fields["psi"].assign(frame.grid.size(), 0.3);
  const Surface surface = extract_surface(frame);
  const Picture picture = view_of(surface, "auto");
  EXPECT_GT(std::ranges::count_if(picture.pixels, is_blue), 30000);
  EXPECT_EQ(std::ranges::count_if(picture.pixels, is_red), 0);
  EXPECT_EQ(count_pixels(picture, style::ink), 0);
  const auto lines = cross_section(surface);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].closed && lines[0].part == Part::Lo);
}

TEST_F(Render, says_which_backends_there_are) {
  EXPECT_THAT(error_of([] { Studio studio("metal"); }),
              AllOf(HasSubstr("\"metal\""), HasSubstr("auto, osmesa, egl or x")));
}

TEST_F(Render, says_that_a_display_is_missing) {
  EXPECT_THAT(error_of([] { Studio studio("x"); }), HasSubstr("DISPLAY is not set"));
}

TEST_F(Render, cuts_a_sphere_in_a_circle) {
  const auto lines = cross_section(extract_surface(sphere(0.5, {0.1, -0.2, 0.05})));
  ASSERT_EQ(lines.size(), 1u);
  for (const Vec2& p : lines[0].points) EXPECT_NEAR(std::hypot(p[0] - 0.1, p[1] - 0.05), 0.5, 2e-4);
}

TEST_F(Render, cuts_a_torus_in_two_circles) {
  const auto torus = [](const Vec3& p) {
    return std::hypot(std::hypot(p[0], p[1]) - 0.5, p[2]) - 0.2;
  };
  const auto lines = cross_section(extract_surface(frame_of(torus)));
  ASSERT_EQ(lines.size(), 2u);
  for (const Outline& line : lines)
    for (const Vec2& p : line.points)
      EXPECT_NEAR(std::hypot(std::abs(p[0]) - 0.5, p[1]), 0.2, 1e-3);
}

TEST_F(Render, cuts_a_section_where_phases_meet) {
  const double angle = 0.9;
  const auto lines = cross_section(extract_surface(capped_sphere(0.5, angle)));
  ASSERT_EQ(lines.size(), 2u);
  for (const Outline& line : lines) {
    EXPECT_FALSE(line.closed);
    for (const Vec2& p : line.points) {
      const double from_top = std::atan2(std::abs(p[0]), p[1]);
      EXPECT_NEAR(std::hypot(p[0], p[1]), 0.5, 5e-4);
      if (line.part == Part::Ld) {
        EXPECT_LT(from_top, angle + 1e-3);
      } else {
        EXPECT_GT(from_top, angle - 1e-3);
      }
    }
    for (const Vec2& end : {line.points.front(), line.points.back()})
      EXPECT_NEAR(std::atan2(std::abs(end[0]), end[1]), angle, 1e-3);
  }
  EXPECT_NE(lines[0].part, lines[1].part);
}

TEST_F(Render, finds_a_section_where_the_middle_is_empty) {
  const auto pair = [](const Vec3& p) {
    return std::hypot(p[0], std::abs(p[1]) - 0.5, p[2]) - 0.3;
  };
  EXPECT_EQ(cross_section(extract_surface(frame_of(pair))).size(), 1u);
}

TEST_F(Render, says_that_there_is_no_membrane) {
  const Frame empty = frame_of([](const Vec3&) { return 1.0; }, 2e-3);
  EXPECT_THAT(error_of([&] { extract_surface(empty); }),
              AllOf(HasSubstr("no membrane"), HasSubstr("2x10^-3")));
}

TEST_F(Render, shades_hollows_and_not_what_bulges_out) {
  const auto torus = [](const Vec3& p) {
    return std::hypot(std::hypot(p[0], p[1]) - 0.4, p[2]) - 0.25;
  };
  const Frame frame = frame_of(torus);
  const Occlusion occlusion(frame, 0.1);
  EXPECT_EQ(occlusion.at({0.65, 0, 0}, {1, 0, 0}), 0) << "the outer equator";
  EXPECT_GT(occlusion.at({0.15, 0, 0}, {-1, 0, 0}), 0.2) << "the hole";
}

TEST_F(Render, draws_the_sections_below_the_views) {
  const Picture figure = figure_of(extract_surface(sphere(0.5)), extract_surface(sphere(0.4)));
  EXPECT_EQ(figure.width, 1050);
  int above = 0, below = 0; // pixels of the sections' line
  for (int y = 0; y < figure.height; ++y)
    for (int x = 0; x < figure.width; ++x)
      if (figure.at(x, y) == style::membrane.line) ++(2 * y < figure.height ? above : below);
  EXPECT_EQ(above, 0);
  EXPECT_GT(below, 3000);
}

TEST_F(Render, names_the_colours_of_phases_where_there_are_some) {
  const Surface one = extract_surface(sphere(0.5)), two = extract_surface(capped_sphere(0.5, 0.9));
  const auto legend = [&](const Surface& start, const Surface& end) { // Ld left of Lo, at the foot
    const Picture figure = figure_of(start, end);
    int Ld = 0, Lo = 0;
    for (int y = figure.height - 60; y < figure.height; ++y)
      for (int x = 0; x < figure.width; ++x) {
        if (figure.at(x, y) == style::Ld.surface) ++Ld;
        if (figure.at(x, y) == style::Lo.surface) ++Lo;
      }
    return std::pair(Ld > 150, Lo > 150);
  };
  EXPECT_EQ(legend(one, one), std::pair(false, false));
  EXPECT_EQ(legend(one, two), std::pair(true, true));
}

TEST_F(Render, draws_sections_in_the_colours_of_phases) {
  const double angle = 0.9, part = angle / std::numbers::pi; // of the outline in Ld
  const Surface surface = extract_surface(capped_sphere(0.5, angle));
  const Picture figure = figure_of(surface, surface);
  const double Ld = count_pixels(figure, style::Ld.line), Lo = count_pixels(figure, style::Lo.line);
  EXPECT_NEAR(Ld / (Ld + Lo), part, 0.02);
  EXPECT_GT(Ld + Lo, 4000);
}

TEST_F(Render, plots_the_energy_from_end_to_end) {
  const Picture plot = picture_of(energy_plot(falling_energy(200, 1.6e-3), Units()));
  EXPECT_EQ(plot.height, 525);
  std::vector<int> columns; // that the curve runs through
  for (int x = 0; x < plot.width; ++x)
    for (int y = 0; y < plot.height; ++y)
      if (plot.at(x, y) == style::membrane.line) {
        columns.push_back(x);
        break;
      }
  ASSERT_FALSE(columns.empty());
  EXPECT_LT(columns.front(), 140);
  EXPECT_GT(columns.back(), 650);
  EXPECT_EQ(int(columns.size()), columns.back() - columns.front() + 1) << "no gaps";
}

TEST_F(Render, plots_the_terms_of_the_energy_that_are_there) {
  const auto shows = [&](const std::vector<Measures>& history) {
    const Picture plot = picture_of(energy_plot(history, Units()));
    std::vector<bool> there;
    for (const Color& color : {style::membrane.line, style::Lo.line, style::line_energy,
                               style::of_term(Term::gaussian), style::of_term(Term::stretch)})
      there.push_back(count_pixels(plot, color) > 1000);
    return there;
  };
  const std::vector<Measures> plain = falling_energy(200, 1.6e-3);
  EXPECT_THAT(shows(plain), ElementsAre(true, false, false, false, false));
  PhaseMeasures phases;
  phases.bending_energy_Ld = 30, phases.bending_energy_Lo = 15, phases.line_energy = 25;
  EXPECT_THAT(shows(with_phases(plain, phases, 0)), ElementsAre(true, true, true, false, false));
  std::vector<Measures> all = with_phases(plain, phases, -12);
  for (Measures& row : all) row.terms[Term::stretch] = 5;
  EXPECT_THAT(shows(all), ElementsAre(true, true, true, true, true));
}

TEST(EnergyPlot, has_a_colour_for_each_term) {
  std::vector<Measures> history =
      with_phases(falling_energy(5, 1), {.bending_energy_Ld = 1, .bending_energy_Lo = 2}, 3);
  int off_boundary = 0;
  for (const TermInfo& term : energy_term_table) {
    if (term.seat != Seat::boundary) off_boundary++;
    for (Measures& row : history) row.terms[term.term] = 5;
  }
  const std::vector<Series> series = energy_plot(history, Units()).series;
  EXPECT_EQ(int(series.size()), off_boundary + 3) << "bending of both, the boundary, the whole";
  for (std::size_t a = 0; a < series.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_NE(series[a].color, series[b].color) << series[a].name << " and " << series[b].name;
}

TEST(EnergyPlot, is_in_the_units_beside_its_axes) {
  const std::vector<Measures> history = falling_energy(5, 2e-3);
  Scene scene;
  scene.membrane.bending_modulus = 25;
  const Plot plot = energy_plot(history, Units(scene));
  EXPECT_EQ(plot.x.title, "time *t* / (*ζL*⁴/*κ*)");
  EXPECT_EQ(plot.y.title, "energy *E* / *κ*");
  const auto& [t, E] = plot.series[0].points.back();
  EXPECT_DOUBLE_EQ(t, 2e-3 * 25);
  EXPECT_DOUBLE_EQ(E, history.back().energy / 25);
}

TEST(Units, are_written_beside_what_they_measure) {
  const auto title = [](const char* name) { return notation_of(name).title(Units()); };
  EXPECT_EQ(title("t"), "time *t* / (*ζL*⁴/*κ*)");
  EXPECT_EQ(title("energy"), "energy *E* / *κ*");
  EXPECT_EQ(title("int_KM2"), "∫ *K*_{M}² d*A*");
  EXPECT_EQ(title("P"), "pressure *P* / (*κ*/*L*³)");
  EXPECT_EQ(title("K_multiplier"), "multiplier *q* / (*κ*/*L*)");
  EXPECT_EQ(title("line_radius"), "radius of the boundary / *L*");
  EXPECT_EQ(title("max_speed"), "largest speed / (*κ*/*ζL*³)");
  EXPECT_EQ(title("K_M"), "*K*_{M} / *L*⁻¹");
  EXPECT_EQ(title("K"), "*K* / *L*⁻²");
}

TEST(Units, name_the_phase_whose_modulus_they_take) {
  Scene scene;
  scene.membrane.bending_modulus = 3;
  EXPECT_EQ(Units(scene).kappa, 3);
  scene.domains.kind = DomainsKind::cap;
  scene.ld.bending_modulus = scene.lo.bending_modulus = 25;
  EXPECT_EQ(Units(scene).kappa, 25);
  EXPECT_EQ(time_label(2e-3, Units(scene)), "*t* = 0.05 *ζL*⁴/*κ*");
  EXPECT_EQ(time_label(0, Units(scene)), "*t* = 0");
  scene.lo.bending_modulus = 125;
  EXPECT_EQ(time_label(2e-3, Units(scene)), "*t* = 0.05 *ζL*⁴/*κ*_{Ld}");
  scene.lo.bending_modulus = 5;
  EXPECT_EQ(Units(scene).kappa, 5);
  EXPECT_EQ(notation_of("max_line_speed").unit(Units(scene)), "*κ*_{Lo}/*ζL*³");
  EXPECT_EQ(common(Units(scene), Units()).kappa_symbol, "*κ*") << "that of each";
}

TEST_F(Render, plots_one_row_and_steady_energies_but_not_nothing) {
  std::vector<Measures> steady = falling_energy(20, 1);
  for (Measures& row : steady) row.energy = 8 * std::numbers::pi;
  Units tiny;
  tiny.kappa = 1e-20;
  EXPECT_NO_THROW(picture_of(energy_plot(steady, Units())));
  EXPECT_NO_THROW(picture_of(energy_plot(falling_energy(20, 1.0), tiny)));
  EXPECT_NO_THROW(picture_of(energy_plot({Measures{}}, Units())));
  EXPECT_THAT(error_of([&] { energy_plot({}, Units()); }), HasSubstr("nothing to plot"));
}

TEST_F(Render, plots_error_against_time) {
  const std::vector<Trade> trades{{{32, 32, 32}, 0.2, 3e-3, true, ""},
                                  {{64, 64, 64}, 1.5, 1e-3, true, "standard"},
                                  {{64, 64, 64}, 3, 2e-3, false, ""},
                                  {{64, 64, 64}, 4, std::nan(""), false, ""}};
  const Picture plot = picture_of(tradeoff_plot(trades));
  EXPECT_EQ(plot.height, 525);
  const auto count = [&](Color color) { return count_pixels(plot, color); };
  EXPECT_GT(count({244, 166, 120}), 100) << "the coarse grid's dot and label";
  EXPECT_GT(count({96, 20, 44}), 200) << "the fine grid's dots, line and label";
  EXPECT_THAT(error_of([&] { tradeoff_plot(std::span(trades).last(1)); }),
              HasSubstr("nothing to plot"));
}

TEST_F(Render, writes_all_pictures_of_a_run) {
  store_run(folder_, {sphere(0.5), sphere(0.4, {}, 1e-3)}, falling_energy(50, 1e-3));
  const std::map<std::string, std::string> signatures{
      {"png", "\x89PNG"}, {"pdf", "%PDF"}, {"svg", "<?xml"}};
  PictureOptions options;
  options.width = 600;
  for (const auto& [format, signature] : signatures) {
    options.format = format;
    const auto files = draw_run(StoredStates(folder_), folder_, options);
    EXPECT_THAT(files, ElementsAre(folder_ / ("figure." + format), folder_ / ("energy." + format)));
    for (const fs::path& file : files) {
      std::ifstream in(file, std::ios::binary);
      std::string begin(signature.size(), ' ');
      in.read(begin.data(), std::streamsize(begin.size()));
      EXPECT_EQ(begin, signature) << file;
    }
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 9) << "nothing else is left behind";
}

TEST_F(Render, says_that_a_folder_cannot_be_written_to) {
  store_run(folder_, {sphere(0.5)}, falling_energy(5, 1));
  PictureOptions small;
  small.width = 600;
  const auto into = [&](const fs::path& where) {
    return error_of([&] { draw_run(StoredStates(folder_), where, small); });
  };
  EXPECT_THAT(into(folder_ / "missing"),
              AllOf(HasSubstr("missing"), HasSubstr("No such file or directory")));
  EXPECT_THAT(into("/dev/null"), HasSubstr("Not a directory"));
}

TEST_F(Render, leaves_the_background_out_where_asked) {
  Sheet sheet(100, 100);
  sheet.disc({50, 50}, 20, style::ink);
  EXPECT_EQ(print(sheet, 100).at(2, 2), (Color{255, 255, 255, 255}));
  EXPECT_EQ(print(sheet, 100, Background::transparent).at(2, 2).a, 0);
  EXPECT_EQ(print(sheet, 100, Background::transparent).at(50, 50), style::ink);
}

TEST_F(Render, keeps_letters_and_lines_in_vectors) {
  const Sheet sheet = sheet_of(energy_plot(falling_energy(50, 1e-3), Units()));
  write_sheet(folder_ / "plot.svg", sheet);
  std::ifstream in(folder_ / "plot.svg");
  const std::string svg{std::istreambuf_iterator<char>(in), {}};
  EXPECT_THAT(svg, AllOf(HasSubstr(">time <"), HasSubstr(">ζ<"), HasSubstr("<polyline")));
  EXPECT_THAT(svg, testing::Not(HasSubstr("<image")));
}

TEST_F(Render, turns_the_eye_around) {
  const Frame frame = frame_of([](const Vec3& p) {
    return std::hypot(p[0] / 2, p[1], p[2]) - 0.3; // long along x
  });
  const Surface surface = extract_surface(frame);
  EXPECT_NEAR(view_extent(surface, Viewpoint(0, 0)).width(), 1.2, 0.01);
  EXPECT_NEAR(view_extent(surface, Viewpoint(0, 90)).width(), 0.6, 0.01);
  EXPECT_NEAR(extent_of(cross_section(surface, 0)).width(), 1.2, 0.01);
  EXPECT_NEAR(extent_of(cross_section(surface, 90)).width(), 0.6, 0.01);
}

TEST_F(Render, colours_a_sphere_by_its_curvature) {
  const State state{sphere(0.5)};
  const Surface surface = extract_surface(state, Quantity::K_M);
  const ValueRange range = range_of(Quantity::K_M, {surface});
  EXPECT_NEAR(range.low, -4, 0.02);
  EXPECT_NEAR(range.high, 4, 0.02);
  const Palette palette(Quantity::K_M, range);
  EXPECT_TRUE(is_blue(palette.at(-4)));
  EXPECT_TRUE(is_red(palette.at(4)));
  EXPECT_THAT(error_of([&] { extract_surface(state, Quantity::c); }),
              HasSubstr("[stretch] modulus"));
}

TEST_F(Render, colours_in_the_unit_of_the_bar) {
  State soft{sphere(0.5)}, stiff = soft;
  stiff.scene.membrane.bending_modulus = 25;
  stiff.measures.sigma = 25 * (soft.measures.sigma = 3);
  for (const Quantity quantity : {Quantity::K_M, Quantity::energy_density, Quantity::velocity}) {
    const ValueRange a = range_of(quantity, {extract_surface(soft, quantity)});
    const ValueRange b = range_of(quantity, {extract_surface(stiff, quantity)});
    EXPECT_NEAR(b.high, a.high, 1e-9 * std::abs(a.high)) << quantity.name;
    EXPECT_NEAR(b.low, a.low, 1e-9 * std::abs(a.low)) << quantity.name;
  }
}

TEST(Labels, numbers_read_as_in_print) {
  EXPECT_EQ(number(0), "0");
  EXPECT_EQ(number(1.6e-3), "1.6×10⁻³");
  EXPECT_EQ(number(1.5999999e-3), "1.6×10⁻³");
  EXPECT_EQ(number(0.021), "0.021");
  EXPECT_EQ(number(-1.25), "−1.25");
  EXPECT_EQ(number(2e12), "2×10¹²");
  EXPECT_EQ(plain(number(-1.6e-13)), "-1.6x10^-13");
}

const LabelRoom wide{1000, [](const std::string&) { return 80.0; }};

std::vector<std::string> named(Ticks ticks) {
  std::erase(ticks.labels, "");
  return ticks.labels;
}

TEST(Labels, ticks_are_round) {
  const Ticks energies = linear_ticks(46.5, 80.1, wide);
  EXPECT_THAT(energies.labels, ElementsAre("50", "60", "70", "80"));
  const Ticks times = linear_ticks(0, 1.6e-3, wide);
  EXPECT_THAT(times.labels, ElementsAre("0", "0.5", "1.0", "1.5"));
  EXPECT_EQ(times.exponent, -3);
  EXPECT_THAT(linear_ticks(-2, 1, wide).labels, ElementsAre("−2", "−1", "0", "1"));
}

TEST(Labels, logarithmic_ticks_have_labels_enough) {
  EXPECT_THAT(named(log_ticks(-0.4, 1.1, wide)), ElementsAre("0.5", "1", "2", "5", "10"));
  EXPECT_THAT(named(log_ticks(-5.1, -1.9, wide)), ElementsAre("10⁻⁵", "10⁻⁴", "10⁻³", "10⁻²"));
  EXPECT_THAT(named(log_ticks(-1.65, -1.31, wide)), ElementsAre("0.03", "0.04"))
      << "neither 1, 2 nor 5";
  EXPECT_EQ(log_ticks(0, 1, wide).positions.size(), 10u);
}

TEST(Labels, are_fewer_where_they_would_collide) {
  const auto within = [](double axis) {
    return LabelRoom{axis, [](const std::string&) { return 80.0; }};
  };
  EXPECT_THAT(named(linear_ticks(0, 1.6e-3, within(200))), ElementsAre("0", "1"));
  EXPECT_THAT(linear_ticks(-2, 1, within(200)).labels, ElementsAre("−2", "", "0", ""));
  EXPECT_THAT(linear_ticks(1, 3, within(200)).labels, ElementsAre("1", "", "2", "", "3"));
  EXPECT_THAT(named(log_ticks(-7.5, -2.8, within(300))), ElementsAre("10⁻⁷", "10⁻⁵", "10⁻³"));
  EXPECT_THAT(named(log_ticks(-0.1, 1.9, within(200))), ElementsAre("1", "10"));
}

TEST(Labels, stay_apart_whatever_the_range) {
  std::mt19937 random(5);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  const auto width = [](const std::string& label) { return 30.0 * plain(label).size(); };
  constexpr double widest = 30 * 8;
  for (int n = 0; n < 4000; ++n) {
    const bool logarithmic = n % 2 == 1;
    const double axis = std::pow(10, between(1.7, 3.3));
    const double low =
        logarithmic ? between(-12, 8) : between(-3, 3) * std::pow(10, between(-9, 9));
    const double extent = logarithmic
                              ? between(0.5, 12)
                              : std::max(std::abs(low), 1e-9) * std::pow(10, between(-1.5, 2));
    const double high = low + extent;
    const LabelRoom room{axis, width};
    const Ticks ticks = logarithmic ? log_ticks(low, high, room) : linear_ticks(low, high, room);
    ASSERT_EQ(ticks.labels.size(), ticks.positions.size());
    const auto place = [&](double position) {
      return axis * ((logarithmic ? std::log10(position) : position) - low) / extent;
    };
    double taken = -1e9;
    for (std::size_t i = 0; i < ticks.labels.size(); ++i) {
      if (ticks.labels[i].empty()) continue;
      const double middle = place(ticks.positions[i]), half = width(ticks.labels[i]) / 2;
      ASSERT_GE(middle - half, taken) << ticks.labels[i] << " from " << low << " to " << high;
      taken = middle + half;
    }
    ASSERT_GE(named(ticks).size(), axis > 3 * widest ? 2u : 1u)
        << "from " << low << " to " << high << " on " << axis;
  }
}

} // namespace
} // namespace lamella::render
