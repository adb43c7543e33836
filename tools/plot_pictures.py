# SPDX-License-Identifier: GPL-2.0-or-later
"""picture-STEP.png: the contact, and beside it the flow or, without a fluid, the load."""
import h5py
import numpy as np
from matplotlib import collections, lines, patches, patheffects
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, LogNorm, Normalize
from matplotlib.figure import Figure

from plot_common import label_axis, save, scientific, wanted_leak_rate, with_best_unit

CONTACT, POCKET, PATH = (0, 0, 0), (62, 76, 97), (150, 190, 205)  # open = 0, 1, 2
OUTSIDE = (236, 236, 236)  # open = 3: no part of the mesh
GAPS = LinearSegmentedColormap.from_list(
    "gaps", [(0, "#4c5f75"), (0.3, "#a9bccd"), (1, "#f7fbff")])
PRESSURES = LinearSegmentedColormap.from_list("pressures", ["#173a8a", "#1d7d95", "#58b368"])
CURRENTS = LinearSegmentedColormap.from_list(
    "currents", ["#b0001a", "#e2201c", "#ff6a13", "#ffb020", "#fff34d"])
CURRENT_DECADES = 3
OUTLINES = {0: {"color": "#0b62d6", "linewidth": 2.5},  # inlet
            1: {"color": "#c23b00", "linewidth": 2.5},  # outlet
            2: {"color": "#5b5b5b", "linewidth": 1.2}}  # wall
RING = {"marker": "o", "fillstyle": "none", "color": "white", "markeredgewidth": 2,
        "path_effects": [patheffects.withStroke(linewidth=4, foreground="black")]}
NARROWEST = 4.4  # inches for two colour bars


def read_picture(path):
    """Fields (arrays) and attributes of picture-STEP.h5; missing numbers are NaN."""
    with h5py.File(path, "r") as file:
        fields = {name: field[()] for name, field in file.items()}
        about = {name: np.ravel(value)[0] for name, value in file.attrs.items()}
    fields["open"] = np.clip(fields["open"], 0, 3).astype(np.uint8)
    about = {name: value.decode(errors="replace") if isinstance(value, bytes) else value
             for name, value in about.items()}
    unknown = dict.fromkeys(("nominal_pressure", "contact_area", "leak_rate", "percolates",
                             "worst_x", "worst_y"), np.nan)
    title = f"{path.resolve().parent.name}, step {path.stem.split('-')[1]}"
    return fields, {"direction": "x", "title": title, **unknown, **about}


def colour_scales(fields, about):
    """Colour scales by field: for the gap, and for the flow or, in a dry contact, the pressure."""
    def up_to_top(values):
        high = values[values > 0]  # the topmost 0.5 % saturate
        return Normalize(0, float(np.percentile(high, 99.5)) if high.size else 1.0, clip=True)

    scales = {"gap": ScalarMappable(up_to_top(fields["gap"]), GAPS)}
    if np.isnan(about["percolates"]) and "pressure" in fields:
        scales["pressure"] = ScalarMappable(up_to_top(fields["pressure"]), CURRENTS)
    if "fluid_pressure" in fields:
        low, high = sorted((about["inlet_pressure"], about["outlet_pressure"]))
        scales["fluid_pressure"] = ScalarMappable(Normalize(low, high, clip=True), PRESSURES)
    largest = float(np.fmax.reduce(fields.get("current", np.zeros(1)), axis=None))
    if largest > 0:
        norm = LogNorm(largest / 10**CURRENT_DECADES, largest, clip=True)
        scales["current"] = ScalarMappable(norm, CURRENTS)
    return scales


def paint_gap(fields, scales):
    """The picture (ny, nx, 3) of the gap, with the contact in black."""
    image = scales["gap"].to_rgba(fields["gap"].astype(float), bytes=True)[..., :3]
    outside = fields["open"] == 3
    image[(fields["open"] == 0) | (outside & (fields["gap"] <= 0))] = CONTACT
    return image


def paint_load(fields, scales):
    """The picture of a dry contact: contact pressure, on white."""
    image = np.full((*fields["open"].shape, 3), 255, dtype=np.uint8)
    if "pressure" in scales:
        touches = fields["open"] == 0
        pressure = fields["pressure"][touches].astype(float)
        image[touches] = scales["pressure"].to_rgba(pressure, bytes=True)[:, :3]
    return image


def paint_flow(fields, scales):
    """The picture of the flow: contact, pockets, fluid pressure, and on top of it the current."""
    image = np.array([CONTACT, POCKET, PATH, OUTSIDE], dtype=np.uint8)[fields["open"]]
    path = fields["open"] == 2
    if "fluid_pressure" in scales:
        wet = path & np.isfinite(fields["fluid_pressure"])
        pressure = fields["fluid_pressure"][wet].astype(float)
        image[wet] = scales["fluid_pressure"].to_rgba(pressure, bytes=True)[:, :3]
    if "current" in scales:
        flows = path & (fields["current"] > 0)
        current = fields["current"][flows].astype(float)
        opacity = np.clip(1.8 * np.asarray(scales["current"].norm(current)), 0, 1)[:, None]
        glow = scales["current"].to_rgba(current, bytes=True)[:, :3]
        image[flows] = (1 - opacity) * image[flows] + opacity * glow
    return image


def add_panels(lx, ly):
    """A figure with two axes for pictures of the box, and the width and height of one in inches.

    Boxes up to 1.6 times as wide as high stand side by side, wider ones on top of each other. The
    axes have the shape of the box up to 8 : 1, and below each is room for two colour bars.
    """
    ratio = float(np.clip(lx / ly, 1 / 8, 8))
    width = min(5.2, 6.5 * ratio) if ratio <= 1.6 else 8.5
    height, cell = width / ratio, max(width, NARROWEST)
    right, up = (cell + 0.9, 0) if ratio <= 1.6 else (0, height + 1.7)
    size = np.array([cell + right + 1.3, height + up + 2.25])
    figure = Figure(figsize=size)
    corners = ((0.8 + (cell - width) / 2, 1.3 + up), (0.8 + (cell - width) / 2 + right, 1.3))
    axes = [figure.add_axes((*(corner / size), *((width, height) / size))) for corner in corners]
    return figure, axes, (width, height)


def show_box(axes, image, about, units, outline=None):
    """Show an image of the box, the worst constriction in a ring, and the outline of a mesh."""
    # Each point lies in the middle of its square, the first one at 0. The last ones fill the box: the
    # copies of the first ones are beyond the outlet.
    dx, dy = about["lx"] / image.shape[1], about["ly"] / image.shape[0]
    axes.imshow(np.pad(image, ((0, 1), (0, 1), (0, 0)), mode="edge"), origin="lower", aspect="auto",
                extent=(-dx / 2, about["lx"] + dx / 2, -dy / 2, about["ly"] + dy / 2))
    axes.plot(about["worst_x"], about["worst_y"], markersize=19, clip_on=False, **RING)
    axes.set(xlim=(0, about["lx"]), ylim=(0, about["ly"]))
    for axis, name in ((axes.xaxis, "x"), (axes.yaxis, "y")):
        label_axis(axis, name, "length", units, max(about["lx"], about["ly"]))
    if outline is not None:
        for kind, style in OUTLINES.items():
            pieces = outline[outline[:, 4] == kind, :4].reshape(-1, 2, 2)
            axes.add_collection(collections.LineCollection(pieces, clip_on=False, **style))


def add_colour_bars(axes, inches, bars, units):
    """Add colour bars, (scale, label, quantity) each, side by side below a panel."""
    width, height = inches
    share = max(width, NARROWEST) / width
    for start, (scale, label, quantity) in zip((0.5 - share / 2, 0.5 + 0.15 / width), bars):
        place = axes.inset_axes((start, -0.78 / height, share / 2 - 0.15 / width, 0.13 / height))
        axes.figure.colorbar(scale, cax=place, orientation="horizontal")
        label_axis(place.xaxis, label, quantity, units, scale.norm.vmax)


def add_legend(axes, inches, about):
    """Explain plain colours and the ring, below the right half of a panel."""
    colours = {"contact": CONTACT, "open, not joined to both sides": POCKET}
    keys = [patches.Patch(color=np.divide(rgb, 255), label=text) for text, rgb in colours.items()]
    if np.isfinite(about["worst_x"]):
        keys.append(lines.Line2D([], [], linestyle="", markersize=11, label="worst constriction",
                                 **RING))
    axes.legend(handles=keys[:1] if np.isnan(about["percolates"]) else keys, loc="upper left",
                bbox_to_anchor=(0.52, -0.5 / inches[1]))


def mark_flow(axes, about):
    """Mark where the fluid enters and leaves, and whether the seal is closed."""
    arrow = "⟵" if about["leak_rate"] < 0 else "⟶"
    for at, words in enumerate((f"inlet {arrow}", f"{arrow} outlet")):
        if about["direction"] == "mesh":
            axes.text(0.01 + 0.98 * at, 1.015, words.strip(f" {arrow}"), transform=axes.transAxes,
                      color=OUTLINES[at]["color"], fontsize=10, ha=("left", "right")[at])
        elif about["direction"] == "y":
            axes.text(1.015, at, words, transform=axes.transAxes, rotation=90,
                      verticalalignment=("bottom", "top")[at])
        else:
            axes.set_title(words, loc=("left", "right")[at], fontsize=10)
    if about["percolates"] == 0:
        axes.text(0.5, 0.5, "sealed", transform=axes.transAxes, ha="center", va="center",
                  fontsize=16, bbox={"facecolor": "white", "edgecolor": "none"})


def headline(about, units):
    """Load, contact area, leak rate and validity, as far as they are known, in one line."""
    words = {"nominal pressure": with_best_unit(about["nominal_pressure"], units.get("pressure")),
             "contact area": f"{100 * about['contact_area']:.1f} %",
             "leak rate": with_best_unit(about["leak_rate"], units.get("leak_rate"))}
    parts = [f"{name} {value}" for name, value in words.items() if not value.startswith("nan")]
    if about.get("validity", "ok") != "ok":
        parts.append(f"validity: {about['validity']}")
    return "   ·   ".join(parts)


def add_window(axes, fields, about, units):
    """Add the gap in the finest window around the worst constriction as an inset."""
    if "window_gap" not in fields:
        return
    x, y, lx, ly = (about[f"window_{name}"] for name in ("x", "y", "lx", "ly"))
    right, top = about["worst_x"] > about["lx"] / 2, about["worst_y"] > about["ly"] / 2
    inset = axes.inset_axes((0.02 if right else 0.6, 0.02 if top else 0.6, 0.38, 0.38))
    zoomed = {"gap": fields["window_gap"], "open": fields["window_open"].astype(np.uint8)}
    scale = {"gap": colour_scales(zoomed, {"percolates": 0.0})["gap"]}
    inset.imshow(paint_gap(zoomed, scale), origin="lower", aspect="auto")
    inset.set(xticks=[], yticks=[])
    inset.set_title(f"{scientific(lx)} × {scientific(ly)} {units.get('length', '')}".rstrip(),
                    fontsize=7, pad=2, bbox={"facecolor": "white", "edgecolor": "none", "pad": 1})
    for spine in inset.spines.values():
        spine.set(color="white", linewidth=1.5)
    axes.add_patch(patches.Rectangle((x, y), lx, ly, fill=False, color="white", linewidth=0.8))


def draw_picture(path, units):
    """Draw picture-STEP.png from picture-STEP.h5: the contact, and the flow or load in it."""
    fields, about = read_picture(path)
    scales = colour_scales(fields, about)
    factor, units = wanted_leak_rate(path.parent, units)
    about["leak_rate"] *= factor
    labels = {"pressure": ("Contact pressure", "pressure"),
              "fluid_pressure": ("Fluid pressure", "pressure"),
              "current": ("Current density", "current")}
    figure, (left, right), inches = add_panels(about["lx"], about["ly"])
    outline = fields.get("outline")
    show_box(left, paint_gap(fields, scales), about, units, outline)
    add_colour_bars(left, inches, [(scales["gap"], "Gap", "length")], units)
    add_legend(left, inches, about)
    add_window(left, fields, about, units)
    dry = np.isnan(about["percolates"])
    show_box(right, (paint_load if dry else paint_flow)(fields, scales), about, units, outline)
    add_colour_bars(right, inches,
                    [(scales[key], *labels[key]) for key in labels if key in scales], units)
    if not dry:
        mark_flow(right, about)
    title = about["title"].replace("$", r"\$")
    head = figure.suptitle(f"{title}\n{headline(about, units)}",
                           y=1 - 0.12 / figure.get_figheight(), fontsize=12, linespacing=1.5)
    room = 0.98 * figure.bbox.width / head.get_window_extent().width
    head.set_fontsize(12 * min(1, room))  # many words of validity on a narrow figure
    save(figure, path.with_suffix(".png"))
