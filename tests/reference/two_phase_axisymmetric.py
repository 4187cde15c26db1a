#!/usr/bin/env python3
"""Sharp-interface axisymmetric equilibria of two-phase vesicles: the source of data/reference/two_phase_more.csv.

Makes  E = sum_i [kappa_i/2 int (K_M - C_i)^2 dA + kG_i int K dA] + oint (kappa_l + kappa_g kg + kappa_n kn
+ kappa_g2 kg^2 + kappa_n2 kn^2) dl  stationary at fixed V, A_Ld and A_Lo.  K_M = -2 on the unit sphere; kg < 0 on a small circle around an Ld cap.

    python3 two_phase_axisymmetric.py                 the table of data/reference
    python3 two_phase_axisymmetric.py C1 C9           the rows of some cases
    python3 two_phase_axisymmetric.py --profile C3    s, r, z, psi, -K_M from the Ld pole to the Lo pole
    python3 two_phase_axisymmetric.py --check         the checks below
Needs numpy, and scipy for --check.  It is no part of the build.  All cases take 3 s on one core, all checks 15 s.

Columns: energies with their factors 1/2, E_G of kG with its topological part, r_boundary, the multipliers P and
sigma as in f_N = ... + sigma K_M + P, psi_boundary_deg the meridian's angle from the Ld pole (90: the boundary is
where r is extremal), r_neck_min the least r between the poles where r has a minimum (nan: there is no neck),
max_error_estimate the largest change of E_*, r, P, sigma from doubling the number of polynomials.

Method.  Each phase is a meridian psi(s) from its own pole to the boundary with r' = cos psi and
-K_M = psi' + sin psi / r, psi a sum of odd Chebyshev polynomials in s/l (so that the pole is smooth), integrals
by Gauss-Legendre.  Unknowns: coefficients, the two lengths l, and multipliers of V, A_Ld, A_Lo, of equal radii and
of psi_Ld + psi_Lo = pi at the boundary.  All conditions at the boundary, couple included, are the natural ones of
the energy: none is written down.  The Lagrangian's gradient is coded by hand, its Hessian is the gradient's
complex-step derivative.  An implicit gradient flow from two spherical caps with the right areas and volume finds
the branch and ends as Newton's method; the Hessian must be positive on the constraints (a minimum among
axisymmetric shapes; other shapes are not looked at).

Checks.  The gradient against complex steps of the energies; C1, C2, C5 against two_phase.csv; C7 against a jump of
kG; the same branch from v = 0.995 downwards; 3 P V = 2 sum sigma A + kappa_l L (with C's part added); the
Euler-Lagrange equations and the forces and the couple at the boundary in their strong form; and the energy of
polygons without multipliers or hand-made derivatives, minimised by sequential quadratic programming and extrapolated.
"""
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.polynomial import chebyshev, legendre

PI = np.pi
RADIUS = 0.98  # of the sphere with the vesicle's area


@dataclass
class Case:
    """x: area fraction of Ld, v: reduced volume; pairs are (Ld, Lo)."""

    name: str
    x: float
    v: float
    kl: float
    kappa: tuple = (1.0, 1.0)
    kG: tuple = (0.0, 0.0)
    C: tuple = (0.0, 0.0)
    kg: float = 0.0
    kn: float = 0.0
    kg2: float = 0.0
    kn2: float = 0.0
    radius: float = RADIUS

    def area(self):
        a = 4 * PI * self.radius**2
        return np.array([a * self.x, a * (1 - self.x)])

    def volume(self):
        return self.v * 4 / 3 * PI * self.radius**3


CASES = [
    Case("C1_x0.2_v0.90_kl30", 0.2, 0.9, 30),
    Case("C2_x0.5_v0.80_kl10", 0.5, 0.8, 10),
    Case("C5_x0.5_v0.80_kl10_k5", 0.5, 0.8, 10, kappa=(1, 5)),
    Case("C3_x0.5_v0.80_kl10_kG2", 0.5, 0.8, 10, kG=(2, 0)),
    Case("C4_x0.2_v0.90_kl30_kG3.6", 0.2, 0.9, 30, kG=(3.6, 0)),
    Case("C6_x0.2_v0.90_kl30_k5", 0.2, 0.9, 30, kappa=(1, 5)),
    Case("C7_x0.5_v0.80_kl10_kg3", 0.5, 0.8, 10, kg=3),
    Case("C8_x0.5_v0.80_kl10_kn2", 0.5, 0.8, 10, kn=2),  # C2's shape: kn = -1/r and kg = 0 on the plane of symmetry
    Case("C8b_x0.2_v0.90_kl30_kn2", 0.2, 0.9, 30, kn=2),
    Case("C9_x0.2_v0.90_kl30_CLd-3", 0.2, 0.9, 30, C=(-3, 0)),
    Case("C10_x0.56_v0.76_kl70_k5_kG3.6", 0.56, 0.76, 70, kappa=(1, 5), kG=(3.6, 0)),
    Case("C11_x0.2_v0.95_kl10_k10", 0.2, 0.95, 10, kappa=(1, 10)),
    Case("C12_x0.2_v0.90_kl30_kgg1", 0.2, 0.9, 30, kg2=1),
    Case("C13_x0.2_v0.90_kl30_knn0.3", 0.2, 0.9, 30, kn2=0.3),
    Case("C14_x0.3_v0.85_kl20_all", 0.3, 0.85, 20, kg=0.5, kn=-1, kg2=0.5, kn2=0.4),
]


class Basis:
    """n odd Chebyshev polynomials on [0, 1] at m Gauss-Legendre points: values B, derivatives D, weights w, and
    Q with (Q f)_j = int_0^{x_j} f."""

    def __init__(self, n):
        self.n, m = n, 3 * n
        t, w = legendre.leggauss(m)
        self.x, self.w = (t + 1) / 2, w / 2
        eye = np.eye(2 * n)[:, 1::2]
        self.B = chebyshev.chebvander(self.x, 2 * n - 1) @ eye
        self.D = chebyshev.chebvander(self.x, 2 * n - 2) @ chebyshev.chebder(eye)
        vander = legendre.legvander(t, m)
        to_legendre = (np.arange(m) + 0.5)[:, None] * vander[:, :m].T * w
        degree = np.arange(1, m)
        integral = np.empty((m, m))  # of Legendre polynomials from -1 to t
        integral[:, 0] = t + 1
        integral[:, 1:] = (vander[:, degree + 1] - vander[:, degree - 1]) / (2 * degree + 1)
        self.Q = integral @ to_legendre / 2
        self.to_legendre = to_legendre

    def derivative(self, f, end=False):
        """f'(x) at the points, or f and f' at x = 1, for values f at the points."""
        a = self.to_legendre @ f
        d = legendre.legder(a) * 2
        return (legendre.legval(1, a), legendre.legval(1, d)) if end else legendre.legval(2 * self.x - 1, d)


def meridian(basis, c, l):
    """psi, psi', r at the points, radius and angle at the boundary; leading axes of c and l are kept."""
    psi = c @ basis.B.T
    p = c @ basis.D.T / l[..., None]
    cosine = np.cos(psi)
    r = l[..., None] * (cosine @ basis.Q.T)
    return psi, p, r, l * (cosine @ basis.w), c.sum(-1)


def phase_gradient(basis, c, l, kappa, C, sigma, P, d_rb, d_psib):
    """Gradient with respect to (c, l) of one phase's bending energy + sigma A - P V + d_rb r_b + d_psib psi_b,
    and A, V, r_b, psi_b.  Complex arguments and leading axes are allowed."""
    w = basis.w
    psi, p, r, rb, psib = meridian(basis, c, l)
    S, K = np.sin(psi), np.cos(psi)
    sg, Pq, lq = sigma[..., None], P[..., None], l[..., None]
    q = p + S / r + C
    density = PI * kappa * r * q * q + 2 * PI * sg * r - PI * Pq * r * r * S
    g_r = lq * w * (PI * kappa * q * q - 2 * PI * kappa * q * S / r + 2 * PI * sg - 2 * PI * Pq * r * S)
    g_p = lq * w * 2 * PI * kappa * r * q
    g_psi = lq * w * (2 * PI * kappa * q * K - PI * Pq * r * r * K)
    g_psi = g_psi - S * lq * (g_r @ basis.Q + d_rb[..., None] * w)
    g_c = g_psi @ basis.B + (g_p / lq) @ basis.D + d_psib[..., None]
    g_l = density @ w + ((g_r * (K @ basis.Q.T)).sum(-1) - (g_p * p).sum(-1) / l) + d_rb * (K @ w)
    return g_c, g_l, 2 * PI * l * (r @ w), PI * l * ((r * r * S) @ w), rb, psib


class Problem:
    """Unknowns y = (c_Ld, l_Ld, c_Lo, l_Lo, P, sigma_Ld, sigma_Lo, f_r, f_psi)."""

    def __init__(self, case, n):
        self.case, self.basis, self.n = case, Basis(n), n
        self.primal = 2 * n + 2

    def split(self, y):
        n = self.n
        return y[..., :n], y[..., n], y[..., n + 1 : 2 * n + 1], y[..., 2 * n + 1], y[..., 2 * n + 2 :]

    def gradient(self, y):
        """Of E - P (V - V0) + sum sigma_i (A_i - A_i0) + f_r (r_Ld - r_Lo) + f_psi (psi_Ld + psi_Lo - pi)."""
        k = self.case
        c0, l0, c1, l1, m = self.split(y)
        P, s0, s1, f_r, f_psi = (m[..., j] for j in range(5))
        rb, psib = meridian(self.basis, c0, l0)[3:]
        S, C = np.sin(psib), np.cos(psib)
        # oint = 2 pi (kl r - kg cos psi - kn sin psi + (kg2 cos^2 psi + kn2 sin^2 psi) / r);
        # int K dA = 2 pi (1 - cos psi) and 2 pi (1 + cos psi)
        line_psi = (k.kG[0] - k.kG[1] + k.kg) * S - k.kn * C + 2 * (k.kn2 - k.kg2) * S * C / rb
        line_r = k.kl - (k.kg2 * C * C + k.kn2 * S * S) / (rb * rb)
        d_rb, d_psib = f_r + 2 * PI * line_r, f_psi + 2 * PI * line_psi
        a = phase_gradient(self.basis, c0, l0, k.kappa[0], k.C[0], s0, P, d_rb, d_psib)
        b = phase_gradient(self.basis, c1, l1, k.kappa[1], k.C[1], s1, P, -f_r, f_psi)
        area = k.area()
        constraints = (-(a[3] + b[3] - k.volume()), a[2] - area[0], b[2] - area[1], a[4] - b[4], a[5] + b[5] - PI)
        return np.concatenate([a[0], a[1][..., None], b[0], b[1][..., None], np.stack(constraints, -1)], -1)

    def hessian(self, y):
        h = 1e-30
        return self.gradient(y + 1j * h * np.eye(y.size)).imag / h

    def metric(self, y):
        """A positive matrix for damping: int r (psi'^2 + psi^2) for the coefficients, 1 for the lengths."""
        M = np.zeros((self.primal, self.primal))
        c0, l0, c1, l1, _ = self.split(y)
        n, B, D = self.n, self.basis.B, self.basis.D
        for k, (c, l) in enumerate(((c0, l0), (c1, l1))):
            w = 2 * PI * self.basis.w * np.maximum(meridian(self.basis, c, l)[2], 1e-3)
            j = k * (n + 1)
            M[j : j + n, j : j + n] = (D.T * w) @ D / l + (B.T * w) @ B * l
            M[j + n, j + n] = 20.0
        return M * max(self.case.kappa)

    def start(self):
        """Two spherical caps on a common circle with the case's areas and volume, their kink rounded."""
        k, n = self.case, self.n
        area, volume = k.area(), k.volume()

        def caps(rb):
            h = np.sqrt(area / PI - rb * rb)
            return h, (PI * h * (3 * rb * rb + h * h) / 6).sum()

        lo, hi = 0.0, np.sqrt(area.min() / PI) * (1 - 1e-12)
        rr = np.linspace(lo, hi, 4000)
        hi = rr[np.argmax([caps(t)[1] for t in rr])]
        for _ in range(60):
            mid = (lo + hi) / 2
            lo, hi = (mid, hi) if caps(mid)[1] < volume else (lo, mid)
        h, _ = caps(lo)
        angle = 2 * np.arctan(h / lo)
        excess = angle.sum() - PI
        y = np.zeros(self.primal + 5)
        x = np.linspace(0, 1, 400)
        V = chebyshev.chebvander(x, 2 * n - 1)[:, 1::2]
        for i in range(2):
            psi = angle[i] * x - excess / 2 * x**9
            j = i * (n + 1)
            y[j : j + n] = np.linalg.lstsq(V, psi, rcond=None)[0]
            y[j + n] = lo * angle[i] / np.sin(angle[i]) if abs(angle[i] - PI) > 0.05 else np.sqrt(PI * area[i]) / 2
        return y

    def relax(self, y, damping=10.0, steps=400, tol=1e-12):
        """Implicit gradient flow with growing time step that ends as Newton's method; y and its residual."""
        for _ in range(steps):
            g, H = self.gradient(y), self.hessian(y)
            residual = np.abs(g).max() / (np.abs(y[self.primal :]).max() + 10)
            if residual < tol and damping == 0:
                break
            damping = damping / 2.5 if residual > 1e-4 else 0.0
            M = self.metric(y)
            for attempt in range(40):
                A = H.copy()
                A[: self.primal, : self.primal] += damping * M
                d = np.linalg.solve(A, -g)
                move = max(np.abs(self.basis.B @ d[j : j + self.n]).max() for j in (0, self.n + 1))
                if self.convex(A) and (move < 0.15 or attempt > 8):
                    break
                damping = max(damping * 3, 1e-5)
            y = y + d * min(1, 0.15 / move)
        return y + np.linalg.solve(H, -g), residual

    def convex(self, A):
        """Whether the first block is positive on the constraints' null space (inertia of the bordered matrix)."""
        e = np.linalg.eigvalsh((A + A.T) / 2)
        return (e < 0).sum() == 5

    def energies(self, y):
        k = self.case
        c0, l0, c1, l1, m = self.split(y)
        out, necks = {}, []
        for i, (c, l) in enumerate(((c0, l0), (c1, l1))):
            psi, p, r, rb, psib = meridian(self.basis, c, l)
            q = p + np.sin(psi) / r + k.C[i]
            out["E_bend_" + ("Ld", "Lo")[i]] = PI * k.kappa[i] * l * (r * q * q) @ self.basis.w
            if i == 0:
                r_b, psi_b = rb, psib
            necks += neck_radii(self.basis, c, l) + ([rb] if abs(np.cos(psib)) < 1e-9 else [])
        cb, sb = np.cos(psi_b), np.sin(psi_b)
        out["E_line"] = 2 * PI * k.kl * r_b
        out["E_G"] = 2 * PI * (k.kG[0] * (1 - cb) + k.kG[1] * (1 + cb))
        out["E_kg"], out["E_kn"] = -2 * PI * k.kg * cb, -2 * PI * k.kn * sb
        out["E_kg2"], out["E_kn2"] = 2 * PI * k.kg2 * cb * cb / r_b, 2 * PI * k.kn2 * sb * sb / r_b
        out["E_total"] = sum(out.values())
        out.update(r_boundary=r_b, P=m[0], sigma_Ld=m[1], sigma_Lo=m[2])
        out.update(psi_boundary_deg=np.degrees(psi_b), r_neck_min=min(necks, default=np.nan))
        return out

    def scale_identity(self, y):
        """3 P V - 2 sum sigma A - kappa_l L + E_kg2 + E_kn2 - (what C contributes), relative to 3 P V; zero at
        equilibrium."""
        k, total = self.case, 0.0
        c0, l0, c1, l1, m = self.split(y)
        for i, (c, l) in enumerate(((c0, l0), (c1, l1))):
            psi, p, r, _, _ = meridian(self.basis, c, l)
            q = p + np.sin(psi) / r + k.C[i]
            total += 2 * PI * k.kappa[i] * k.C[i] * l * (r * q) @ self.basis.w  # lambda d/dlambda of C/size
        pv = 3 * m[0] * k.volume()
        e = self.energies(y)
        return (pv - 2 * (m[1:3] @ k.area()) - e["E_line"] + e["E_kg2"] + e["E_kn2"] - total) / abs(pv)

    def strong_form(self, y):
        """Residuals of the Euler-Lagrange equations with the force law of the sharp interface: the largest
        |r f_N| over both phases, and at the boundary the couple, normal and tangential force.  Where B_perp jumps,
        the tangential force is -[kappa/2 (K_M-C)^2] + [kappa (K_M-C) B_perp] + sigma_Lo - sigma_Ld + kl kg:
        with the couple zero and B_perp continuous this is Eq. 89. The square moduli add what
        docs/theory.md says with l_kg = 2 kg2 kg and l_kn = 2 kn2 kn, constant along the boundary."""
        k = self.case
        c0, l0, c1, l1, m = self.split(y)
        bulk, ends = 0.0, []
        for i, (c, l) in enumerate(((c0, l0), (c1, l1))):
            psi, p, r, rb, _ = meridian(self.basis, c, l)
            S = np.sin(psi)
            KM, G, C, d = -(p + S / r), p * S / r, k.C[i], self.basis.derivative
            slope = d(KM) / l
            lap = d(slope) / l * r + np.cos(psi) * slope  # r Lap_s K_M
            f = -k.kappa[i] * (lap + r * (KM**3 / 2 - 2 * KM * G + 2 * C * G - C * C * KM / 2))
            f += r * (m[1 + i] * KM + m[0])
            bulk = max(bulk, np.abs(f * self.basis.w).sum())
            km, dkm = d(KM, end=True)
            ends.append((km - C, (dkm / l) * (1, -1)[i], k.kappa[i], -d(psi, end=True)[1] / l))
        rb, psib = meridian(self.basis, c0, l0)[3:]
        kn, kg = -np.sin(psib) / rb, -np.cos(psib) / rb
        (h0, d0, k0, b0), (h1, d1, k1, b1) = ends
        l_kg, l_kn = k.kg + 2 * k.kg2 * kg, k.kn + 2 * k.kn2 * kn
        stretch = k.kl - k.kg2 * kg * kg - k.kn2 * kn * kn
        couple = k0 * h0 - k1 * h1 + (k.kG[0] - k.kG[1] + l_kg) * kn - l_kn * kg
        normal = k0 * d0 - k1 * d1 + stretch * kn
        tangential = -(k0 * h0**2 - k1 * h1**2) / 2 + k0 * h0 * b0 - k1 * h1 * b1 + m[2] - m[1] + stretch * kg
        return bulk, couple, normal, tangential


def neck_radii(basis, c, l):
    """The minima of r between pole and boundary, by sampling and a parabola."""
    x = np.linspace(0, 1, 20001)
    cosine = np.cos(chebyshev.chebvander(x, 2 * basis.n - 1)[:, 1::2] @ c)
    r = l * np.concatenate([[0], np.cumsum((cosine[1:] + cosine[:-1]) / 2)]) * (x[1] - x[0])
    j = 1 + np.flatnonzero((r[1:-1] < r[:-2]) & (r[1:-1] <= r[2:]))
    return list(r[j] - (r[j + 1] - r[j - 1]) ** 2 / (8 * (r[j + 1] - 2 * r[j] + r[j - 1])))


def solve(case, n):
    problem = Problem(case, n)
    y, residual = problem.relax(problem.start())
    if residual > 1e-12 or not problem.convex(problem.hessian(y)):
        raise RuntimeError(f"{case.name}: no minimum found with {n} polynomials, residual {residual:.1e}")
    return problem, y


def solve_with_errors(case, n=48):
    """Energies etc. with n polynomials a phase, and the change of each from n / 2."""
    a, b = (problem.energies(y) for problem, y in (solve(case, n // 2), solve(case, n)))
    return b, {key: abs(b[key] - a[key]) for key in b}


def polygon_energy(case, n):
    """The second route: psi at n + 1 equidistant nodes a phase, second-order midpoint rule, no multipliers.
    Unknowns (psi_1 .. psi_n, l) for Ld, then Lo.  Returns functions of an array of them: energy, constraints."""

    def parts(u):
        for i in range(2):
            v = u[..., i * (n + 1) : (i + 1) * (n + 1)]
            h = v[..., n:] / n
            node = np.concatenate([0 * h, v[..., :n]], -1)
            mid, p = (node[..., 1:] + node[..., :-1]) / 2, np.diff(node) / h
            r1 = np.cumsum(h * np.cos(mid), -1)
            r = r1 - h * np.cos(mid) / 2
            q = p + np.sin(mid) / r + case.C[i]
            area = 2 * PI * (h * r).sum(-1)
            volume = PI * (h * r * r * np.sin(mid)).sum(-1)
            yield PI * case.kappa[i] * (h * r * q * q).sum(-1), area, volume, r1[..., -1], node[..., -1]

    def energy(u):
        a, b = parts(u)
        cb, sb = np.cos(a[4]), np.sin(a[4])
        rb = (a[3] + b[3]) / 2
        line = case.kl * rb - case.kg * cb - case.kn * sb + case.kG[0] * (1 - cb) + case.kG[1] * (1 + cb)
        line = line + (case.kg2 * cb * cb + case.kn2 * sb * sb) / rb
        return a[0] + b[0] + 2 * PI * line

    def constraints(u):
        a, b = parts(u)
        A = case.area()
        return np.stack([a[1] - A[0], b[1] - A[1], a[2] + b[2] - case.volume(), a[3] - b[3], a[4] + b[4] - PI], -1)

    return energy, constraints


def polygon_minimum(case, n):
    """Least energy by sequential quadratic programming, from the two caps."""
    from scipy.optimize import minimize

    energy, constraints = polygon_energy(case, n)
    caps = Problem(case, 24)
    c0, l0, c1, l1, _ = caps.split(caps.start())
    values = chebyshev.chebvander(np.arange(1, n + 1) / n, 47)[:, 1::2]
    u = np.concatenate([values @ c0, [l0], values @ c1, [l1]])
    T = np.eye(2 * n + 2)  # increments of psi as unknowns make the bending energy well conditioned
    for j in (0, n + 1):
        T[j : j + n, j : j + n] = np.tril(np.ones((n, n))) / np.sqrt(n)

    scale = 20 * max(case.kappa)  # the first Hessian, 1, is then an upper bound: short first steps

    def derivative(f):
        return lambda w: f(T @ w + 1e-30j * T.T).imag.T / 1e-30

    result = minimize(
        lambda w: energy(T @ w) / scale,
        np.linalg.solve(T, u),
        jac=lambda w: derivative(energy)(w) / scale,
        method="SLSQP",
        constraints={"type": "eq", "fun": lambda w: constraints(T @ w), "jac": derivative(constraints)},
        options={"maxiter": 1000, "ftol": 1e-11},
    )
    if not result.success:
        raise RuntimeError(f"{case.name}: {result.message}")
    return result.fun * scale


def check_gradient():
    """Largest relative difference between the coded gradient and complex steps of E + the multiplied constraints."""
    case = replace(CASES[0], kappa=(1.3, 2.1), kG=(0.7, -0.4), C=(-1.1, 0.6), kg=0.9, kn=-1.7, kg2=0.4, kn2=1.3)
    problem = Problem(case, 8)
    y = problem.start() + 0.01 * np.cos(np.arange(23.0))
    y[-5:] = 3, -2, 5, 7, -4
    A = case.area()

    def lagrangian(y):
        c0, l0, c1, l1, m = problem.split(y)
        zero = np.zeros_like(l0)
        total, parts = 0, []
        for i, (c, l) in enumerate(((c0, l0), (c1, l1))):
            psi, p, r, _, _ = meridian(problem.basis, c, l)
            q = p + np.sin(psi) / r + case.C[i]
            total += PI * case.kappa[i] * l * ((r * q * q) @ problem.basis.w)
            parts.append(phase_gradient(problem.basis, c, l, 1, 0, zero, zero, zero, zero)[2:])
        (a0, v0, r0, p0), (a1, v1, r1, p1) = parts
        cb, sb = np.cos(p0), np.sin(p0)
        line = case.kl * r0 - case.kg * cb - case.kn * sb + case.kG[0] * (1 - cb) + case.kG[1] * (1 + cb)
        line = line + (case.kg2 * cb * cb + case.kn2 * sb * sb) / r0
        total += 2 * PI * line - m[0] * (v0 + v1 - case.volume()) + m[1] * (a0 - A[0]) + m[2] * (a1 - A[1])
        return total + m[3] * (r0 - r1) + m[4] * (p0 + p1 - PI)

    g = problem.gradient(y)
    h = 1e-30
    steps = np.array([lagrangian(y + 1j * h * e).imag / h for e in np.eye(y.size)])
    return np.abs(g - steps).max() / np.abs(g).max()


def check_tables():
    """Largest relative difference from two_phase.csv (r_neck_min apart: the least of samples there), and of C7
    from the same jump of kG, whose energy differs by 2 pi 3."""
    table = Path(__file__).resolve().parents[2] / "data/reference/two_phase.csv"
    head, *rows = [line.split(",") for line in table.read_text().splitlines()]
    worst = 0.0
    for row in rows:
        problem, y = solve(next(k for k in CASES if k.name == row[0]), 48)
        e = problem.energies(y)
        for name, text in zip(head, row):
            if name in e and name != "r_neck_min":
                worst = max(worst, abs(e[name] - float(text)) / max(1e-8, abs(float(text))))
    case = next(k for k in CASES if k.name.startswith("C7_"))
    line, jump = (p.energies(y) for p, y in (solve(case, 32), solve(replace(case, kg=0, kG=(case.kg, 0)), 32)))
    return worst, abs(line["E_total"] + 2 * PI * case.kg - jump["E_total"]), abs(line["P"] - jump["P"])


def from_the_sphere(case, n=24):
    """E_total of the branch followed from v = 0.995 in steps of 0.005."""
    y = None
    for v in [*np.arange(0.995, case.v + 1e-9, -0.005), case.v]:
        problem = Problem(replace(case, v=v), n)
        y = problem.relax(problem.start())[0] if y is None else problem.relax(y, damping=0.01)[0]
    return problem.energies(y)["E_total"]


def check(case):
    problem, y = solve(case, 32)
    E = problem.energies(y)["E_total"]
    print(f"{case.name}: E {E:.8g}")
    print(f"  from the sphere {from_the_sphere(case) - E:.1e}, scale identity {problem.scale_identity(y):.1e}")
    print("  strong form: sum |r f_N| w %.1e, couple %.1e, normal %.1e, tangential %.1e" % problem.strong_form(y))
    polygons = [polygon_minimum(case, n) for n in (20, 40, 80)]
    ends = [(4 * b - a) / 3 for a, b in zip(polygons, polygons[1:])]
    print("  polygons of 20, 40, 80 sides a phase: E %.6g %.6g %.6g," % tuple(polygons), end=" ")
    print("extrapolated / E - 1: %.1e %.1e" % tuple(e / E - 1 for e in ends))


RESULTS = "E_total E_line E_bend_Ld E_bend_Lo E_G r_boundary P sigma_Ld sigma_Lo psi_boundary_deg r_neck_min".split()


def csv(cases):
    """The columns of two_phase.csv, then the line energies of the other moduli of the boundary and the case's
    parameters."""
    given = "x,v,kappa_l,kappa_Ld,kappa_Lo,kG_Ld,kG_Lo,kappa_g,kappa_n,C_Ld,C_Lo,kappa_g2,kappa_n2"
    of_line = "E_kg,E_kn,E_kg2,E_kn2"
    print("case,mode," + ",".join(RESULTS) + f",drift_U,max_error_estimate,{of_line},{given}")
    for k in cases:
        e, change = solve_with_errors(k)
        error = max(change[name] for name in RESULTS[:9])
        values = ["%.8g" % (e[name] + 0.0) for name in RESULTS] + ["0", "%.1e" % error]
        values += ["%.8g" % (e[name] + 0.0) for name in of_line.split(",")]
        values += ["%g" % t for t in (k.x, k.v, k.kl, *k.kappa, *k.kG, k.kg, k.kn, *k.C, k.kg2, k.kn2)]
        print(",".join([k.name, "variational", *values]))


def profile(case, n=32):
    problem, y = solve(case, n)
    c0, l0, c1, l1, _ = problem.split(y)
    rows = []
    for i, (c, l) in enumerate(((c0, l0), (c1, l1))):
        psi, p, r, rb, psib = meridian(problem.basis, c, l)
        z = -l * (problem.basis.Q @ np.sin(psi))  # from the phase's own pole
        slopes = chebyshev.chebval([0, 1], chebyshev.chebder(np.eye(2 * n)[:, 1::2] @ c)) / l
        pole = [0, 0, 0, 0, 2 * slopes[0]]
        end = [l, rb, -l * (problem.basis.w @ np.sin(psi)), psib, slopes[1] + np.sin(psib) / rb]
        rows.append(np.vstack([pole, np.column_stack([l * problem.basis.x, r, z, psi, p + np.sin(psi) / r]), end]))
    a, b = rows
    b = b[::-1] * [-1, 1, -1, -1, 1] + [l0 + l1, 0, a[-1, 2] + b[-1, 2], PI, 0]
    middle = b[-1, 2] / 2
    print("s,r,z,psi,minus_K_M,phase(0=Ld;1=Lo)")
    for phase, part in enumerate((a, b)):
        for row in part - [0, 0, middle, 0, 0]:
            print(",".join("%.12g" % t for t in row) + f",{phase}")


def main():
    names = [a for a in sys.argv[1:] if not a.startswith("-")]
    options = {a for a in sys.argv[1:] if a.startswith("-")}
    cases = [k for k in CASES if not names or k.name.split("_")[0] in names]
    if not options <= {"--profile", "--check"} or not cases:
        sys.exit(__doc__)
    if "--profile" in options:
        profile(cases[0])
    elif "--check" in options:
        print(f"gradient {check_gradient():.1e}")
        print("two_phase.csv %.1e; kappa_g against a jump of kG: E %.1e, P %.1e" % check_tables())
        for k in cases:
            check(k)
    else:
        csv(cases if names else [k for k in cases if k.name.split("_")[0] not in ("C1", "C2", "C5")])


if __name__ == "__main__":
    main()
