# SPDX-License-Identifier: GPL-2.0-or-later
"""gaps.png: distributions of the simulated gaps beside those of Persson's theory."""
import h5py
import numpy as np
from matplotlib.figure import Figure

from plot_common import COLOURS, RED, save, scientific, with_unit
from run_folder import numbered

MOST_STEPS = 4


def fields_with_gaps(folder):
    """The files fields-STEP.h5 that hold distributions, in the order of the steps."""
    files = []
    for path in numbered(folder, "fields-*.h5").values():
        try:
            with h5py.File(path) as file:
                if "gap_distribution" in file:
                    files.append(path)
        except OSError:
            continue
    return files


def draw_step(axes, path, colour, labels):
    """Draw P(u) of one step, the simulated one in @p colour, Persson's as a thin dashed red line;
    return the gaps that should be visible."""
    with h5py.File(path) as file:
        group = file["gap_distribution"]
        edges = group["edges"][:]
        middle = np.sqrt(edges[1:-1] * edges[2:])
        for name, style in (("simulated", {"color": colour}),
                            ("persson", {"color": RED, "linewidth": 0.9, "linestyle": "--"})):
            if name not in group:
                continue
            density = (group[name][:] / np.diff(edges))[1:]
            seen = density > 0
            label = labels.pop(name, None)
            if name == "simulated":
                load = file.attrs.get("nominal_pressure")
                label = None if load is None else f"load {scientific(float(load))}"
            axes.plot(middle[seen], density[seen], label=label, **style)
        return middle[group["simulated"][1:] > 0] if "simulated" in group \
            else middle[group["persson"][1:] > 1e-6]


def draw_gaps(folder, units):
    """Draw gaps.png for up to MOST_STEPS steps of the run in @p folder, if it has distributions."""
    files = fields_with_gaps(folder)
    if not files:
        return None
    chosen = [files[k] for k in
              np.unique(np.linspace(0, len(files) - 1, min(MOST_STEPS, len(files))).astype(int))]
    figure = Figure(figsize=(6.4, 4.6), layout="constrained")
    axes, labels, seen = figure.subplots(), {"persson": "Persson's theory"}, []
    for i, path in enumerate(chosen):
        seen.append(draw_step(axes, path, COLOURS[i % len(COLOURS)], labels))
    seen = np.concatenate(seen)
    axes.set(xscale="log", yscale="log", xlabel=with_unit("Gap", "length", units),
             ylabel="Share of the area per gap")
    if seen.size:
        largest = 1.5 * seen.max()
        axes.set_xlim(max(seen.min(), 1e-5 * largest), largest)
        low, high = axes.get_ylim()
        axes.set_ylim(max(low, 1e-7 * high), high)
    axes.grid(True)
    axes.legend()
    return save(figure, folder / "gaps.png")
