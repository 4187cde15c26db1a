/**
 * @class vtkVesicleDynamics
 * @brief a vesicle over time, from the level set that it starts as
 *
 * Relaxes a membrane under its bending energy, with volume and area held or led where they are to go,
 * as `lamella run` does (docs/numerics.md). The output is a time-varying image: its time steps are
 * those at which a run stores its state, OutputFrames of them from 0 to EndTime, and any time between
 * can be asked for. Without a time the output is that of time 0.
 *
 * States are computed when they are asked for, running forward, and kept in memory; those at the time
 * steps are the same in whatever order they are asked for. A time between two steps is reached by
 * going on from the one before. Properties have the names, units and ranges of the scene format
 * (docs/scene-format.md); those that have no effect on the input at hand are ignored. What changes
 * the result starts the run anew, and nothing else does.
 *
 * Progress is that towards the time asked for. Aborted, or where the run cannot go on, which is an
 * error, the outputs are those of the last good state; its time, in the information (DATA_TIME_STEP)
 * and the field data t, tells. AbortExecuteOn() ends the update that goes on, for all output ports
 * that ask for its time; the next update goes on from there.
 *
 * Input: vtkImageData, of up to 512 nodes along each axis, with its axes along x, y and z in any order
 * and sign. Only its first time step is used. The solver's grid has multiples of 8 nodes, equally spaced
 * along x, y, z: other images are resampled to the smallest of their spacings and widened by whole
 * nodes, also where the membrane is near a side, and a warning says so. Point data, or cell data, of one
 * component each:
 * - phi (another name: SetPhiArray; an image's only array is taken whatever its name), negative
 *   inside, positive at all sides of the box. It need not be a distance, but should be smooth; or a
 *   mask of two values, inside where it is negative, else where it is larger, which is smoothed.
 *   vtkVesicleFromImage takes labels, and masks that are inverted or of the membrane alone.
 * - psi, optional: phases, negative in Ld, positive in Lo
 * - c, optional: local stretch, where StretchModulus is not 0
 *
 * Output 0: vtkImageData. Point data:
 * | array | type, components | meaning |
 * |-------|------------------|---------|
 * | phi   | double, 1        | level set, negative inside; the scalars |
 * | psi   | double, 1        | with phases |
 * | c     | double, 1        | with local stretch |
 *
 * The origin moves where the box followed the vesicle. Field data, one number each: the measures of
 * the state, named as the columns of output 1, and what the forces depend on, for the filters to come:
 * `membrane.bending_modulus`, `membrane.spontaneous_curvature`; with phases those of `ld.`, `lo.` and
 * `line.`; with local stretch and films those of `stretch.` and `contact.`.
 *
 * Output 1: vtkTable, the history as far as the run was computed, whatever the time of output 0: a row
 * for the start and every step, with the columns of history.csv (docs/command-line.md), all of them
 * double. Steps from a time step towards a time between two have no rows.
 *
 * Output 2: vtkTable, the events that the run had so far, a row each, with the columns of events.csv:
 * `kind` is text (fission, rupture, fusion, vanished, recentred, domains_merged, domain_parted,
 * domain_vanished, sharp, thin_inside, thin_outside), all others double; (`x`, `y`, `z`) is the place.
 *
 * Output 3: vtkTable, a row for each vesicle at the steps of output 1, while there are several that hold
 * something of their own (VolumeOf, AreaOf), with the columns of components.csv, all of them double.
 *
 * T. Zhang, C. W. Wolgemuth, J. Comput. Phys. 450 (2022) 110815.
 *
 * @sa vtkVesicleSource vtkVesicleFromImage vtkVesicleFromSurface vtkMembraneSurface
 */
#ifndef vtkVesicleDynamics_h
#define vtkVesicleDynamics_h

#include "vtkLamellaFiltersModule.h" // for the export macro

#include <vtkImageAlgorithm.h>

#include <memory>
#include <string>

namespace lamella
{
struct PropertyScene;
class UpdateRound;
}

class VTKLAMELLAFILTERS_EXPORT vtkVesicleDynamics : public vtkImageAlgorithm
{
public:
  static vtkVesicleDynamics* New();
  vtkTypeMacro(vtkVesicleDynamics, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Name of the level set's array. Default "phi". */
  vtkSetStdStringFromCharMacro(PhiArray);
  vtkGetCharFromStdStringMacro(PhiArray);
  ///@}

  ///@{
  /** [membrane] bending_modulus: bending modulus kappa: of half the square of K_M less
   * spontaneous_curvature (Helfrich). A number from 1e-30 to 1e+30; energy. Default 1. */
  void SetBendingModulus(double value);
  double GetBendingModulus();
  ///@}

  ///@{
  /** [membrane] spontaneous_curvature: C: preferred sum of the principal curvatures, which is -2 on
   * the unit sphere. A number from -1e+30 to 1e+30; 1/length. Default 0. */
  void SetSpontaneousCurvature(double value);
  double GetSpontaneousCurvature();
  ///@}

  ///@{
  /** [membrane] gaussian_modulus: kappa_G: of the Gaussian curvature K; only a difference between
   * phases has an effect on shapes. A number from -1e+30 to 1e+30; energy. Default 0. */
  void SetGaussianModulus(double value);
  double GetGaussianModulus();
  ///@}

  ///@{
  /** [membrane] linear_modulus: of K_M, the sum of the principal curvatures. A number from -1e+30
   * to 1e+30; energy/length. Default 0. */
  void SetLinearModulus(double value);
  double GetLinearModulus();
  ///@}

  ///@{
  /** [membrane] cubic_modulus: of K_M^3. A number from -1e+30 to 1e+30; energy length. Default 0. */
  void SetCubicModulus(double value);
  double GetCubicModulus();
  ///@}

  ///@{
  /** [membrane] mixed_cubic_modulus: of K_M K. A number from -1e+30 to 1e+30; energy length.
   * Default 0. */
  void SetMixedCubicModulus(double value);
  double GetMixedCubicModulus();
  ///@}

  ///@{
  /** [membrane] quartic_modulus: of K_M^4. A number from -1e+30 to 1e+30; energy length^2. Default
   * 0. */
  void SetQuarticModulus(double value);
  double GetQuarticModulus();
  ///@}

  ///@{
  /** [membrane] mixed_quartic_modulus: of K_M^2 K. A number from -1e+30 to 1e+30; energy length^2.
   * Default 0. */
  void SetMixedQuarticModulus(double value);
  double GetMixedQuarticModulus();
  ///@}

  ///@{
  /** [membrane] gaussian_square_modulus: of K^2. A number from -1e+30 to 1e+30; energy length^2.
   * Default 0. */
  void SetGaussianSquareModulus(double value);
  double GetGaussianSquareModulus();
  ///@}

  ///@{
  /** [membrane] gradient_modulus: of the square of the gradient of K_M along the membrane. A number from 0
   * to 1e+30; energy length^2. Default 0. */
  void SetGradientModulus(double value);
  double GetGradientModulus();
  ///@}

  ///@{
  /** [membrane] density: one more energy per area, a formula of KM and K. A text;
   * energy/length^2. Default none. */
  void SetDensity(const char* value);
  const char* GetDensity();
  ///@}

  ///@{
  /** [domains] curvature_start_time: cap, caps, frame: until then the spontaneous curvatures of
   * both phases are 0. A number from 0 to 1e+30; time. Default 0. */
  void SetDomainsCurvatureStartTime(double value);
  double GetDomainsCurvatureStartTime();
  ///@}

  ///@{
  /** [ld] bending_modulus: bending modulus kappa: of half the square of K_M less
   * spontaneous_curvature (Helfrich). A number from 1e-30 to 1e+30; energy. Default 1. */
  void SetLdBendingModulus(double value);
  double GetLdBendingModulus();
  ///@}

  ///@{
  /** [ld] spontaneous_curvature: C: preferred sum of the principal curvatures, which is -2 on the
   * unit sphere. A number from -1e+30 to 1e+30; 1/length. Default 0. */
  void SetLdSpontaneousCurvature(double value);
  double GetLdSpontaneousCurvature();
  ///@}

  ///@{
  /** [ld] gaussian_modulus: kappa_G: of the Gaussian curvature K; only a difference between phases
   * has an effect on shapes. A number from -1e+30 to 1e+30; energy. Default 0. */
  void SetLdGaussianModulus(double value);
  double GetLdGaussianModulus();
  ///@}

  ///@{
  /** [ld] linear_modulus: of K_M, the sum of the principal curvatures. A number from -1e+30 to
   * 1e+30; energy/length. Default 0. */
  void SetLdLinearModulus(double value);
  double GetLdLinearModulus();
  ///@}

  ///@{
  /** [ld] cubic_modulus: of K_M^3. A number from -1e+30 to 1e+30; energy length. Default 0. */
  void SetLdCubicModulus(double value);
  double GetLdCubicModulus();
  ///@}

  ///@{
  /** [ld] mixed_cubic_modulus: of K_M K. A number from -1e+30 to 1e+30; energy length. Default 0. */
  void SetLdMixedCubicModulus(double value);
  double GetLdMixedCubicModulus();
  ///@}

  ///@{
  /** [ld] quartic_modulus: of K_M^4. A number from -1e+30 to 1e+30; energy length^2. Default 0. */
  void SetLdQuarticModulus(double value);
  double GetLdQuarticModulus();
  ///@}

  ///@{
  /** [ld] mixed_quartic_modulus: of K_M^2 K. A number from -1e+30 to 1e+30; energy length^2.
   * Default 0. */
  void SetLdMixedQuarticModulus(double value);
  double GetLdMixedQuarticModulus();
  ///@}

  ///@{
  /** [ld] gaussian_square_modulus: of K^2. A number from -1e+30 to 1e+30; energy length^2. Default
   * 0. */
  void SetLdGaussianSquareModulus(double value);
  double GetLdGaussianSquareModulus();
  ///@}

  ///@{
  /** [ld] gradient_modulus: of the square of the gradient of K_M along the membrane. A number from 0
   * to 1e+30; energy length^2. Default 0. */
  void SetLdGradientModulus(double value);
  double GetLdGradientModulus();
  ///@}

  ///@{
  /** [ld] density: one more energy per area, a formula of KM and K. A text; energy/length^2.
   * Default none. */
  void SetLdDensity(const char* value);
  const char* GetLdDensity();
  ///@}

  ///@{
  /** [lo] bending_modulus: bending modulus kappa: of half the square of K_M less
   * spontaneous_curvature (Helfrich). A number from 1e-30 to 1e+30; energy. Default 1. */
  void SetLoBendingModulus(double value);
  double GetLoBendingModulus();
  ///@}

  ///@{
  /** [lo] spontaneous_curvature: C: preferred sum of the principal curvatures, which is -2 on the
   * unit sphere. A number from -1e+30 to 1e+30; 1/length. Default 0. */
  void SetLoSpontaneousCurvature(double value);
  double GetLoSpontaneousCurvature();
  ///@}

  ///@{
  /** [lo] gaussian_modulus: kappa_G: of the Gaussian curvature K; only a difference between phases
   * has an effect on shapes. A number from -1e+30 to 1e+30; energy. Default 0. */
  void SetLoGaussianModulus(double value);
  double GetLoGaussianModulus();
  ///@}

  ///@{
  /** [lo] linear_modulus: of K_M, the sum of the principal curvatures. A number from -1e+30 to
   * 1e+30; energy/length. Default 0. */
  void SetLoLinearModulus(double value);
  double GetLoLinearModulus();
  ///@}

  ///@{
  /** [lo] cubic_modulus: of K_M^3. A number from -1e+30 to 1e+30; energy length. Default 0. */
  void SetLoCubicModulus(double value);
  double GetLoCubicModulus();
  ///@}

  ///@{
  /** [lo] mixed_cubic_modulus: of K_M K. A number from -1e+30 to 1e+30; energy length. Default 0. */
  void SetLoMixedCubicModulus(double value);
  double GetLoMixedCubicModulus();
  ///@}

  ///@{
  /** [lo] quartic_modulus: of K_M^4. A number from -1e+30 to 1e+30; energy length^2. Default 0. */
  void SetLoQuarticModulus(double value);
  double GetLoQuarticModulus();
  ///@}

  ///@{
  /** [lo] mixed_quartic_modulus: of K_M^2 K. A number from -1e+30 to 1e+30; energy length^2.
   * Default 0. */
  void SetLoMixedQuarticModulus(double value);
  double GetLoMixedQuarticModulus();
  ///@}

  ///@{
  /** [lo] gaussian_square_modulus: of K^2. A number from -1e+30 to 1e+30; energy length^2. Default
   * 0. */
  void SetLoGaussianSquareModulus(double value);
  double GetLoGaussianSquareModulus();
  ///@}

  ///@{
  /** [lo] gradient_modulus: of the square of the gradient of K_M along the membrane. A number from 0
   * to 1e+30; energy length^2. Default 0. */
  void SetLoGradientModulus(double value);
  double GetLoGradientModulus();
  ///@}

  ///@{
  /** [lo] density: one more energy per area, a formula of KM and K. A text; energy/length^2.
   * Default none. */
  void SetLoDensity(const char* value);
  const char* GetLoDensity();
  ///@}

  ///@{
  /** [line] tension: line tension kappa_l: energy of the phase boundary per length. A number from 0
   * to 1e+30; energy/length. Default 0. */
  void SetLineTension(double value);
  double GetLineTension();
  ///@}

  ///@{
  /** [line] geodesic_modulus: kappa_g: energy per length and geodesic curvature. A number from
   * -1e+30 to 1e+30; energy. Default 0. */
  void SetLineGeodesicModulus(double value);
  double GetLineGeodesicModulus();
  ///@}

  ///@{
  /** [line] torsion_modulus: kappa_tau: energy per length and geodesic torsion. A number from
   * -1e+30 to 1e+30; energy. Default 0. */
  void SetLineTorsionModulus(double value);
  double GetLineTorsionModulus();
  ///@}

  ///@{
  /** [line] normal_modulus: kappa_n: energy per length and normal curvature. A number from -1e+30
   * to 1e+30; energy. Default 0. */
  void SetLineNormalModulus(double value);
  double GetLineNormalModulus();
  ///@}

  ///@{
  /** [line] geodesic_square_modulus: kappa_g2: energy per length and square of the geodesic
   * curvature, without a 1/2. A number from 0 to 1e+30; energy length. Default 0. */
  void SetLineGeodesicSquareModulus(double value);
  double GetLineGeodesicSquareModulus();
  ///@}

  ///@{
  /** [line] torsion_square_modulus: kappa_tau2: energy per length and square of the geodesic
   * torsion, without a 1/2. A number from 0 to 1e+30; energy length. Default 0. */
  void SetLineTorsionSquareModulus(double value);
  double GetLineTorsionSquareModulus();
  ///@}

  ///@{
  /** [line] normal_square_modulus: kappa_n2: energy per length and square of the normal curvature,
   * without a 1/2. A number from 0 to 1e+30; energy length. Default 0. */
  void SetLineNormalSquareModulus(double value);
  double GetLineNormalSquareModulus();
  ///@}

  ///@{
  /** [line] perpendicular_modulus: kappa_B: energy per length and curvature B_perp of the membrane
   * across the boundary. A number from -1e+30 to 1e+30; energy. Default 0. */
  void SetLinePerpendicularModulus(double value);
  double GetLinePerpendicularModulus();
  ///@}

  ///@{
  /** [line] drag: drag of the phase boundary along the membrane, per length, over that of the
   * membrane, per area; 0 stands for the radius of the sphere of the vesicle's area. A number from 0
   * to 1e+30; length. Default 0. */
  void SetLineDrag(double value);
  double GetLineDrag();
  ///@}

  ///@{
  /** [line] density: one more energy per length, a formula of kg, kn and tau_g. A text;
   * energy/length. Default none. */
  void SetLineDensity(const char* value);
  const char* GetLineDensity();
  ///@}

  ///@{
  /** [parameters]: numbers that densities name, as in "a = 3, C0 = -2". Default none. */
  void SetParameters(const char* value);
  const char* GetParameters();
  ///@}

  ///@{
  /** [[fields]]: scalars that move with the membrane, for densities to depend on, each as in
   * {name = "m", start = "z", carried = "value"}, several with commas between them. `start` is a
   * formula of x, y, z, or a point array of the image; without it, the array of the field's name.
   * Default none. */
  void SetFields(const char* value);
  const char* GetFields();
  ///@}

  ///@{
  /** [stretch] modulus: modulus mu that resists local stretch; 0: the membrane flows freely within
   * each phase. A number from 0 to 1e+30; energy/length^2. Default 0. */
  void SetStretchModulus(double value);
  double GetStretchModulus();
  ///@}

  ///@{
  /** [volume] constraint: fixed: as it is at the start; ramped: led to targets; free: under a
   * pressure. "fixed", "ramped", "free". Default "fixed". */
  void SetVolumeConstraint(const char* value);
  const char* GetVolumeConstraint();
  ///@}

  ///@{
  /** [volume] targets: ramped: reduced volumes to reach, one after the other; when to set out for
   * each: start_times, ascending. A number above 0 and up to 1. Default none. */
  void AddVolumeTarget(double target, double start_time);
  void RemoveAllVolumeTargets();
  int GetNumberOfVolumeTargets();
  ///@}

  ///@{
  /** [volume] rate: ramped: change of the reduced volume per unit of time; 0 stands for
   * 0.4 kappa / R^4, R the radius of the sphere of the vesicle's area. A number from 0 to 1e+30;
   * 1/time. Default 0. */
  void SetVolumeRate(double value);
  double GetVolumeRate();
  ///@}

  ///@{
  /** [volume] pressure: free: pressure inside less that outside. A number from -1e+30 to 1e+30;
   * energy/length^3. Default 0. */
  void SetVolumePressure(double value);
  double GetVolumePressure();
  ///@}

  ///@{
  /** [volume] of: fixed, ramped: each: every vesicle has its own volume, keeps it after parting, and
   * the sum after fusing; all: they have one together, water passes between them. "each", "all".
   * Default "each". */
  void SetVolumeOf(const char* value);
  const char* GetVolumeOf();
  ///@}

  ///@{
  /** [area] of: each: every vesicle has its own area, keeps it after parting, and the sum after
   * fusing; all: they have one together, lipid passes between them. "each", "all". Default
   * "each". */
  void SetAreaOf(const char* value);
  const char* GetAreaOf();
  ///@}

  ///@{
  /** [area_difference] constraint: fixed: as it is at the start; ramped: led to targets; free:
   * under a multiplier. "fixed", "ramped", "free". Default "free". */
  void SetAreaDifferenceConstraint(const char* value);
  const char* GetAreaDifferenceConstraint();
  ///@}

  ///@{
  /** [area_difference] targets: ramped: reduced area differences to reach, one after the other; 1
   * for a sphere; when to set out for each: start_times, ascending. A number above 0 and up to
   * 100. Default none. */
  void AddAreaDifferenceTarget(double target, double start_time);
  void RemoveAllAreaDifferenceTargets();
  int GetNumberOfAreaDifferenceTargets();
  ///@}

  ///@{
  /** [area_difference] rate: ramped: change of the reduced area difference per unit of time; 0
   * stands for 0.4 kappa / R^4, R the radius of the sphere of the vesicle's area. A number from 0 to
   * 1e+30; 1/time. Default 0. */
  void SetAreaDifferenceRate(double value);
  double GetAreaDifferenceRate();
  ///@}

  ///@{
  /** [area_difference] multiplier: free: coefficient of the Gaussian curvature in the outward
   * normal velocity. A number from -1e+30 to 1e+30; energy/length. Default 0. */
  void SetAreaDifferenceMultiplier(double value);
  double GetAreaDifferenceMultiplier();
  ///@}

  ///@{
  /** [contact] topology_changes: whether necks pinch and films rupture; if not, the run stops where
   * one is about to. True or false. Default true. */
  void SetContactTopologyChanges(bool value);
  bool GetContactTopologyChanges();
  vtkBooleanMacro(ContactTopologyChanges, bool);
  ///@}

  ///@{
  /** [contact] disjoining_pressure: pressure that holds films of inner fluid open, at zero
   * thickness; 0: none. A number from 0 to 1e+30; energy/length^3. Default 0. */
  void SetContactDisjoiningPressure(double value);
  double GetContactDisjoiningPressure();
  ///@}

  ///@{
  /** [contact] disjoining_range: thickness over which it falls by a factor e; 0 stands for a 25th
   * of the radius of the sphere of the vesicle's area. A number from 0 to 1e+30; length. Default
   * 0. */
  void SetContactDisjoiningRange(double value);
  double GetContactDisjoiningRange();
  ///@}

  ///@{
  /** [contact] rupture_thickness: films as thin as this rupture; 0: as thin as the grid can
   * resolve. A number from 0 to 1e+30; length. Default 0. */
  void SetContactRuptureThickness(double value);
  double GetContactRuptureThickness();
  ///@}

  ///@{
  /** [run] end_time: when the run ends; it starts at 0; 0 stands for 1.6e-3 half_width^4 / kappa. A
   * number from 0 to 1e+30; time. Default 0. */
  void SetEndTime(double value);
  double GetEndTime();
  ///@}

  ///@{
  /** [stop] energy_rate: the run ends earlier, at rest, where the relative rate of the energy falls
   * below this; 0: never. A number from 0 to 1e+30; 1/time. Default 0. */
  void SetStopEnergyRate(double value);
  double GetStopEnergyRate();
  ///@}

  ///@{
  /** [stop] residual_force: the same for the largest normal velocity; given both, both must hold;
   * 0: never. A number from 0 to 1e+30; length/time. Default 0. */
  void SetStopResidualForce(double value);
  double GetStopResidualForce();
  ///@}

  ///@{
  /** [stop] topology_changes: the run ends after so many pinches and ruptures; 0: never. An integer
   * from 0 to 1000000. Default 0. */
  void SetStopTopologyChanges(int value);
  int GetStopTopologyChanges();
  ///@}

  ///@{
  /** [stop] wall_time: the run ends after so long by the clock; 0: never. A number from 0 to 1e+30;
   * seconds. Default 0. */
  void SetStopWallTime(double value);
  double GetStopWallTime();
  ///@}

  ///@{
  /** [numerics] tolerance: time error allowed per step, rms over the membrane. A number above 0 and
   * up to 0.1; grid spacings. Default 0.005. */
  void SetTolerance(double value);
  double GetTolerance();
  ///@}

  ///@{
  /** [numerics] max_time_step: longest step; 0 stands for end_time / 16. A number from 0 to 1e+30;
   * time. Default 0. */
  void SetMaxTimeStep(double value);
  double GetMaxTimeStep();
  ///@}

  ///@{
  /** [output] frames: stored states, equally spaced in time, start and end included. An integer
   * from 2 to 100000. Default 11. */
  void SetOutputFrames(int value);
  int GetOutputFrames();
  ///@}

  /** Later than the last update for as long as that was aborted. */
  vtkMTimeType GetMTime() override;

protected:
  vtkVesicleDynamics();
  ~vtkVesicleDynamics() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkVesicleDynamics(const vtkVesicleDynamics&) = delete;
  void operator=(const vtkVesicleDynamics&) = delete;

  class Run;
  void BeginRunIfNeeded(vtkImageData& image);

  std::string PhiArray = "phi";
  std::unique_ptr<lamella::PropertyScene> Scene;
  std::unique_ptr<Run> Current;
  std::unique_ptr<lamella::UpdateRound> Round;
};

#endif
