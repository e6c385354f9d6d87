#!/usr/bin/python3
"""Error against relight time, a panel a scene, lighting and view, from table.csv of `relight run`.

    paper_figs/accuracy_against_time.py out/NAME/table.csv figure.svg [--error indirect] [--cost memory]

Steps: the front of each method, the smallest error that one of its runs reaches within the cost; runs beside it are
pale. Bars: 95 % interval of the error (reference's noise; only of `relative`), smallest and largest repeat. Dashed: what a
perfect method would show because of that noise.
"""

import argparse

import numpy
from figure_tools import COLOURS, MARKERS, distinct, good, number, plain, plain_numbers, pyplot, read, save, scene_name

ERRORS = {
    "relative": ("relative_percent", "relative error, %"),
    "edges_out": ("edges_out_percent", "relative error without edges, %"),
    "indirect": ("indirect_percent", "relative error of indirect light, %"),
}
COSTS = {"relight": "relight time, ms", "memory": "prepared data, MB"}


def cost_of(row, cost):
    if cost == "relight":
        return number(row, "relight_ms")
    # Without the process's peak: what the method keeps.
    sizes = [number(row, c) for c in row if c.startswith("megabytes.") and c != "megabytes.process_peak"]
    return float(numpy.nansum(sizes)) if sizes else 0.0


def front(points):
    """(cost, error) that no other point beats, by rising cost."""
    kept = []
    for cost, error in sorted(points):
        if not kept or error < kept[-1][1]:
            kept.append((cost, error))
    return kept


def draw(axes, rows, methods, error, cost):
    column = ERRORS[error][0]
    for method, colour, marker in zip(methods, COLOURS, MARKERS):
        runs = [row for row in rows if row["method"] == method and cost_of(row, cost) > 0]
        points = [(cost_of(row, cost), number(row, column)) for row in runs]
        if not points:
            continue
        best = front(points)
        for row, point in zip(runs, points):
            bars = {}
            if error == "relative":
                bars["yerr"] = number(row, "relative_half_width")
            if cost == "relight":
                low, high = number(row, "relight_min_ms"), number(row, "relight_max_ms")
                bars["xerr"] = [[max(0.0, point[0] - low)], [max(0.0, high - point[0])]]
            axes.errorbar(*point, fmt=marker, color=colour, markersize=4, elinewidth=0.7,
                          alpha=1.0 if point in best else 0.3, **bars)
        axes.step(*zip(*best), where="post", color=colour, linewidth=1.1, label=method)
    floor = numpy.nanmax([number(row, "noise_floor_percent") for row in rows])
    if error == "relative" and floor > 0:
        axes.axhline(floor, color="#444444", linestyle="--", linewidth=0.8)
    axes.set_xscale("log")
    axes.set_yscale("log")
    plain(axes)
    for axis in (axes.xaxis, axes.yaxis):
        plain_numbers(axis)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("csv", help="table.csv of `relight run`")
    parser.add_argument("out", help="the SVG to write")
    parser.add_argument("--error", choices=ERRORS, default="relative")
    parser.add_argument("--cost", choices=COSTS, default="relight")
    options = parser.parse_args()
    rows = good(read(options.csv), [ERRORS[options.error][0], "relight_ms"], options.csv)
    place = lambda row: (scene_name(row), row["lights"], row["view"])
    panels, methods = distinct(rows, place), distinct(rows, lambda row: row["method"])
    # Rows of equal length, if four or three a row give them.
    columns = min(4 if len(panels) % 4 == 0 else 3, len(panels))
    lines = (len(panels) + columns - 1) // columns
    figure, grid = pyplot.subplots(lines, columns, figsize=(3.6 * columns, 2.9 * lines + 0.3), squeeze=False)
    for axes in grid.flat[len(panels) :]:
        axes.set_visible(False)
    for axes, panel in zip(grid.flat, panels):
        draw(axes, [row for row in rows if place(row) == panel], methods, options.error, options.cost)
        axes.set_title(", ".join(panel), fontsize=9)
        axes.set_xlabel(COSTS[options.cost], fontsize=8)
        axes.set_ylabel(ERRORS[options.error][1], fontsize=8)
    handles = {label: handle for axes in grid.flat for handle, label in zip(*axes.get_legend_handles_labels())}
    figure.legend(handles.values(), handles.keys(), loc="upper center", ncol=len(handles), fontsize=9,
                  frameon=False)
    save(figure, options.out, room_above=0.35)


if __name__ == "__main__":
    main()
