// Scenes that must be refused, each with one message that names the place, the key and the trouble.
#include "error.h"
#include "scene/scene_toml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

namespace lamella {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct BadScene {
  const char* name;
  std::string text;
  const char* start; ///< of the message: place and key
  const char* part;  ///< of the message
  std::vector<std::string> overrides = {};
};

void PrintTo(const BadScene& bad, std::ostream* out) { *out << bad.name; }

std::string message_for(const BadScene& bad) {
  try {
    parse_scene(bad.text, "bad.toml", bad.overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

const std::string torus = "[shape]\nkind = \"torus\"\n";
const std::string fine = "[shape]\nkind = \"sphere\"\nradius = 0.5\n";
const std::string ramp = "[volume]\nconstraint = \"ramped\"\n";
const std::string frame = "[shape]\nkind = \"frame\"\n";
const std::string free = "[volume]\nconstraint = \"free\"\n";
const std::string cap = fine + "[domains]\nkind = \"cap\"\n";
const std::string caps = fine + "[domains]\nkind = \"caps\"\n";

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

std::vector<BadScene> bad_scenes() {
  using std::string_literals::operator""s;
  return {
      // Names
      {"UnknownKey", "[grid]\n\nnods = 64\n", "bad.toml:3: [grid] nods: unknown key",
       "allowed: nodes, half_width; did you mean \"nodes\"?"},
      {"UnknownKeyWithoutNeighbour", "[grid]\nviscosity = 64\n",
       "bad.toml:2: [grid] viscosity: unknown", "allowed: nodes, half_width"},
      {"UnknownSection", fine + "[membran]\nbending_modulus = 1\n",
       "bad.toml:4: [membran]: unknown section", "did you mean \"membrane\"?"},
      {"KeyOfAnotherSection", "[grid]\nend_time = 1\n", "bad.toml:2: [grid] end_time: unknown key",
       "did you mean end_time in [run]?"},
      {"KeyOutsideItsSection", "nodes = 64\n", "bad.toml:1: nodes: unknown key",
       "did you mean nodes in [grid]?"},
      {"SectionOfAnEarlierRelease", fine + "[constraints]\nvolume = \"fixed\"\n",
       "bad.toml:4: [constraints]: unknown section", "[volume], [area], [area_difference]"},
      {"FirstOfTwoMistakes", "[run]\nend = 1\n[grid]\nnods = 64\n",
       "bad.toml:2: [run] end:", "unknown key"},
      {"SectionAsValue", "grid = 64\n", "bad.toml:1: grid: this is a section",
       "[grid], then its keys"},
      {"ListOfSections", "[[grid]]\nnodes = 64\n", "bad.toml:1: grid: this is a section", "[grid]"},
      {"SectionInSection", "[grid.nodes]\nx = 64\n",
       "bad.toml:1: [grid] nodes: a section does not fit", "integer"},
      {"ControlCharactersInAKey", "[grid]\n\"no\\ndes\\u001b\" = 64\n",
       "bad.toml:2: [grid] no?des?: unknown key", "nodes"},
      {"TitleOfTwoLines", "title = \"two\\nlines\"\n" + fine,
       "bad.toml:1: title: not a line of text", "at most 200"},
      {"NameThatLeavesTheFolder", "name = \"../x\"\n" + fine,
       "bad.toml:1: name:", "cannot name a folder"},

      // Types
      {"TextForNumber", "[run]\nend_time = \"long\"\n",
       "bad.toml:2: [run] end_time: the text \"long\"", "allowed: a number from 0"},
      {"FractionForInteger", "[output]\nframes = 10.0\n",
       "bad.toml:2: [output] frames: the number 10", "an integer from 2"},
      {"BooleanForNumber", "[run]\nend_time = true\n",
       "bad.toml:2: [run] end_time: true does not fit", "a number"},
      {"DateForNumber", "[run]\nend_time = 2024-01-01\n",
       "bad.toml:2: [run] end_time: a date or time", "a number"},
      {"TwoNumbersForThree", "[shape]\ncenter = [0, 0]\n",
       "bad.toml:2: [shape] center: a list of 2", "three numbers [x, y, z]"},
      {"TextInAList", "[shape]\ncenter = [0, 0, \"a\"]\n",
       "bad.toml:2: [shape] center: a list of 3", "three numbers"},
      {"TextInAListOfNumbers", ramp + "targets = [0.9, \"a\"]\n",
       "bad.toml:3: [volume] targets: a list of 2 does not fit", "up to 1, or a list of them"},
      {"TextForBoolean", "[contact]\ntopology_changes = \"no\"\n",
       "bad.toml:2: [contact] topology_changes: the text \"no\" does not fit", "true or false"},
      {"NumberForText", "title = 7\n", "bad.toml:1: title: the integer 7", "a text in quotes"},
      {"NumberForChoice", "[shape]\nkind = 1\n", "bad.toml:2: [shape] kind: the integer 1",
       "\"sphere\""},
      {"LongTextIsCut", "[run]\nend_time = \"" + std::string(5000, 'x') + "\"\n",
       "bad.toml:2: [run] end_time: the text", "xxx...\" does not fit"},

      // Choices
      {"UnknownKind", "[shape]\nkind = \"Oblat\"\n", "bad.toml:2: [shape] kind: the text \"Oblat\"",
       "did you mean \"oblate\"?"},
      {"UnknownConstraint", fine + "[volume]\nconstraint = \"frei\"\n",
       "bad.toml:5: [volume] constraint: the text \"frei\"", "did you mean \"free\"?"},
      {"KeyOfAnotherKind", torus + "semi_axis = 0.7\n",
       "bad.toml:3: [shape] semi_axis: belongs to kind",
       "\"oblate\" or \"prolate\", not \"torus\"; allowed: kind, ring_radius, tube_radius"},
      {"KeyOfAnotherKindThanTheDefault", "[shape]\nradius = 0.7\n",
       "bad.toml:2: [shape] radius: belongs to", "\"sphere\", not \"oblate\""},
      {"KeyOfAnotherConstraint", "[volume]\nconstraint = \"ramped\"\npressure = -200\n",
       "bad.toml:3: [volume] pressure: belongs to constraint = \"free\", not \"ramped\"",
       "allowed: constraint, targets, start_times, rate"},
      {"KeyOfAnotherConstraintThanTheDefault", "[area_difference]\ntargets = [1.1]\n",
       "bad.toml:2: [area_difference] targets: belongs to constraint = \"ramped\", not \"free\"",
       "allowed: constraint, multiplier"},
      {"FrameMovedElsewhere", frame + "file = \"run\"\ncenter = [0.1, 0, 0]\n",
       "bad.toml:4: [shape] center: belongs to kind", "not \"frame\"; allowed: kind, file"},

      {"MembraneWithDomains", cap + "[membrane]\nbending_modulus = 2\n",
       "bad.toml:7: [membrane] bending_modulus: belongs to [domains] kind = \"none\", not \"cap\"",
       "allowed: [ld], [lo], [line]"},
      {"PhaseWithoutDomains", fine + "[lo]\nbending_modulus = 2\n",
       "bad.toml:5: [lo] bending_modulus: belongs to [domains] kind = \"cap\" or \"caps\" or "
       "\"frame\", not \"none\"",
       "allowed: [membrane]"},
      {"LineWithoutDomains", fine + "[line]\ntension = 2\n",
       "bad.toml:5: [line] tension: belongs to", "allowed: [membrane]"},
      {"CurvatureStartWithoutDomains", fine + "[domains]\ncurvature_start_time = 1\n",
       "bad.toml:5: [domains] curvature_start_time: belongs to kind", "allowed: kind"},
      {"KeyOfAnotherKindOfDomains", cap + "half_angle = 20\n",
       "bad.toml:6: [domains] half_angle: belongs to kind = \"caps\", not \"cap\"",
       "allowed: kind, area_fraction, direction, curvature_start_time"},

      // Ranges
      {"NodesNotMultipleOfEight", "[grid]\nnodes = 60\n",
       "bad.toml:2: [grid] nodes: 60 is not a multiple of 8", "from 16 to 512"},
      {"TooFewNodes", "[grid]\nnodes = 8\n", "bad.toml:2: [grid] nodes: 8 is out of range",
       "from 16 to 512"},
      {"TooManyNodesAlongOneAxis", "[grid]\nnodes = [64, 64, 520]\n",
       "bad.toml:2: [grid] nodes: 520", "512"},
      {"NegativeNodes", "[grid]\nnodes = -64\n", "bad.toml:2: [grid] nodes: -64 is out of range",
       "512"},
      {"NodesBeyondAnInteger", "[grid]\nnodes = 4294967360\n",
       "bad.toml:2: [grid] nodes: ", "allowed"},
      {"NodesBeyondTheParser", "[grid]\nnodes = 99999999999999999999\n",
       "bad.toml:2: this is not TOML", "64 bits"},
      {"NegativeHalfWidth", "[grid]\nhalf_width = -1\n", "bad.toml:2: [grid] half_width: -1",
       "out of range"},
      {"InfiniteHalfWidth", "[grid]\nhalf_width = inf\n", "bad.toml:2: [grid] half_width: inf",
       "not a finite number"},
      {"NanCenter", "[shape]\ncenter = [0, nan, 0]\n", "bad.toml:2: [shape] center: nan",
       "not a finite number"},
      {"NegativeModulus", "[membrane]\nbending_modulus = -1.0\n",
       "bad.toml:2: [membrane] bending_modulus: -1", "out of range"},
      {"NoModulus", "[membrane]\nbending_modulus = 0\n",
       "bad.toml:2: [membrane] bending_modulus: 0", "out of range"},
      {"NegativeTime", "[run]\nend_time = -1\n", "bad.toml:2: [run] end_time: -1 is out of range",
       "from 0"},
      {"TimeOverflows", "[run]\nend_time = 1e999\n", "bad.toml:2: ", "1e999"},
      {"NegativeTimeStep", "[numerics]\nmax_time_step = -1e-5\n",
       "bad.toml:2: [numerics] max_time_step", "range"},
      {"NoTolerance", "[numerics]\ntolerance = 0.0\n", "bad.toml:2: [numerics] tolerance: 0",
       "above 0"},
      {"LaxTolerance", "[numerics]\ntolerance = 0.2\n", "bad.toml:2: [numerics] tolerance: 0.2",
       "up to 0.1"},
      {"OneFrame", "[output]\nframes = 1\n", "bad.toml:2: [output] frames: 1 is out of range",
       "from 2"},
      {"ReducedVolumeOne", "[shape]\nreduced_volume = 1\n", "bad.toml:2: [shape] reduced_volume: 1",
       "write kind = \"sphere\""},
      {"ReducedVolumeAboveOne", "[shape]\nreduced_volume = 1.2\n",
       "bad.toml:2: [shape] reduced_volume: 1.2", "no closed surface"},
      {"ReducedVolumeZero", "[shape]\nreduced_volume = 0\n",
       "bad.toml:2: [shape] reduced_volume: 0", "from 0.01"},
      {"FlatEllipsoid", "[shape]\nkind = \"ellipsoid\"\nsemi_axes = [0.5, 0, 0.5]\n",
       "bad.toml:3: [shape] semi_axes: 0 is out of range", "above 0"},
      {"Angle", "[shape]\nrotation_angle = 400\n", "bad.toml:2: [shape] rotation_angle: 400",
       "-360 to 360"},
      {"ReducedVolumeOfATarget", ramp + "targets = [0.9, 1.1]\n",
       "bad.toml:3: [volume] targets: 1.1 is out of range", "up to 1"},
      {"NanTarget", ramp + "targets = nan\n", "bad.toml:3: [volume] targets: nan",
       "not a finite number"},
      {"NegativeRate", ramp + "targets = [0.9]\nrate = -1\n", "bad.toml:4: [volume] rate: -1",
       "from 0"},
      {"ManyArms", "[perturbation]\nfold = 13\n", "bad.toml:2: [perturbation] fold: 13",
       "from 0 to 12"},
      {"NegativeSeed", "[perturbation]\nseed = -1\n", "bad.toml:2: [perturbation] seed: -1",
       "from 0"},

      {"WholeFraction", cap + "area_fraction = 1\n", "bad.toml:6: [domains] area_fraction: 1",
       "above 0 and below 1"},
      {"NanInADirection", caps + "directions = [[0, 0, 1], [0, nan, 1]]\n",
       "bad.toml:6: [domains] directions: nan", "not a finite number"},
      {"OneDirectionForAList", caps + "directions = [0, 0, 1]\n",
       "bad.toml:6: [domains] directions: a list of 3 does not fit", "[[x, y, z], ...]"},
      {"DirectionInThePlane", caps + "directions = [[0, 1]]\n",
       "bad.toml:6: [domains] directions: a list of 1 does not fit", "three numbers each"},
      {"BulgeBeyondAHemisphere", caps + "bulge = 91\n", "bad.toml:6: [domains] bulge: 91",
       "from -90 to 90"},
      {"NoModulusOfLd", cap + "[ld]\nbending_modulus = 0\n",
       "bad.toml:7: [ld] bending_modulus: 0 is out of range", "from 1e-30"},
      {"GaussianModuliWithoutBound", cap + "[lo]\ngaussian_modulus = 4.1\n" + free,
       "bad.toml:7: [lo] gaussian_modulus: the energy has no lower bound",
       "ld.bending_modulus, -4"},
      {"TorsionWithoutTension", cap + "[line]\ntorsion_modulus = 0.5\n" + free,
       "bad.toml:7: [line] torsion_modulus: the energy has no lower bound",
       "line.tension of at least"},
      {"NegativeSquareModulus", cap + "[line]\nnormal_square_modulus = -1\n" + free,
       "bad.toml:7: [line] normal_square_modulus: -1 leaves the energy without a lower bound",
       "from 0"},
      {"NegativeGradientModulus", "[membrane]\ngradient_modulus = -1\n",
       "bad.toml:2: [membrane] gradient_modulus: -1 leaves the energy without a lower bound",
       "from 0"},
      {"PerpendicularModulus", cap + "[line]\nperpendicular_modulus = 1\n" + free,
       "bad.toml:7: [line] perpendicular_modulus: the energy has no lower bound", "allowed: 0"},
      {"NegativeDrag", cap + "[line]\ndrag = -1\n", "bad.toml:7: [line] drag: -1", "from 0"},
      {"NegativeLineTension", cap + "[line]\ntension = -1\n", "bad.toml:7: [line] tension: -1",
       "from 0"},
      {"NegativeStretchModulus", "[stretch]\nmodulus = -1\n", "bad.toml:2: [stretch] modulus: -1",
       "from 0"},

      // Rules that tie keys together
      {"NoRotationAxis", "[shape]\nrotation_axis = [0, 0, 0]\n",
       "bad.toml:2: [shape] rotation_axis:", "no direction"},
      {"TorusWithoutHole", torus + "tube_radius = 0.5\nring_radius = 0.5\n",
       "bad.toml:3: [shape] tube_radius:", "no hole"},
      {"TorusWithPinhole", torus + "ring_radius = 0.4\ntube_radius = 0.37\n",
       "bad.toml:4: [shape] tube_radius:",
       "half-thickness is 0.96 grid spacings; allowed: at least 1.5; nodes = 104 would do"},
      {"ShapeLeavesTheBox", "[shape]\nkind = \"sphere\"\nradius = 1.5\n",
       "bad.toml:3: [shape] radius:", "outside the box"},
      {"ShapeTouchesTheSide", "[shape]\nkind = \"sphere\"\nradius = 0.95\n",
       "bad.toml:3: [shape] radius:", "1.6 grid spacings from the side; allowed: 3 free"},
      {"ShapeShiftedOut", fine + "center = [0, 0, -0.45]\n",
       "bad.toml:3: [shape] radius:", "z = -0.95"},
      {"ShapeTurnedOut",
       "[grid]\nnodes = [64, 64, 96]\nhalf_width = 0.8\n[shape]\nkind = \"prolate\"\nsemi_axis = "
       "0.9\n"
       "reduced_volume = 0.8\nrotation_axis = [1, 0, 0]\nrotation_angle = 90\n",
       "bad.toml:6: [shape] semi_axis:", "y = "},
      {"TooThin", "[shape]\nkind = \"sphere\"\nradius = 0.02\n",
       "bad.toml:3: [shape] radius: the grid is too coarse", "smallest half-thickness is 0.64"},
      {"TooThinAndSharperStill", "[shape]\nreduced_volume = 0.05\n",
       "bad.toml:2: [shape] reduced_volume: the grid is too coarse",
       "smallest radius of curvature is 0.00703"},
      {"TooSharp", "[shape]\nkind = \"prolate\"\nreduced_volume = 0.5\n[grid]\nnodes = 40\n",
       "bad.toml:3: [shape] reduced_volume:", "smallest radius of curvature"},
      {"TooThinForAnyGrid", "[shape]\nkind = \"prolate\"\nreduced_volume = 0.05\n",
       "bad.toml:3: [shape] reduced_volume:", "no grid of this release resolves it"},
      {"RampWithoutTargets", ramp, "bad.toml:2: [volume] constraint: nothing to be led to",
       "targets = [0.9]"},
      {"RampWithoutAnyTarget", ramp + "targets = []\n", "bad.toml:3: [volume] targets: nothing",
       "at least one number"},
      {"TwoTargetsOneTime", ramp + "targets = [0.9, 0.8]\n",
       "bad.toml:3: [volume] targets: the numbers of targets (2) and start times (1) differ",
       "one start time for each target"},
      {"OneTargetTwoTimes", ramp + "targets = 0.9\nstart_times = [0, 1e-3]\n",
       "bad.toml:4: [volume] start_times: the numbers of targets (1) and start times (2)",
       "one start time for each target"},
      {"TimesThatDoNotGrow", ramp + "targets = [0.9, 0.8]\nstart_times = [1e-3, 1e-3]\n",
       "bad.toml:4: [volume] start_times: 0.001 before 0.001", "times that grow"},
      {"PerturbationTooLarge", "[perturbation]\namplitude = 0.05\n",
       "bad.toml:2: [perturbation] amplitude: 0.05 is too large", "allowed: at most 0.0467"},
      {"PerturbationThickerThanTheShape", "[perturbation]\namplitude = 0.1\nwavelength = 2\n",
       "bad.toml:2: [perturbation] amplitude: 0.1 is too large", "allowed: at most 0.0904"},
      {"PerturbationNotResolved", "[perturbation]\namplitude = 0.001\nwavelength = 0.1\n",
       "bad.toml:3: [perturbation] wavelength: the grid is too coarse",
       "is 3.2 grid spacings; allowed: at least 4; nodes = 80 would do"},
      {"ArmsNotResolved",
       "[perturbation]\namplitude = 0.001\nfold = 12\n[shape]\nkind = \"prolate\"\n",
       "bad.toml:3: [perturbation] fold: the grid is too coarse", "is 2.13 grid spacings"},
      {"ArmsWithAWavelength", "[perturbation]\namplitude = 0.001\nfold = 3\nwavelength = 0.3\n",
       "bad.toml:4: [perturbation] wavelength: does not count", "one of the two"},
      {"PerturbationTouchesTheSide",
       "[perturbation]\namplitude = 0.04\n[shape]\nkind = \"sphere\"\nradius = 0.9\n",
       "bad.toml:5: [shape] radius:", "1.92 grid spacings from the side"},
      {"FrameWithoutAFile", frame, "bad.toml:2: [shape] kind: no file", "a stored frame"},
      {"PerturbedFrame", frame + "file = \"run\"\n[perturbation]\namplitude = 0.01\n",
       "bad.toml:5: [perturbation] amplitude: a stored frame is taken as it is", "0"},
      {"WrinklesNotResolved", fine + "[volume]\nconstraint = \"free\"\npressure = -5000\n",
       "bad.toml:6: [volume] pressure: the grid is too coarse",
       "= 0.0585, 1.87 grid spacings; allowed: at least 2; nodes = 72 would do"},
      {"CurvatureOfTheMultiplierNotResolved", fine + "[area_difference]\nmultiplier = 80\n",
       "bad.toml:5: [area_difference] multiplier:", "at most 1; nodes = 80 would do"},
      {"CurvaturesAddUp",
       "[membrane]\nspontaneous_curvature = -30\n[area_difference]\nmultiplier = 10\n",
       "bad.toml:2: [membrane] spontaneous_curvature:", "nodes = 72 would do"},
      {"CurvatureNotResolved", fine + "[membrane]\nspontaneous_curvature = -40\n",
       "bad.toml:5: [membrane] spontaneous_curvature:", "at most 1; nodes = 80 would do"},
      {"BoxNotResolvedByDefaultGrid", "[grid]\nhalf_width = 100\n",
       "bad.toml:2: [grid] half_width: the grid", "radius of curvature"},

      {"DomainsOnATorus", torus + "[domains]\nkind = \"cap\"\n",
       "bad.toml:4: [domains] kind: not on a torus yet", "allowed: \"none\""},
      {"CapOnAFrame", frame + "file = \"run\"\n[domains]\nkind = \"cap\"\n",
       "bad.toml:5: [domains] kind: a stored frame is taken as it is",
       "allowed: \"frame\" for its phases, or \"none\""},
      {"PhasesOfAFrameOnAShape", fine + "[domains]\nkind = \"frame\"\nfile = \"run\"\n",
       "bad.toml:5: [domains] kind: the phases of a stored frame go with its membrane",
       "kind = \"frame\" in [shape]"},
      {"NoDirection", cap + "direction = [0, 0, 0]\n",
       "bad.toml:6: [domains] direction: a cap has no direction", "but [0, 0, 0]"},
      {"NoDirectionOfOneCap", caps + "directions = [[0, 0, 1], [0, 0, 0]]\n",
       "bad.toml:6: [domains] directions: a cap has no direction", "but [0, 0, 0]"},
      {"CapsWithoutDirections", caps, "bad.toml:5: [domains] kind: no domain",
       "at least one direction"},
      {"NoCap", caps + "directions = []\n", "bad.toml:6: [domains] directions: no domain",
       "at least one direction"},
      {"SmallDomain", cap + "area_fraction = 0.01\n",
       "bad.toml:6: [domains] area_fraction: the grid is too coarse",
       "radius of 3.18 grid spacings; allowed: at least 3.5; nodes = 72 would do"},
      {"SmallRest", cap + "area_fraction = 0.99\n",
       "bad.toml:6: [domains] area_fraction: the grid is too coarse", "radius of 3.18"},
      {"SmallCaps", caps + "directions = [[0, 0, 1]]\nhalf_angle = 10\n",
       "bad.toml:7: [domains] half_angle: the grid is too coarse", "radius of 2.78"},
      {"CapsThatOverlap", caps + "directions = [[0, 0, 1], [0, 2, 2]]\nhalf_angle = 23\n",
       "bad.toml:7: [domains] half_angle: domains 1 and 2 overlap", "domains apart"},
      {"CapsThatAlmostTouch", caps + "directions = [[0, 0, 1], [1, 0, 0], [0, 2, 2]]\n",
       "bad.toml:6: [domains] directions: the grid is too coarse for the gap of 1.4 grid spacings",
       "between domains 1 and 3; allowed: at least 4; nodes = 184 would do"},
      {"BulgeOfASpheroid",
       "[domains]\nkind = \"caps\"\ndirections = [[0, 0, 1]]\nhalf_angle = 60\nbulge = 10\n",
       "bad.toml:5: [domains] bulge: only caps of a sphere bulge", "kind = \"sphere\" in [shape]"},
      {"DimplesThatMeet",
       caps + "directions = [[0, 0, 1], [0, 0, -1]]\nhalf_angle = 70\nbulge = -40\n",
       "bad.toml:8: [domains] bulge: dimples of -40 degrees could meet",
       "at least half_angle - 90, which is -20"},
      {"BulgeTouchesTheSide",
       "[shape]\nkind = \"sphere\"\nradius = 0.9\n[domains]\nkind = \"caps\"\ndirections = [[0, 0, "
       "1]]\nbulge = 60\n",
       "bad.toml:3: [shape] radius: the shape reaches to x = -1.023", "outside the box"},
      {"SphereThatCannotLeave",
       "[shape]\nkind = \"sphere\"\n[domains]\nkind = \"cap\"\narea_fraction = 0.3\n",
       "bad.toml:2: [shape] kind: a sphere that keeps its volume", "\"ramped\""},
      {"AreaDifferenceOfASphere",
       fine + "[area_difference]\nconstraint = \"ramped\"\ntargets = 1.1\n",
       "bad.toml:5: [area_difference] constraint: a sphere that keeps its volume", "\"ramped\""},
      {"AreaDifferenceOfASphereAtOnce",
       fine + "[perturbation]\namplitude = 0.01\n" + ramp + "targets = 0.9\n" +
           "[area_difference]\nconstraint = \"ramped\"\ntargets = 1.1\n",
       "bad.toml:10: [area_difference] constraint: a sphere has no other area difference than 1",
       "start_times"},
      {"SphereWithoutADirection", fine + ramp + "targets = 0.9\n",
       "bad.toml:5: [volume] constraint: a sphere is alike all around",
       "an amplitude above 0, such as 0.01"},
      {"AreaDifferenceOfDomains", cap + "[area_difference]\nconstraint = \"fixed\"\n",
       "bad.toml:7: [area_difference] constraint: not with domains yet", "\"free\""},
      {"MultiplierOfDomains", cap + "[area_difference]\nmultiplier = 3\n",
       "bad.toml:7: [area_difference] multiplier: not with domains yet", "multiplier = 0"},
      {"LinearModulusNotResolved", fine + "[membrane]\nbending_modulus = 2\nlinear_modulus = 80\n",
       "bad.toml:6: [membrane] linear_modulus: the grid is too coarse for buds",
       "at most 1; nodes = 80 would do"},
      {"CurvatureOfAPhaseNotResolved", cap + "[lo]\nspontaneous_curvature = -40\n",
       "bad.toml:7: [lo] spontaneous_curvature: the grid is too coarse", "nodes = 80 would do"},
      {"WrinklesOfTheSoftPhaseNotResolved",
       cap + "[volume]\nconstraint = \"free\"\npressure = -5000\n[ld]\nbending_modulus = 10\n",
       "bad.toml:8: [volume] pressure: the grid is too coarse", "1.87 grid spacings"},

      // TOML
      {"Empty", "", "bad.toml:1: the scene is empty", "allowed"},
      {"OnlyComments", "# nothing\n\n[grid]\n", "bad.toml:1: the scene is empty", "allowed"},
      {"DuplicateKey", "[grid]\nnodes = 64\nnodes = 96\n", "bad.toml:3: this is not TOML", "nodes"},
      {"DuplicateSection", "[grid]\nnodes = 64\n[grid]\nhalf_width = 1\n",
       "bad.toml:3: this is not TOML", "grid"},
      {"NoValue", "[grid]\nnodes =\n", "bad.toml:2: this is not TOML", "value"},
      {"OpenSection", "[grid\nnodes = 64\n", "bad.toml:1: this is not TOML", "]"},
      {"OpenText", "title = \"abc\n", "bad.toml:1: this is not TOML", "string"},
      {"NulByte", fine + "title = \"\0\""s, "bad.toml:4: not a text", "TOML"},
      {"BinaryRubbish",
       "\x7f"
       "ELF\x02\x01\xfe\xff\x93",
       "bad.toml:1: this is not TOML", ""},
      {"BrokenUtf8", fine + "title = \"\xff\xfe\"\n", "bad.toml:", "utf-8"},
      {"TooLarge", repeated("# comment\n", 110000), "bad.toml: larger than 1 MiB", "short text"},
      {"DeepLists", "x = " + std::string(200000, '['), "bad.toml:1: this is not TOML", "nest"},
      {"DeepTables", "x = " + repeated("{a=", 100000), "bad.toml:1: this is not TOML", "nest"},
      {"DeepInEveryWay", "x = " + repeated("[\n{" + repeated("a.", 24) + "a = ", 2000),
       "bad.toml:", "nest"},
      {"DeepKeys", repeated("a.", 300000) + "a = 1\n", "bad.toml:1: nested too deeply",
       "plain keys"},
      {"DeepKeysOfDigits", repeated("1.5 . 25.", 100000) + "a = 1\n",
       "bad.toml:1: nested too deeply", "plain keys"},
      {"DeepSections", std::string("[") + repeated("a.", 300000) + "a]\n",
       "bad.toml:1: nested too deeply", "plain keys"},

      // --set
      {"SetUnknownKey",
       fine,
       "--set grid.nods=64: [grid] nods: unknown key",
       "did you mean \"nodes\"?",
       {"grid.nods=64"}},
      {"SetUnknownSection",
       fine,
       "--set gird.nodes=64: [gird]: unknown section",
       "did you mean \"grid\"?",
       {"gird.nodes=64"}},
      {"SetWithoutSection",
       fine,
       "--set nodes=64: nodes: unknown key",
       "nodes in [grid]",
       {"nodes=64"}},
      {"SetNoEquals", fine, "--set grid.nodes: no key and value", "grid.nodes=96", {"grid.nodes"}},
      {"SetNoValue", fine, "--set grid.nodes=: no key and value", "grid.nodes=96", {"grid.nodes="}},
      {"SetNoKey", fine, "--set =64: no key and value", "", {"=64"}},
      {"SetBareWordForNumber",
       fine,
       "--set grid.nodes=many: [grid] nodes: not a TOML value",
       "an integer",
       {"grid.nodes=many"}},
      {"SetNumberWithoutZero",
       fine,
       "--set shape.radius=.5: [shape] radius: not a TOML value",
       "a number",
       {"shape.radius=.5"}},
      {"SetUnknownWord",
       fine,
       "--set shape.kind=sphera: [shape] kind: the text \"sphera\"",
       "\"sphere\"?",
       {"shape.kind=sphera"}},
      {"SetMoreThanOneKey",
       fine,
       "--set grid.nodes=64?half_width=3: [grid] nodes: not a TOML value",
       "more than one value",
       {"grid.nodes=64\nhalf_width=3"}},
      {"SetOutOfRange",
       fine,
       "--set output.frames=0: [output] frames: 0 is out of range",
       "from 2",
       {"output.frames=0"}},
      {"SetKeyOfAnotherKind",
       fine,
       "--set shape.semi_axis=0.5: [shape] semi_axis: belongs to kind",
       "sphere",
       {"shape.semi_axis=0.5"}},
      {"SetKeyOfAnotherConstraint",
       fine,
       "--set volume.pressure=-200: [volume] pressure: belongs to constraint",
       "free",
       {"volume.pressure=-200"}},
      {"SetDeepKeys",
       fine,
       "--set grid.nodes={a.a",
       "nested too deeply",
       {"grid.nodes={" + repeated("a.", 300000) + "a=1}"}},
      {"SetDoesNotExcuseTheFile",
       torus + "radius = 0.5\n",
       "bad.toml:3: [shape] radius: belongs to kind",
       "torus",
       {"shape.kind=sphere"}},
  };
}

class BadScenes : public testing::TestWithParam<BadScene> {};

TEST_P(BadScenes, AreRefusedWithPlaceKeyAndReason) {
  const std::string message = message_for(GetParam());
  EXPECT_THAT(message, StartsWith(GetParam().start));
  EXPECT_THAT(message, HasSubstr(GetParam().part));
  EXPECT_EQ(message.find('\n'), message.npos) << message;
  EXPECT_LT(message.size(), 1100u);
}

INSTANTIATE_TEST_SUITE_P(All, BadScenes, testing::ValuesIn(bad_scenes()),
                         [](const auto& info) { return info.param.name; });

std::string read_message(const std::filesystem::path& file) {
  try {
    read_scene(file);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BadFiles, MissingFile) {
  EXPECT_EQ(read_message("/no/such/scene.toml"),
            "/no/such/scene.toml: cannot be read: No such file or directory");
}

TEST(BadFiles, Folder) {
  const auto folder = std::filesystem::temp_directory_path();
  EXPECT_THAT(read_message(folder),
              StartsWith(folder.string() + ": cannot be read: it is a folder"));
}

TEST(BadFiles, EndlessDevice) {
  EXPECT_THAT(read_message("/dev/zero"), HasSubstr("it is a device, not a file"));
}

TEST(BadFiles, ErrorsNameTheFileAsItWasGiven) {
  const auto file = std::filesystem::temp_directory_path() / "lamella bad scene.toml";
  std::ofstream(file) << "[grid]\nnodes = 7\n";
  EXPECT_THAT(read_message(file), StartsWith(file.string() + ":2: [grid] nodes: 7"));
  std::filesystem::remove(file);
}

// A scene built by a program, not read from a file, has no place to name.
TEST(BadValues, AreRefusedWithoutAFileToo) {
  const auto message = [](auto change) {
    Scene scene;
    change(scene);
    try {
      validate(scene);
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message([&](Scene& s) { s.shape.reduced_volume = nan; }),
              StartsWith("[shape] reduced_volume: nan is not a finite number"));
  EXPECT_THAT(message([&](Scene& s) { s.nodes[1] = 0; }),
              StartsWith("[grid] nodes: 0 is out of range"));
  EXPECT_THAT(message([&](Scene& s) { s.shape.rotation_axis[2] = -nan; }),
              HasSubstr("not a finite number"));
  EXPECT_THAT(message([&](Scene& s) { s.membrane.spontaneous_curvature = 33; }),
              HasSubstr("nodes = 72"));
  EXPECT_EQ(message([&](Scene& s) { s.shape.radius = nan; }),
            "accepted"); // not of this kind of shape
}

} // namespace
} // namespace lamella
