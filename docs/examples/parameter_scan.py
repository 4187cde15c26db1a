"""Relaxes the same prolate with several spontaneous curvatures and plots the energies over time.

    python3 parameter_scan.py scan.png
"""
import sys

import lamella
import matplotlib

matplotlib.use("Agg")  # no display needed
import matplotlib.pyplot as plt

figure, axes = plt.subplots()
for curvature in (-4, -2, 0):
    run = lamella.run({
        "grid": {"nodes": 32},
        "shape": {"kind": "prolate", "semi_axis": 0.7, "reduced_volume": 0.8},
        "membrane": {"spontaneous_curvature": curvature},
        "run": {"end_time": 2e-4},
    })
    end = run[-1]  # computes all of it
    axes.plot(1e4 * run.history["t"], run.history["energy"], label=f"C = {curvature}")
    print(f"C = {curvature}: energy {end.measures['energy']:.4f} at t = {end.time:g}")
axes.set_xlabel("time / 1e-4")
axes.set_ylabel("energy / bending modulus")
axes.legend()
figure.savefig(sys.argv[1])
