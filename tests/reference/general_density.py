"""Exact energies of vesicles with any of the terms of Eq. 5, for tests/solver/general_equilibria_test.cpp.

Ritz's method for closed axisymmetric membranes with a mirror plane: the tangent angle along the meridian is
psi(u) = pi u + sum over even n of a_n sin(n pi u), u the arc length over the whole, L. Energy, area and volume are integrals by
Gauss's rule, their gradients come from complex steps, and Newton's method finds where the Lagrangian is stationary.
Python 3 with numpy and scipy; prints each energy with 12 and with 18 modes.
"""
import numpy as np
from numpy.polynomial import legendre
from scipy.optimize import brentq

SEMI_AXIS, REDUCED_VOLUME = 0.7, 0.8  # of the prolate that tells area and volume, and where Newton's method begins
CASES = {
    "linear": dict(linear=3),
    "cubic": dict(cubic=-0.02),
    "mixed_cubic": dict(mixed_cubic=0.05),
    "quartic": dict(quartic=0.02),
    "mixed_quartic": dict(mixed_quartic=0.03),
    "gaussian_square": dict(gaussian_square=0.05),
    "all": dict(C=-2, linear=2, cubic=0.02, mixed_cubic=-0.03, quartic=0.01, mixed_quartic=0.01, gaussian_square=0.02),
}


def density(m, KM, K):
    g = lambda name: m.get(name, 0)
    return (0.5 * (KM - g("C")) ** 2 + g("linear") * KM + g("cubic") * KM**3 + g("mixed_cubic") * KM * K
            + g("quartic") * KM**4 + g("mixed_quartic") * KM**2 * K + g("gaussian_square") * K**2)


class Meridian:
    def __init__(self, modes, points=120):
        x, w = legendre.leggauss(points)
        self.u, self.w = (x + 1) / 2, w / 2
        to_series = np.array([(2 * k + 1) / 2 * w * legendre.legvander(x, k)[:, k] for k in range(points)])
        integral = np.array([legendre.legval(x, legendre.legint(np.eye(points)[k], lbnd=-1)) for k in range(points)]).T
        self.up_to = 0.5 * integral @ to_series  # from 0 to each point
        n = np.arange(2, 2 * modes + 1, 2)
        self.sines = np.sin(np.pi * np.outer(self.u, n))
        self.slopes = np.pi * n * np.cos(np.pi * np.outer(self.u, n))

    def integrals(self, q, m):
        """Energy, area, volume."""
        L, a = q[0], q[1:]
        psi = np.pi * self.u + self.sines @ a
        r = L * (self.up_to @ np.cos(psi))
        along, around = (np.pi + self.slopes @ a) / L, np.sin(psi) / r
        dA = 2 * np.pi * r * L * self.w
        return np.array([(density(m, -(along + around), along * around) * dA).sum(), dA.sum(),
                         np.pi * (r**2 * np.sin(psi) * L * self.w).sum()])

    def gradients(self, q, m):
        out = []
        for i in range(len(q)):
            p = q.astype(complex)
            p[i] += 1e-30j
            out.append(self.integrals(p, m).imag / 1e-30)
        return np.array(out).T

    def of_spheroid(self, b, a):
        t = np.linspace(0, np.pi, 4001)
        speed = np.hypot(b * np.cos(t), a * np.sin(t))
        s = np.concatenate([[0], np.cumsum((speed[1:] + speed[:-1]) / 2 * np.diff(t))])
        psi = np.interp(self.u, s / s[-1], np.unwrap(np.arctan2(a * np.sin(t), b * np.cos(t))))
        return np.concatenate([[s[-1]], 2 * (self.w * (psi - np.pi * self.u)) @ self.sines])

    def energy_at_rest(self, m, A, V, q):
        target = np.array([A, V])
        for _ in range(80):
            g = self.gradients(q, m)
            multipliers = -np.linalg.lstsq(g[1:].T, g[0], rcond=None)[0]
            lagrangian = lambda q: (lambda g: g[0] + multipliers @ g[1:])(self.gradients(q, m))
            e = 1e-6 * np.eye(len(q))
            H = np.array([(lagrangian(q + d) - lagrangian(q - d)) / 2e-6 for d in e])
            J, missing = g[1:], target - self.integrals(q, m)[1:]
            free = np.linalg.qr(J.T, mode="complete")[0][:, 2:]
            onto = np.linalg.lstsq(J, missing, rcond=None)[0]
            values, vectors = np.linalg.eigh(free.T @ (H + H.T) / 2 @ free)
            values = np.maximum(abs(values), 1e-6 * abs(values).max())  # downhill from saddles too
            slope = vectors.T @ (free.T @ (lagrangian(q) + H @ onto))
            step = onto - free @ (vectors @ (slope / values))
            q = q + min(1, 0.2 / abs(step).max()) * step
            if abs(step).max() < 1e-11:
                break
        return self.integrals(q, m)[0]


def prolate(b, a=SEMI_AXIS):
    e = np.sqrt(1 - b * b / a / a)
    A, V = 2 * np.pi * b * b * (1 + a / (b * e) * np.arcsin(e)), 4 / 3 * np.pi * b * b * a
    return A, V, V / (4 / 3 * np.pi * (A / 4 / np.pi) ** 1.5)


b = brentq(lambda b: prolate(b)[2] - REDUCED_VOLUME, 0.05, 0.99 * SEMI_AXIS)
A, V, _ = prolate(b)
for name, m in CASES.items():
    coarse, fine = (M.energy_at_rest(m, A, V, M.of_spheroid(b, SEMI_AXIS)) for M in (Meridian(12), Meridian(18)))
    print(f"{name:16} {coarse:.13g} {fine:.13g}")
