#include "levelset/extension.h"

#include "parallel.h"

#include <algorithm>
#include <cmath>

namespace lamella {

namespace {

/// Piecewise-linear interpolation of one plane (k) of a cell-centred lattice twice as fine,
/// periodic. `row(j, k)` gives coarse rows; out has 2 m[1] rows of 2 m[0] numbers, handed to `put`
/// one by one.
template <class Put>
void interpolate_plane(const double* coarse, const int* m, int k, Array<double>& line, Put&& put) {
  auto side = [](int i, int n) { return i & 1 ? (i / 2 + 1) % n : (i / 2 + n - 1) % n; };
  auto row = [&](int j, int kk) { return coarse + (std::size_t(kk) * m[1] + j) * m[0]; };
  line.resize(m[0] + 2 + 2 * m[0]);
  double *mixed = line.data() + 1, *out = line.data() + m[0] + 2;
  const int k0 = k / 2, k1 = side(k, m[2]);
  for (int j = 0; j < 2 * m[1]; j++) {
    const int j0 = j / 2, j1 = side(j, m[1]);
    const double *a = row(j0, k0), *b = row(j1, k0), *c = row(j0, k1), *d = row(j1, k1);
    for (int i = 0; i < m[0]; i++)
      mixed[i] = 0.5625 * a[i] + 0.1875 * (b[i] + c[i]) + 0.0625 * d[i];
    mixed[-1] = mixed[m[0] - 1];
    mixed[m[0]] = mixed[0];
    for (int i = 0; i < m[0]; i++) {
      out[2 * i] = 0.75 * mixed[i] + 0.25 * mixed[i - 1];
      out[2 * i + 1] = 0.75 * mixed[i] + 0.25 * mixed[i + 1];
    }
    put(j, out);
  }
}

} // namespace

Extension::Extension(const Grid& grid) : grid_(grid) {
  int n[3] = {grid.nx(), grid.ny(), grid.nz()};
  while (n[0] % 2 == 0 && n[1] % 2 == 0 && n[2] % 2 == 0 && std::min({n[0], n[1], n[2]}) > 3) {
    for (int& m : n) m /= 2;
    const std::size_t size = std::size_t(n[0]) * n[1] * n[2];
    levels_.push_back({{n[0], n[1], n[2]}, Array<double>(size), Array<double>(size)});
  }
}

void Extension::prepare(const NarrowBand& band, std::span<const char> known) {
  borrowers_.clear();
  for (std::size_t s = 0; s < band.size(); s++)
    if (!known[s]) borrowers_.push_back({int(s), {}, {}});
  const ConstPoints p = band.points();
  const double inv_h = 1 / grid_.spacing,
               origin[3] = {grid_.origin(0), grid_.origin(1), grid_.origin(2)};
  parallel_for(borrowers_.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; b++) {
      Borrower& borrower = borrowers_[b];
      const double at[3] = {p.x[borrower.entry], p.y[borrower.entry], p.z[borrower.entry]};
      int base[3];
      double t[3], sum = 0;
      bool inside = true;
      for (int d = 0; d < 3; d++) {
        const double r = (at[d] - origin[d]) * inv_h;
        base[d] = int(std::floor(r));
        t[d] = r - base[d];
        inside = inside && base[d] >= 0 && base[d] + 1 < grid_.nodes[d];
      }
      for (int corner = 0; inside && corner < 8; corner++) {
        const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
        const int m = band.slot(grid_.index(base[0] + dx, base[1] + dy, base[2] + dz));
        if (m < 0 || !known[m]) continue;
        borrower.corner[corner] = m;
        borrower.weight[corner] =
            (dx ? t[0] : 1 - t[0]) * (dy ? t[1] : 1 - t[1]) * (dz ? t[2] : 1 - t[2]);
        sum += borrower.weight[corner];
      }
      if (sum > 0)
        for (double& w : borrower.weight) w /= sum;
    }
  });
}

void Extension::complete(double fallback, std::span<double> value) const {
  parallel_for(borrowers_.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; b++) {
      const Borrower& borrower = borrowers_[b];
      double sum = 0, weight = 0;
      for (int corner = 0; corner < 8; corner++) {
        if (borrower.weight[corner] == 0) continue; // its corner may hold no value
        sum += borrower.weight[corner] * value[borrower.corner[corner]];
        weight += borrower.weight[corner];
      }
      value[borrower.entry] = weight > 0 ? sum : fallback;
    }
  });
}

void Extension::fill(const NarrowBand& band, std::span<const double> value,
                     std::span<const double> weight) {
  band_ = &band;
  weight_ = weight;
  tapered_.resize(band.size());
  Level& first = levels_.front();
  const std::size_t plane = std::size_t(first.nodes[0]) * first.nodes[1];
  parallel_for(first.nodes[2], 1, [&](std::size_t k, std::size_t) {
    double *v = &first.value[k * plane], *w = &first.weight[k * plane];
    std::fill_n(v, plane, 0.0);
    std::fill_n(w, plane, 0.0);
    for (int s = band.plane_begin(int(2 * k)); s < band.plane_begin(int(2 * k) + 2); s++) {
      tapered_[s] = weight[s] * value[s];
      const int node = band.node()[s], i = node % grid_.nx(), j = node / grid_.nx() % grid_.ny();
      const std::size_t cell = std::size_t(j / 2) * first.nodes[0] + i / 2;
      v[cell] += tapered_[s];
      w[cell] += weight[s];
    }
    for (std::size_t i = 0; i < plane; i++) {
      const double f = w[i] > 1 ? 1 / w[i] : 1;
      v[i] *= f;
      w[i] *= f;
    }
  });
  for (std::size_t l = 1; l < levels_.size(); l++) push(levels_[l - 1], levels_[l]);
  Level& last = levels_.back();
  double v = 0, w = 0;
  for (std::size_t i = 0; i < last.value.size(); i++) {
    v += last.value[i];
    w += last.weight[i];
  }
  for (std::size_t i = 0; i < last.value.size(); i++)
    last.value[i] += (1 - last.weight[i]) * (w > 0 ? v / w : 0);
  for (std::size_t l = levels_.size() - 1; l > 0; l--) pull(levels_[l], levels_[l - 1]);
}

/// Sums of eight cells, scaled back where the weights add up to more than 1.
void Extension::push(const Level& fine, Level& coarse) const {
  parallel_for(coarse.nodes[2], 2, [&](std::size_t begin, std::size_t end) {
    for (int k = int(begin); k < int(end); k++)
      for (int j = 0; j < coarse.nodes[1]; j++)
        for (int i = 0; i < coarse.nodes[0]; i++) {
          double v = 0, w = 0;
          for (int corner = 0; corner < 8; corner++) {
            const std::size_t e =
                fine.row(2 * j + (corner >> 1 & 1), 2 * k + (corner >> 2)) + 2 * i + (corner & 1);
            v += fine.value[e];
            w += fine.weight[e];
          }
          const double f = w > 1 ? 1 / w : 1;
          const std::size_t e = coarse.row(j, k) + i;
          coarse.value[e] = v * f;
          coarse.weight[e] = w * f;
        }
  });
}

/// Fills what the fine level lacks from the coarse one.
void Extension::pull(const Level& coarse, Level& fine) const {
  parallel_for(fine.nodes[2], 2, [&](std::size_t begin, std::size_t end) {
    Array<double> line;
    for (int k = int(begin); k < int(end); k++)
      interpolate_plane(coarse.value.data(), coarse.nodes, k, line, [&](int j, const double* row) {
        double* v = &fine.value[fine.row(j, k)];
        const double* w = &fine.weight[fine.row(j, k)];
        for (int i = 0; i < fine.nodes[0]; i++) v[i] += (1 - w[i]) * row[i];
      });
  });
}

void Extension::plane(int k, double* out) const {
  thread_local Array<double> line;
  const Level& coarse = levels_.front();
  interpolate_plane(coarse.value.data(), coarse.nodes, k, line, [&](int j, const double* row) {
    std::copy_n(row, grid_.nx(), out + std::size_t(j) * grid_.nx());
  });
  const std::size_t first = std::size_t(k) * grid_.nx() * grid_.ny();
  for (int s = band_->plane_begin(k); s < band_->plane_begin(k + 1); s++) {
    double& v = out[band_->node()[s] - first];
    v = tapered_[s] + (1 - weight_[s]) * v;
  }
}

} // namespace lamella
