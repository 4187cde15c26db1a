#include "extremes/cases.h"

#include "scene/builtin.h"

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace lamella {

namespace {

constexpr bool quick = true;

// fig3_oblate is an oblate of v = 0.6 and semi-axis 0.7 in a box from -1 to 1 of 64^3 nodes, to t =
// 1.6e-3.
constexpr ExtremeCase cases[] = {
    // Reduced volumes on the oblate branch. Below v = 0.503 the exact discocyte meets itself.
    {"oblate v = 0.25",
     "fig3_oblate shape.semi_axis=0.9 shape.reduced_volume=0.25 run.end_time=0.02", Known::nothing,
     quick},
    {"oblate v = 0.25, 112^3",
     "fig3_oblate shape.semi_axis=0.9 shape.reduced_volume=0.25 grid.nodes=112 run.end_time=0.02"},
    {"oblate v = 0.40",
     "fig3_oblate shape.semi_axis=0.9 shape.reduced_volume=0.4 run.end_time=0.02", Known::nothing,
     quick},
    {"oblate v = 0.50",
     "fig3_oblate shape.semi_axis=0.85 shape.reduced_volume=0.5 run.end_time=0.02", Known::oblate,
     quick},
    {"oblate v = 0.55",
     "fig3_oblate shape.semi_axis=0.85 shape.reduced_volume=0.55 run.end_time=0.02 "
     "stop.energy_rate=0.01",
     Known::oblate},
    {"oblate v = 0.60", "fig3_oblate run.end_time=0.02 stop.energy_rate=0.01", Known::oblate,
     quick},
    {"oblate v = 0.70",
     "fig3_oblate shape.reduced_volume=0.7 run.end_time=0.02 stop.energy_rate=0.01", Known::oblate},
    {"oblate v = 0.80",
     "fig3_oblate shape.reduced_volume=0.8 run.end_time=0.02 stop.energy_rate=0.01", Known::oblate},
    {"oblate v = 0.90",
     "fig3_oblate shape.reduced_volume=0.9 run.end_time=0.02 stop.energy_rate=0.01", Known::oblate},
    {"oblate v = 0.95",
     "fig3_oblate shape.reduced_volume=0.95 run.end_time=0.02 stop.energy_rate=0.01",
     Known::oblate},
    {"oblate v = 0.99",
     "fig3_oblate shape.reduced_volume=0.99 run.end_time=0.02 stop.energy_rate=0.01", Known::oblate,
     quick},

    // On the prolate branch. The spheroids of small reduced volume have tips that no grid
    // resolves; a longer box and a milder start, deflated, lead to their tubes.
    {"prolate v = 0.25",
     "fig3_oblate shape.kind=prolate shape.semi_axis=0.9 shape.reduced_volume=0.25", Known::prolate,
     quick},
    {"prolate v = 0.25, deflated",
     "fig3_oblate shape.kind=prolate shape.semi_axis=1.31 shape.reduced_volume=0.6 "
     "grid.half_width=0.375 grid.nodes=[24,24,208] volume.constraint=ramped volume.targets=0.25 "
     "volume.rate=20 run.end_time=0.1 stop.energy_rate=0.1",
     Known::prolate},
    {"prolate v = 0.36, deflated",
     "fig3_oblate shape.kind=prolate shape.semi_axis=1.31 shape.reduced_volume=0.6 "
     "grid.half_width=0.375 grid.nodes=[24,24,152] volume.constraint=ramped volume.targets=0.36 "
     "volume.rate=20 run.end_time=0.1 stop.energy_rate=0.1",
     Known::prolate},
    {"prolate v = 0.40, deflated",
     "fig3_oblate shape.kind=prolate shape.semi_axis=1.31 shape.reduced_volume=0.6 "
     "grid.half_width=0.375 grid.nodes=[24,24,128] volume.constraint=ramped volume.targets=0.4 "
     "volume.rate=20 run.end_time=0.1 stop.energy_rate=0.1",
     Known::prolate, quick},
    {"prolate v = 0.50",
     "fig3_oblate shape.kind=prolate shape.semi_axis=0.9 shape.reduced_volume=0.5 "
     "run.end_time=0.02 stop.energy_rate=0.1",
     Known::prolate, quick},
    {"prolate v = 0.60",
     "fig3_oblate shape.kind=prolate shape.semi_axis=0.9 shape.reduced_volume=0.6 "
     "run.end_time=0.03 stop.energy_rate=0.1",
     Known::prolate},
    {"prolate v = 0.70",
     "fig3_oblate shape.kind=prolate shape.semi_axis=0.85 shape.reduced_volume=0.7 "
     "run.end_time=0.03 stop.energy_rate=0.02",
     Known::prolate},
    {"prolate v = 0.80",
     "fig3_oblate shape.kind=prolate shape.semi_axis=0.8 shape.reduced_volume=0.8 "
     "run.end_time=0.05 stop.energy_rate=0.02",
     Known::prolate},
    {"prolate v = 0.90",
     "fig3_oblate shape.kind=prolate shape.semi_axis=0.8 shape.reduced_volume=0.9 "
     "run.end_time=0.05 stop.energy_rate=0.02",
     Known::prolate},
    {"prolate v = 0.95",
     "fig3_oblate shape.kind=prolate shape.semi_axis=0.8 shape.reduced_volume=0.95 "
     "run.end_time=0.05 stop.energy_rate=0.01",
     Known::prolate},
    {"prolate v = 0.99",
     "fig3_oblate shape.kind=prolate shape.semi_axis=0.7 shape.reduced_volume=0.99 "
     "run.end_time=0.05 stop.energy_rate=0.01",
     Known::prolate, quick},
    {"sphere", "sphere", Known::sphere, quick},

    // Spontaneous curvature: buds of radius 2 / |C| on one side, a film of inner fluid on the
    // other.
    {"C = -100", "fig3_oblate membrane.spontaneous_curvature=-100", Known::nothing, quick},
    {"C = -100, 200^3, few steps",
     "fig3_oblate membrane.spontaneous_curvature=-100 grid.nodes=200 run.end_time=1e-8"},
    {"C = -60, 120^3",
     "fig3_oblate membrane.spontaneous_curvature=-60 grid.nodes=120 run.end_time=5e-5"},
    {"C = -30", "fig3_oblate membrane.spontaneous_curvature=-30 run.end_time=4e-4"},
    {"C = -10", "fig3_oblate membrane.spontaneous_curvature=-10", Known::nothing, quick},
    {"C = 10", "fig3_oblate membrane.spontaneous_curvature=10", Known::nothing, quick},
    {"C = 30", "fig3_oblate membrane.spontaneous_curvature=30"},
    {"C = 60", "fig3_oblate membrane.spontaneous_curvature=60", Known::nothing, quick},
    {"C = 60, 120^3",
     "fig3_oblate membrane.spontaneous_curvature=60 grid.nodes=120 run.end_time=5e-5"},

    // Pressure: squeezes the vesicle until its sheets meet.
    {"P = -200", "fig3_oblate volume.constraint=free volume.pressure=-200", Known::nothing},
    {"P = -1000", "fig3_oblate volume.constraint=free volume.pressure=-1000", Known::nothing,
     quick},
    {"P = -2000", "fig3_oblate volume.constraint=free volume.pressure=-2000"},
    {"P = -5000", "fig3_oblate volume.constraint=free volume.pressure=-5000", Known::nothing,
     quick},
    {"P = -5000, 72^3", "fig3_oblate volume.constraint=free volume.pressure=-5000 grid.nodes=72"},

    // The scheme's own knobs.
    {"tolerance x 0.1", "fig3_oblate numerics.tolerance=0.0005", Known::relaxation},
    {"tolerance x 4", "fig3_oblate numerics.tolerance=0.02", Known::relaxation},
    {"tolerance x 20", "fig3_oblate numerics.tolerance=0.1", Known::relaxation, quick},
    {"16^3", "fig3_oblate grid.nodes=16", Known::relaxation, quick},
    {"16^3, prolate v = 0.90",
     "fig3_oblate grid.nodes=16 shape.kind=prolate shape.semi_axis=0.6 shape.reduced_volume=0.9 "
     "run.end_time=0.05 stop.energy_rate=0.02",
     Known::prolate, quick},
    {"24^3", "fig3_oblate grid.nodes=24", Known::relaxation, quick},
    {"32^3", "fig3_oblate grid.nodes=32", Known::relaxation, quick},
    {"48^3", "fig3_oblate grid.nodes=48", Known::relaxation},
    {"96^3", "fig3_oblate grid.nodes=96", Known::relaxation},
    {"128^3, to t = 1e-4", "fig3_oblate grid.nodes=128 run.end_time=1e-4", Known::relaxation},
    {"256^3, few steps", "fig3_oblate grid.nodes=256 run.end_time=1e-8", Known::relaxation},

    // Where the vesicle lies in its box.
    {"3.04 spacings from the sides", "fig3_oblate shape.semi_axis=0.905 run.end_time=4.47e-3",
     Known::relaxation, quick},
    {"2.9 spacings from the sides", "fig3_oblate shape.semi_axis=0.91", Known::relaxation, quick},
    {"off-centre", "fig3_oblate shape.center=[0.11,-0.07,0.13]", Known::relaxation},
    {"rotated", "fig3_oblate shape.rotation_axis=[1,2,3] shape.rotation_angle=40",
     Known::relaxation},
    {"off-centre and rotated",
     "fig3_oblate shape.center=[0.11,-0.07,0.13] shape.rotation_axis=[1,2,3] "
     "shape.rotation_angle=40",
     Known::relaxation, quick},

    // Rough starts, the first as rough as is allowed; they settle in the same shape.
    {"rough by 0.02", "fig3_oblate perturbation.amplitude=0.02 perturbation.wavelength=0.2",
     Known::relaxation, quick},
    {"rough by 0.02, longer waves", "fig3_oblate perturbation.amplitude=0.02", Known::relaxation},
    {"rough by 0.05", "fig3_oblate perturbation.amplitude=0.05 perturbation.wavelength=0.2",
     Known::relaxation, quick},

    // Area differences far from that of the start.
    {"oblate, Da 1.07 to 1.05", "fig8a stop.energy_rate=0.05", Known::triangle},
    {"prolate, Da 1.05 to 1.10", "fig8b", Known::pear},
    {"oblate, Da 1.07 to 0.9",
     "fig8a area_difference.targets=0.9 run.end_time=0.04 numerics.max_time_step=1e-3"},
    {"oblate, Da 1.07 to 1.3",
     "fig8a area_difference.targets=1.3 area_difference.rate=20 run.end_time=0.02"},
    {"oblate, Da 1.07 to 1.3, fast",
     "fig8a area_difference.targets=1.3 area_difference.start_times=0 area_difference.rate=1e3 "
     "run.end_time=1e-3"},
    {"oblate, Da 1.07 to 1.3 at once",
     "fig8a area_difference.targets=1.3 area_difference.start_times=0 area_difference.rate=1e5 "
     "run.end_time=1e-3"},
    {"prolate v = 0.55, Da 1.47 to 1.6", "fig8d"},
    {"prolate v = 0.90, Da 1.05 to 1.15", "fig8b area_difference.targets=1.15"},
};

} // namespace

std::span<const ExtremeCase> extreme_cases() { return cases; }

Scene scene_of(const ExtremeCase& which) {
  std::istringstream words{std::string(which.scene)};
  std::string name;
  words >> name;
  return builtin_scene(name,
                       std::vector<std::string>{std::istream_iterator<std::string>(words), {}});
}

} // namespace lamella
