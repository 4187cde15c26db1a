/**
 * @class vtkMembraneMeasures
 * @brief area, volume, energies, multipliers and topology of a membrane, a row for each time
 *
 * Measures the membrane {phi = 0} as the solver does: integrals over a spline of degree seven, right
 * to about 1e-6 of smooth shapes that the grid resolves. An input with time steps is measured at each
 * of them.
 *
 * Input: vtkImageData as for vtkMembraneSurface, phi, and psi where there are two phases. Field data
 * takes precedence over the properties, see there; `energy`, its terms, `P` and `sigma` in it, of a
 * state of vtkVesicleDynamics or of a reader, are passed on.
 *
 * Output: vtkTable, columns of double:
 * | column         | meaning, unit |
 * |----------------|---------------|
 * | t              | time of the input |
 * | energy         | all terms that the field data tells, else bending_energy; energy |
 * | bending_energy | bending_modulus / 2 int (K_M - spontaneous_curvature)^2 dA, of both phases; energy |
 * | int_KM2        | int K_M^2 dA, K_M = -2 on the unit sphere |
 * | P              | pressure inside less that outside: the field data's, else the one that holds the volume of a single phase, with volume and area fixed; NaN with two phases; energy / length^3 |
 * | sigma          | the same for the tension, which holds the area; energy / length^2 |
 * | A, V           | area; length^2; volume; length^3 |
 * | v              | reduced volume, V / (4/3 pi Rs^3), Rs = sqrt(A / 4 pi) |
 * | Da             | reduced area difference, -int K_M dA / (8 pi Rs), 1 for a sphere |
 * | components     | connected parts of the inside |
 * | genus          | handles, summed over the components |
 * | neck_radius    | of the thinnest neck that is less than twelve spacings in radius; NaN where there is none; length |
 *
 * With psi there are also:
 * | column                 | meaning, unit |
 * |------------------------|---------------|
 * | A_Ld, A_Lo             | areas of the phases, right to about 1e-4; length^2 |
 * | bending_Ld, bending_Lo | bending energies of the phases; energy |
 * | line_length            | of the phase boundary; length |
 *
 * And the other terms of the energy, those that the field data tells (docs/command-line.md):
 * | column | meaning; energy |
 * |--------|-----------------|
 * | gaussian_energy | sum of gaussian_modulus int K dA |
 * | line_energy | of the phase boundary, the sum of the next seven |
 * | line_tension_energy, kg_energy, kn_energy, tau_g_energy | term by term |
 * | kg2_energy, kn2_energy, tau_g2_energy | those of the squares |
 * | stretch_energy | of local stretch |
 * | pressure_energy, area_difference_energy | of a given pressure, or multiplier |
 * | film_energy | of the disjoining pressure of films |
 *
 * Aborted, the table has the rows so far; the next update measures anew.
 *
 * @sa vtkMembraneSurface vtkVesicleDynamics
 */
#ifndef vtkMembraneMeasures_h
#define vtkMembraneMeasures_h

#include "vtkLamellaFiltersModule.h" // for the export macro

#include <vtkSmartPointer.h> // for the rows so far
#include <vtkTableAlgorithm.h>

#include <memory>
#include <string>
#include <vector>

namespace lamella
{
class Unfinished;
}

class VTKLAMELLAFILTERS_EXPORT vtkMembraneMeasures : public vtkTableAlgorithm
{
public:
  static vtkMembraneMeasures* New();
  vtkTypeMacro(vtkMembraneMeasures, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Name of the level set's array. Default "phi". */
  vtkSetStdStringFromCharMacro(PhiArray);
  vtkGetCharFromStdStringMacro(PhiArray);
  ///@}

  ///@{
  /** Bending modulus, where the input does not tell it; energy. Default 1. */
  vtkSetMacro(BendingModulus, double);
  vtkGetMacro(BendingModulus, double);
  ///@}

  ///@{
  /** The same for the spontaneous curvature, in the sign of K_M; 1 / length. Default 0. */
  vtkSetMacro(SpontaneousCurvature, double);
  vtkGetMacro(SpontaneousCurvature, double);
  ///@}

  /** Later than the last update for as long as that was aborted. */
  vtkMTimeType GetMTime() override;

protected:
  vtkMembraneMeasures();
  ~vtkMembraneMeasures() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;

private:
  vtkMembraneMeasures(const vtkMembraneMeasures&) = delete;
  void operator=(const vtkMembraneMeasures&) = delete;

  std::string PhiArray = "phi";
  double BendingModulus = 1;
  double SpontaneousCurvature = 0;

  std::vector<double> Times;           // of the input
  std::size_t Next = 0;                // among them
  vtkSmartPointer<vtkTable> Collected; // rows of those before
  std::unique_ptr<lamella::Unfinished> Unfinished;
};

#endif
