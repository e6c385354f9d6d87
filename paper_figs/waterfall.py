#!/usr/bin/python3
"""Draws waterfall.csv files of `relight explain-error` as bars: one figure, one panel a file.

    paper_figs/waterfall.py out/why/waterfall.csv [more.csv ...] --out figure.svg [--measure relative]

Each bar starts where the one above ends, so that the bars add up to the error of the method as asked. A pale bar
beside it: the stage alone, all others exact. Whiskers: 95 % interval over the choice of pixels.
"""

import argparse
import csv
import os
import sys
import tempfile

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot

MEASURES = {
    "relative": "relative error of the picture, per cent",
    "relative_edges_out": "relative error without edge pixels, per cent",
    "indirect_linear": "relative error of indirect light (linear), per cent",
}
STAGE, REST, TOTAL, ALONE = "#4878a8", "#b0683c", "#303030", "#a8c4e0"


def read(file):
    with open(file, newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    if not rows or "kind" not in rows[0]:
        sys.exit(f"{file}: not a waterfall.csv of `relight explain-error`")
    return rows


def number(row, column):
    return float(row[column]) if row[column] else 0.0


def draw(axes, rows, measure, title):
    rows = [row for row in rows if row["kind"] not in ("closer", "model")]
    level = 0.0
    for at, row in enumerate(rows):
        points, width = number(row, f"points_{measure}"), number(row, f"half_width_{measure}")
        if row["kind"] == "total":
            axes.barh(at, points, color=TOTAL, height=0.55)
            axes.text(points, at, f" {points:.2f}", va="center", fontsize=8)
            level = points
            continue
        if row["active"] == "no":
            axes.text(level, at, " not active", va="center", fontsize=7, color="#808080")
            continue
        # Downwards from the level of the row above.
        colour = REST if row["kind"] == "remainder" else STAGE
        axes.barh(at - 0.12, -points, left=level, color=colour, height=0.4)
        axes.errorbar(level - points, at - 0.12, xerr=width, color="#606060", linewidth=0.7, capsize=1.5)
        axes.text(max(level, level - points + width), at - 0.12, f" {points:.2f}", va="center", fontsize=8)
        if row["kind"] == "stage":
            alone = number(row, f"alone_points_{measure}")
            axes.barh(at + 0.25, -alone, left=level, color=ALONE, height=0.2)
        level -= points
    axes.axvline(0.0, color="black", linewidth=0.6)
    axes.set_yticks(range(len(rows)), [row["stage"] for row in rows], fontsize=8)
    axes.invert_yaxis()
    axes.tick_params(axis="x", labelsize=8)
    axes.set_xlabel(MEASURES[measure], fontsize=8)
    axes.set_title(title, fontsize=9)
    axes.spines[["top", "right"]].set_visible(False)


def with_method(run):
    """The words of a run's folder, joined by underscores as those of the method's name are."""
    for method in ("direct_to_indirect", "clustered_gather"):
        run = run.replace(f"_{method}_", f", {method.replace('_', ' ')}, ")
    return run.replace("_", ", ", 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("csv", nargs="+", help="waterfall.csv of a run; its folder or file name is the title")
    parser.add_argument("--out", required=True, help="the SVG to write")
    parser.add_argument("--measure", choices=MEASURES, default="relative")
    options = parser.parse_args()
    columns = min(2, len(options.csv))
    lines = (len(options.csv) + columns - 1) // columns
    # Dates and random names would make two figures of one table differ.
    pyplot.rcParams["svg.hashsalt"] = "relight"
    figure, panels = pyplot.subplots(lines, columns, figsize=(5.2 * columns, 3.2 * lines), squeeze=False)
    for axes in panels.flat[len(options.csv) :]:
        axes.set_visible(False)
    for axes, file in zip(panels.flat, options.csv):
        name = os.path.splitext(os.path.basename(file))[0]
        title = os.path.basename(os.path.dirname(os.path.abspath(file))) if name == "waterfall" else name
        draw(axes, read(file), options.measure, with_method(title))
    figure.tight_layout()
    folder = os.path.dirname(os.path.abspath(options.out))
    with tempfile.NamedTemporaryFile(dir=folder, suffix=".svg", delete=False) as temporary:
        figure.savefig(temporary, format="svg", metadata={"Date": None})
    os.chmod(temporary.name, 0o644)
    os.replace(temporary.name, options.out)


if __name__ == "__main__":
    main()
