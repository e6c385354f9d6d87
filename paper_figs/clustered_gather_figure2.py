#!/usr/bin/python3
"""Clustered gather paper, figure 2: equal numbers of gather samples without, with one and with both clusterings.

    paper_figs/clustered_gather_figure2.py out/clustered_gather_figure2/table.csv figure.svg

Reads table.csv of `relight run experiments/clustered_gather_figure2.toml`. The paper shows pictures, no errors.
"""

import sys

from figure_tools import COLOURS, arguments, good, number, plain, pyplot, read, require_varying, save

NEEDED = ["view_clusters", "gather_clusters"]
BARS = (("relative_percent", "all pixels", COLOURS[0]), ("edges_out_percent", "without edges", COLOURS[2]),
        ("indirect_percent", "indirect light alone", COLOURS[1]))


def name(row):
    view, gather = (number(row, f"clustered_gather.{k}") > 0 for k in NEEDED)
    if not gather:
        return "no clustering"
    if not view:
        return "gather samples\nclustered"
    start = row.get("clustered_gather.clustering") or "two_phase"
    return "both clustered,\n" + start.replace("_", " ")


def main():
    options = arguments(__doc__, "clustered_gather_figure2")
    rows = good(read(options.csv), ["relative_percent", "relight_ms"], options.csv)
    require_varying(rows, [f"clustered_gather.{k}" for k in NEEDED], options.csv, "clustered_gather_figure2")
    runs = {name(row): row for row in rows}
    wanted = ["no clustering", "gather samples\nclustered", "both clustered,\ntwo phase"]
    absent = [w.replace("\n", " ") for w in wanted if w not in runs]
    if absent:
        sys.exit(f"{options.csv}: no run with {', '.join(absent)}: is the experiment complete?")
    figure, axes = pyplot.subplots(figsize=(6.4, 3.2))
    for at, (column, label, colour) in enumerate(BARS):
        x = [i + 0.25 * (at - 1) for i in range(len(runs))]
        values = [number(row, column) for row in runs.values()]
        axes.bar(x, values, width=0.24, color=colour, label=label)
        for place, value in zip(x, values):
            axes.text(place, value, f"{value:.1f}", ha="center", va="bottom", fontsize=7)
    axes.set_xticks(range(len(runs)), [f"{n}\n{number(r, 'relight_ms'):.0f} ms" for n, r in runs.items()])
    plain(axes)
    axes.set_ylabel("relative error, %", fontsize=8)
    axes.legend(fontsize=7, frameon=False)
    save(figure, options.out)


if __name__ == "__main__":
    main()
