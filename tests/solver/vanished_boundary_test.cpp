// What is left of psi where a boundary of the phases has vanished.
#include "dynamics/phases.h"
#include "levelset/taylor.h"
#include "start_surface.h"

#include <cmath>
#include <gtest/gtest.h>

namespace lamella {
namespace {

constexpr double R = 0.6;

/// A sphere of Lo, where an Ld cap has just shrunk away from the pole: psi is the distance from it,
/// less than that by nowhere a whole spacing.
struct Remains {
  Scene scene = soft_cap();
  StartSurface membrane{scene.shape, scene.grid()};
  Components one{scene.grid(), false};
  Phases phases{scene,
                at_nodes(scene.grid(),
                         [](const Vec3& x) {
                           const double across = std::hypot(x[0], x[1]);
                           return 0.01 + R * std::atan2(across, x[2]);
                         }),
                membrane.fourier};

  static Scene soft_cap() {
    Scene scene;
    scene.nodes = {40, 40, 40};
    scene.shape = sphere(R);
    scene.domains.kind = DomainsKind::cap;
    return scene;
  }

  /// psi at the pole after the membrane was measured.
  double located() {
    phases.locate(membrane.phi, membrane.band, one);
    phases.psi().update_nodal();
    return taylor(phases.psi(), std::vector{Eigen::Vector3d(0, 0, R)}).front().value;
  }
};

TEST(VanishedBoundary, IsLeftAloneByAMeasurement) {
  Remains remains;
  ASSERT_TRUE(remains.phases.boundary().points().empty());
  const double before = remains.located(), after = remains.located();
  EXPECT_TRUE(remains.phases.boundary().points().empty());
  EXPECT_NEAR(after, before, 0.1 * remains.scene.grid().spacing); // the kink is smoothed
}

TEST(VanishedBoundary, FadesByWhatTheStepSaysOnce) {
  Remains remains, other;
  const double h = remains.scene.grid().spacing;
  remains.located();
  other.located();
  remains.phases.set_fade(0.05);
  other.phases.set_fade(0.1);
  const double slow = remains.located(), fast = other.located();
  EXPECT_EQ(remains.phases.fade(), 0);
  Remains still;
  still.located();
  const double none = still.located();
  EXPECT_GT(slow - none, 0.2 * h); // of seven spacings
  EXPECT_NEAR((fast - none) / (slow - none), 2, 0.1);
}

TEST(VanishedBoundary, FadesInProportionToShortSteps) {
  Remains remains;
  remains.located();
  const double h = remains.scene.grid().spacing, unit = h * h * h * h; // kappa is 1
  Extension extension(remains.scene.grid());
  auto fade = [&](double dt) {
    remains.phases.extend_rates(remains.membrane.band, dt, extension);
    return remains.phases.fade();
  };
  EXPECT_NEAR(fade(1e-3 * unit) / fade(1e-4 * unit), 10, 1e-9);
  EXPECT_EQ(fade(1e3 * unit), fade(1e4 * unit));
}

} // namespace
} // namespace lamella
