#pragma once
#include <cstddef>
#include <vector>

/// The inner loops, compiled once for each instruction set and chosen when the program starts.
/// They know arrays and numbers only; what the numbers mean is said in levelset/ and geometry/.
namespace lamella {

/// Periodic tensor-product B-spline of degree 7, f(x) = sum c_ijk B(x - x_i) B(y - y_j) B(z - z_k),
/// with coefficients at the nodes of a grid (x fastest).
struct SplineView {
  const double* coefficients;
  int nodes[3];
  double origin[3]; ///< position of node 0
  double inv_spacing;
};

/// Points as separate coordinate arrays.
struct Points {
  double *x, *y, *z;
};
struct ConstPoints {
  const double *x, *y, *z;
};

/// Arrays of one value a point. Those down to K come from derivatives up to order 2, the others
/// from order 4; where a group of pointers is null, it is not wanted.
struct SurfaceArrays {
  double* phi;                 ///< value of the spline
  double *nx, *ny, *nz, *grad; ///< unit normal and |grad phi|
  double *KM, *K;              ///< sum and product of the principal curvatures of the level surface
  double* lap_KM;              ///< surface Laplacian of KM
  double* slope2;              ///< |grad_s KM|^2
  double* grad_KM[3] = {};     ///< surface gradient of KM, x, y, z
  double* B[6] = {};           ///< curvature tensor (trace KM), xx, yy, zz, xy, xz, yz
  double* B_hess_KM = nullptr; ///< B : grad_s grad_s KM
  double* grad_K[3] = {};      ///< surface gradient of K
  double *lap_K = nullptr, *B_hess_K = nullptr; ///< Lap_s K, B : grad_s grad_s K
  double* hess_KM[6] = {};                      ///< grad_s grad_s KM, xx, yy, zz, xy, xz, yz
};

/// One step of the blended SBDF2/Euler scheme in Fourier space, for a row of modes along x.
struct SpectralRow {
  int modes;                ///< complex numbers in the row
  const double* kx2;        ///< squared wave numbers along x, each twice (real, imaginary part)
  const double* inv_symbol; ///< 1 / symbol of the spline along x, each twice
  double k2;                ///< squared wave number across the row
  double scale;             ///< 1 / (symbol across the row * number of nodes)
  double dt, ratio;         ///< step, step / previous step (0: no history, Euler)
  /// Implicit symbol: dt [gradient k^6 / (1 + levelling k^4) + stiffness k^4 + tension k^2].
  double gradient, levelling, stiffness, tension;
  double blend; ///< z0: modes with implicit symbol far above it take Euler
  double share; ///< of SBDF2, that stiff modes keep
  double fade;  ///< z1: beyond it modes lose that too
};

struct Kernels {
  const char* name;

  /// Nodal values of one z-plane of a spline: f = FIR c.
  void (*nodal_plane)(const SplineView& spline, int k, double* scratch, double* out);

  /// Newton steps for the constrained nearest point: moves p towards the point of {f = 0} nearest
  /// to x. `step` receives the length of the last Newton step; with `verify` a last gradient step
  /// is taken and points that end further than half a spacing from the surface return to where they
  /// began with step < 0.
  void (*closest_points)(const SplineView& spline, std::size_t n, ConstPoints x, Points p,
                         int iterations, bool verify, double* step);

  /// SurfaceArrays down to K, at points.
  void (*curvatures)(const SplineView& spline, std::size_t n, ConstPoints p,
                     const SurfaceArrays& out);

  /// SurfaceArrays down to slope2, grad_KM and B where they are wanted.
  void (*jets)(const SplineView& spline, std::size_t n, ConstPoints p, const SurfaceArrays& out);
  /// All of SurfaceArrays; hess_KM where it is wanted.
  void (*full_jets)(const SplineView& spline, std::size_t n, ConstPoints p,
                    const SurfaceArrays& out);

  /// Values at points.
  void (*values)(const SplineView& spline, std::size_t n, ConstPoints p, double* out);

  /// Value, gradient (x, y, z) and Hessian (xx, yy, zz, xy, xz, yz) at points: out has ten arrays
  /// of n numbers, one after the other.
  void (*taylor)(const SplineView& spline, std::size_t n, ConstPoints p, double* out);

  /// Third derivatives (xxx, xxy, xxz, xyy, xyz, xzz, yyy, yyz, yzz, zzz) at points: out has ten
  /// arrays of n numbers.
  void (*third)(const SplineView& spline, std::size_t n, ConstPoints p, double* out);

  /// Quasi-interpolant of nodal data: cubic B-spline with the data as coefficients, at points.
  void (*cubic)(const SplineView& data, std::size_t n, ConstPoints p, double* out);

  /// rate (in: transform of nodal rates; out: transform of the coefficient increment), with the
  /// history rows rate_old and increment_old brought up to date. The last increment was
  /// increment_old + correction_factor correction.
  void (*spectral_row)(const SpectralRow& row, double* rate, double* rate_old,
                       double* increment_old, const double* correction, double correction_factor);

  /// rate (in: transform of nodal rates; out: transform of the increment of one semi-implicit Euler
  /// step).
  void (*euler_row)(const SpectralRow& row, double* rate);
};

/// The best kernels for this CPU; LAMELLA_KERNELS=baseline|avx2|avx512 in the environment
/// overrides.
const Kernels& kernels();

/// All that this CPU can run, the best one last.
std::vector<const Kernels*> available_kernels();

} // namespace lamella
