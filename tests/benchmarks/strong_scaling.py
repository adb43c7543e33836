#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""How one load and its leak rate would scale to more ranks than there are here.

    strong_scaling.py [--program build/strait] [--count-at 512] [--size 2048]
                      [--latency 2e-6] [--bandwidth 5e9]

Counts the messages and bytes that each rank sends on 2, 4, 8 and 16 ranks, for the contact
alone and with the flow, on a grid small enough for that (Open MPI's monitoring). Then puts
them together with the seconds of each stage on one rank of this machine: of the grid of
--size, on P ranks,

    contact(P)  = contact(1)/P + messages(P) latency + bytes(P)/bandwidth
    flow(P)     = the same with the bridge divided by P, the channel by the power of P that two
                  ranks here gain, mesh and solver by nothing

where a rank sends, each time that the contact is transformed, a message to each other rank
for every block of columns. What it counted and what that makes is printed side by side.
"""
import argparse
import math
import pathlib
import re
import tempfile

from scene_cost import HERE, fastest, run

# Of a Fourier transform (source/spectral/fourier_transform.cc): columns of single precision
# that a rank transforms at a time, and bytes of one of their numbers.
BLOCK, NUMBER = 16, 8


def count(program, size, ranks, settings):
    """The most messages and bytes that any rank sends."""
    with tempfile.TemporaryDirectory() as folder:
        run(program, size, ranks, settings,
            ["--mca", "pml_monitoring_enable", "2",
             "--mca", "pml_monitoring_enable_output", "3",
             "--mca", "pml_monitoring_filename", f"{folder}/rank"])
        totals = []
        for profile in pathlib.Path(folder).glob("rank.*.prof"):
            sent = [(int(n), int(m)) for n, m in
                    re.findall(r"^[EI]\t\d+\t\d+\t(\d+) bytes\t(\d+) msgs",
                               profile.read_text(), re.MULTILINE)]
            totals.append((sum(m for _, m in sent), sum(n for n, _ in sent)))
        return max(m for m, _ in totals), max(n for _, n in totals)


def of_one_transform(size, ranks):
    """Messages and bytes that a rank sends to transform a field there and back."""
    columns = math.ceil((size // 2 + 1) / ranks)
    messages = 2 * math.ceil(columns / BLOCK) * (ranks - 1)
    return messages, messages * BLOCK * math.ceil(size / ranks) * NUMBER


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=HERE.parents[1] / "build" / "strait")
    parser.add_argument("--count-at", type=int, default=512)
    parser.add_argument("--size", type=int, default=2048)
    parser.add_argument("--latency", type=float, default=2e-6, help="seconds a message")
    parser.add_argument("--bandwidth", type=float, default=5e9, help="bytes a second a rank")
    options = parser.parse_args()

    print(f"counted on {options.count_at} x {options.count_at} points\n"
          f"{'ranks':>6} {'contact: messages':>18} {'MB':>8} {'a pair: messages':>17} {'MB':>8}"
          f" {'flow: messages':>15} {'MB':>8}")
    counted = {}
    pairs = None
    for ranks in (2, 4, 8, 16):
        contact = count(options.program, options.count_at, ranks, ["Fluid/Enabled=false"])
        both = count(options.program, options.count_at, ranks, [])
        counted[ranks] = (contact, (both[0] - contact[0], both[1] - contact[1]))
        messages, sent = of_one_transform(options.count_at, ranks)
        # How many transforms of the fine grid the contact's bytes amount to.
        pairs = contact[1] / sent
        print(f"{ranks:6d} {contact[0]:18d} {contact[1] / 1e6:8.2f} {messages:17d} "
              f"{sent / 1e6:8.2f} {counted[ranks][1][0]:15d} {counted[ranks][1][1] / 1e6:8.2f}",
              flush=True)

    seconds = fastest(options.program, options.size, 1, 2)[0]
    on_two = fastest(options.program, options.size, 2, 2)[0]
    power = math.log2(seconds["flow/channel"] / on_two["flow/channel"])
    print(f"\nthe channel is divided by P^{power:.2f}; predicted for {options.size} x {options.size} points, seconds")
    print(f"{'ranks':>6} {'contact':>9} {'channel':>9} {'bridge':>9} {'mesh':>9} {'all':>9}"
          f" {'speed-up':>9}")
    ranks, first = 1, None
    while ranks <= 4096:
        contact = seconds["contact"] / ranks
        others = 0.
        if ranks > 1:
            messages, sent = of_one_transform(options.size, ranks)
            contact += pairs * (messages * options.latency + sent / options.bandwidth)
            # Those of the mesh grow with the depth of its multigrid's coarse levels, on
            # which each rank talks with others, but not with the grid.
            others = counted[min(ranks, 16)][1][0] * options.latency * max(
                1., math.log2(ranks) / 4.)
        channel = seconds["flow/channel"] / ranks**power
        bridge = seconds["flow/bridge"] / ranks
        mesh = seconds["flow/mesh and solver"] + others
        total = contact + channel + bridge + mesh
        first = first or total
        print(f"{ranks:6d} {contact:9.3f} {channel:9.3f} {bridge:9.3f} {mesh:9.3f} "
              f"{total:9.3f} {first / total:9.1f}")
        ranks *= 2


if __name__ == "__main__":
    main()
