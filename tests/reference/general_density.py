"""Exact energies of vesicles with any of the terms of Eq. 5, for tests/solver/general_equilibria_test.cpp.

Ritz's method for closed axisymmetric membranes. Of one phase, with a mirror plane: the tangent angle along the meridian is
psi(u) = pi u + sum over even n of a_n sin(n pi u), u the arc length over the whole, L. Of two, each from its own pole to the
boundary: psi is a sum of odd Chebyshev polynomials of s / l. Energy, area and volume are integrals by Gauss's rule, their
gradients come from complex steps, and Newton's method finds where the Lagrangian is stationary.
Python 3 with numpy and scipy; prints each energy with 12 and with 18 modes; of two phases with 9 and 12 a phase.
"""
import numpy as np
from numpy.polynomial import chebyshev, legendre
from scipy.optimize import brentq

SEMI_AXIS, REDUCED_VOLUME = 0.7, 0.8  # of the prolate that tells area and volume, and where Newton's method begins
CASES = {
    "linear": dict(linear=3),
    "cubic": dict(cubic=-0.02),
    "mixed_cubic": dict(mixed_cubic=0.05),
    "quartic": dict(quartic=0.02),
    "mixed_quartic": dict(mixed_quartic=0.03),
    "gaussian_square": dict(gaussian_square=0.05),
    "gradient": dict(gradient=0.02),
    "all": dict(C=-2, linear=2, cubic=0.02, mixed_cubic=-0.03, quartic=0.01, mixed_quartic=0.01, gaussian_square=0.02, gradient=0.01),
}

# A cap of 30 % of a sphere of .98, its volume reduced to .85, with a line tension of 20: Ld, Lo.
TWO_PHASE_CASES = {
    "gradient": (dict(gradient=0.02), dict(gradient=0.02)),
    "gradient of both": (dict(gradient=0.05), dict(gradient=0.02)),
    "gradient of Ld": (dict(gradient=0.02), dict()),
    "quartic of Ld": (dict(quartic=0.02), dict()),
}


def density(m, KM, K, slope):
    """`slope`: of K_M along the meridian."""
    g = lambda name: m.get(name, 0)
    return (0.5 * (KM - g("C")) ** 2 + g("linear") * KM + g("cubic") * KM**3 + g("mixed_cubic") * KM * K
            + g("quartic") * KM**4 + g("mixed_quartic") * KM**2 * K + g("gaussian_square") * K**2
            + g("gradient") * slope**2)


class Rule:
    """Gauss's rule on [0, 1], and integrals from 0 to each of its points."""

    def __init__(self, points=120):
        x, w = legendre.leggauss(points)
        self.u, self.w = (x + 1) / 2, w / 2
        to_series = np.array([(2 * k + 1) / 2 * w * legendre.legvander(x, k)[:, k] for k in range(points)])
        integral = np.array([legendre.legval(x, legendre.legint(np.eye(points)[k], lbnd=-1)) for k in range(points)]).T
        self.up_to = 0.5 * integral @ to_series


def part(rule, m, L, psi, by_u, by_uu):
    """Energy, area and volume under it, and the radius at the end, of a meridian that begins at a pole."""
    r = L * (rule.up_to @ np.cos(psi))
    along, around = by_u / L, np.sin(psi) / r
    slope = -(by_uu / L**2 + np.cos(psi) * (along - around) / r)
    dA = 2 * np.pi * r * L * rule.w
    return np.array([(density(m, -(along + around), along * around, slope) * dA).sum(), dA.sum(),
                     np.pi * (r**2 * np.sin(psi) * L * rule.w).sum(), L * (rule.w @ np.cos(psi))])


def at_rest(values, q, target):
    """Where the first of the values is stationary and the others are what they are to be."""

    def gradients(q):
        out = []
        for i in range(len(q)):
            p = q.astype(complex)
            p[i] += 1e-30j
            out.append(values(p).imag / 1e-30)
        return np.array(out).T

    for _ in range(200):
        g = gradients(q)
        multipliers = -np.linalg.lstsq(g[1:].T, g[0], rcond=None)[0]
        lagrangian = lambda q: (lambda g: g[0] + multipliers @ g[1:])(gradients(q))
        e = 1e-6 * np.eye(len(q))
        H = np.array([(lagrangian(q + d) - lagrangian(q - d)) / 2e-6 for d in e])
        J, missing = g[1:], target - values(q)[1:]
        free = np.linalg.qr(J.T, mode="complete")[0][:, len(J) :]
        onto = np.linalg.lstsq(J, missing, rcond=None)[0]
        levels, vectors = np.linalg.eigh(free.T @ (H + H.T) / 2 @ free)
        levels = np.maximum(abs(levels), 1e-10 * abs(levels).max())  # downhill from saddles too
        slope = vectors.T @ (free.T @ (lagrangian(q) + H @ onto))
        step = onto - free @ (vectors @ (slope / levels))
        q = q + min(1, 0.2 / abs(step).max()) * step
        if abs(step).max() < 1e-11:
            break
    return values(q)[0]


class Meridian:
    def __init__(self, modes):
        self.rule = Rule()
        n = np.arange(2, 2 * modes + 1, 2)
        self.sines = np.sin(np.pi * np.outer(self.rule.u, n))
        self.by_u = np.pi * n * np.cos(np.pi * np.outer(self.rule.u, n))
        self.by_uu = -((np.pi * n) ** 2) * self.sines

    def energy_at_rest(self, m, A, V, q):
        of = lambda q: part(self.rule, m, q[0], np.pi * self.rule.u + self.sines @ q[1:], np.pi + self.by_u @ q[1:],
                            self.by_uu @ q[1:])
        return at_rest(lambda q: of(q)[:3], q, np.array([A, V]))

    def of_spheroid(self, b, a):
        t = np.linspace(0, np.pi, 4001)
        speed = np.hypot(b * np.cos(t), a * np.sin(t))
        s = np.concatenate([[0], np.cumsum((speed[1:] + speed[:-1]) / 2 * np.diff(t))])
        u, w = self.rule.u, self.rule.w
        psi = np.interp(u, s / s[-1], np.unwrap(np.arctan2(a * np.sin(t), b * np.cos(t))))
        return np.concatenate([[s[-1]], 2 * (w * (psi - np.pi * u)) @ self.sines])


class TwoMeridians:
    """Of Ld and Lo; where both have a gradient modulus K_M is continuous at the boundary, and so is the curvature along the
    meridian."""

    def __init__(self, modes):
        self.rule, self.modes = Rule(60), modes
        x, odd = self.rule.u, np.eye(2 * modes)[:, 1::2]
        self.psi = chebyshev.chebvander(x, 2 * modes - 1) @ odd
        self.by_u = chebyshev.chebvander(x, 2 * modes - 2) @ chebyshev.chebder(odd)
        self.by_uu = chebyshev.chebvander(x, 2 * modes - 3) @ chebyshev.chebder(odd, 2)
        self.at_end, self.slope_at_end = np.ones(modes), np.arange(1, 2 * modes, 2.0) ** 2

    def energy_at_rest(self, moduli, tension, radius, share, reduced_volume):
        smooth = all(m.get("gradient", 0) > 0 for m in moduli)
        A = 4 * np.pi * radius**2

        def values(q):
            (l0, c0), (l1, c1) = ((p[0], p[1:]) for p in np.split(q, 2))
            a, b = (part(self.rule, m, l, self.psi @ c, self.by_u @ c, self.by_uu @ c)
                    for m, l, c in zip(moduli, (l0, l1), (c0, c1)))
            out = [a[0] + b[0] + 2 * np.pi * tension * a[3], a[1], b[1], a[2] + b[2], a[3] - b[3],
                   self.at_end @ (c0 + c1)]
            if smooth:
                out.append(self.slope_at_end @ (c0 / l0 - c1 / l1))
            return np.array(out)

        angle = np.arccos(1 - 2 * share)
        start = np.zeros((2, self.modes + 1))
        start[0, :2], start[1, :2] = (radius * angle, angle), (radius * (np.pi - angle), np.pi - angle)
        target = [A * share, A * (1 - share), reduced_volume * 4 / 3 * np.pi * radius**3, 0, np.pi, 0]
        return at_rest(values, start.ravel(), np.array(target[: 6 if smooth else 5]))


def prolate(b, a=SEMI_AXIS):
    e = np.sqrt(1 - b * b / a / a)
    A, V = 2 * np.pi * b * b * (1 + a / (b * e) * np.arcsin(e)), 4 / 3 * np.pi * b * b * a
    return A, V, V / (4 / 3 * np.pi * (A / 4 / np.pi) ** 1.5)


b = brentq(lambda b: prolate(b)[2] - REDUCED_VOLUME, 0.05, 0.99 * SEMI_AXIS)
A, V, _ = prolate(b)
for name, m in CASES.items():
    coarse, fine = (M.energy_at_rest(m, A, V, M.of_spheroid(b, SEMI_AXIS)) for M in (Meridian(12), Meridian(18)))
    print(f"{name:16} {coarse:.13g} {fine:.13g}")
for name, moduli in TWO_PHASE_CASES.items():
    coarse, fine = (TwoMeridians(n).energy_at_rest(moduli, 20, 0.98, 0.3, 0.85) for n in (9, 12))
    print(f"{name:16} {coarse:.13g} {fine:.13g}")
