#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws how a step of the joint map grows with cells and with events:

  build/bin/radiation_bench --benchmark_filter=joint_map_of_cells --benchmark_out=growth.csv --benchmark_out_format=csv
  scripts/growth-picture.py growth.csv growth.svg
"""
import csv
import math
import re
import sys

WIDTH, HEIGHT, LEFT, TOP, GAP = 380, 260, 60, 40, 90


def points_of(file):
    """(cells, events, ms) of each benchmark; the file begins with lines about the machine."""
    text = open(file).read()
    rows = csv.DictReader(text[text.index("name,"):].splitlines())
    for row in rows:
        edge = re.search(r"edge:(\d+)", row["name"])
        if edge and row["time_unit"] == "ms":
            yield int(edge[1]) ** 2, float(row["pairs"]), float(row["cpu_time"])


def exponent(points):
    """Slope of a straight line through the logarithms, by least squares."""
    x, y = [math.log(p[0]) for p in points], [math.log(p[1]) for p in points]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def decades(low, high):
    return range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)


def panel(left, title, unit, points, y_decades):
    x_decades = decades(min(p[0] for p in points), max(p[0] for p in points))

    def at(value, among, begin, length):
        return begin + length * (math.log10(value) - among[0]) / (among[-1] - among[0])

    def x_px(value):
        return at(value, x_decades, left, WIDTH)

    def y_px(value):
        return at(value, y_decades, TOP + HEIGHT, -HEIGHT)

    yield f'<text x="{left}" y="{TOP - 14}" font-size="14">{title}: exponent {exponent(points):.2f}</text>'
    for decade in x_decades:
        x = x_px(10.0**decade)
        yield f'<path d="M{x:.1f} {TOP}V{TOP + HEIGHT}" stroke="#ddd"/>'
        yield (f'<text x="{x:.1f}" y="{TOP + HEIGHT + 18}" text-anchor="middle">10'
               f'<tspan dy="-5" font-size="9">{decade}</tspan></text>')
    for decade in y_decades:
        y = y_px(10.0**decade)
        yield f'<path d="M{left} {y:.1f}H{left + WIDTH}" stroke="#ddd"/>'
        yield f'<text x="{left - 8}" y="{y + 4:.1f}" text-anchor="end">{10.0**decade:g} ms</text>'
    yield f'<text x="{left + WIDTH / 2}" y="{TOP + HEIGHT + 40}" text-anchor="middle">{unit}</text>'
    line = " ".join(f"{x_px(x):.1f},{y_px(y):.1f}" for x, y in points)
    yield f'<polyline points="{line}" fill="none" stroke="#c2185b" stroke-width="2"/>'
    for x, y in points:
        yield f'<circle cx="{x_px(x):.1f}" cy="{y_px(y):.1f}" r="4" fill="#c2185b"><title>{x:g}: {y:.3g} ms</title></circle>'


def main(file, out):
    points = sorted(points_of(file))
    cells_least, events_most = points[0][0], max(p[1] for p in points)
    of_cells = [(c, ms) for c, events, ms in points if events > 0.9 * events_most]
    of_events = [(events, ms) for c, events, ms in points if c == cells_least]
    y_decades = decades(min(p[2] for p in points), max(p[2] for p in points))
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{2 * (LEFT + WIDTH) + GAP}" height="{TOP + HEIGHT + 60}" '
        'font-family="sans-serif" font-size="12"><rect width="100%" height="100%" fill="white"/>'
    ]
    parts += panel(LEFT, f"A step with {events_most:,.0f} events", "cells", of_cells, y_decades)
    parts += panel(2 * LEFT + WIDTH + GAP // 2, f"A step with {cells_least:,} cells", "events", of_events, y_decades)
    open(out, "w").write("\n".join(parts) + "\n</svg>\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
