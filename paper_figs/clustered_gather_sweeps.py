#!/usr/bin/python3
"""Clustered gather: error and relight time against each of its four numbers, the others at the paper's values.

    paper_figs/clustered_gather_sweeps.py out/clustered_gather_sweeps/table.csv figure.svg

Reads table.csv of `relight run experiments/clustered_gather_sweeps.toml`.
"""

import sys

from figure_tools import COLOURS, arguments, good, number, plain, plain_numbers, pyplot, read, require_varying, save

# Knob -> the paper's value (section Results).
PAPER = {"directions": 2000, "gather_clusters": 120, "view_clusters": 40000, "neighbours": 10}


def sweep(rows, knob):
    """The runs in which only `knob` differs from the paper's setting, by its value."""
    others = [k for k in PAPER if k != knob]
    same = lambda row: (row.get("clustered_gather.storage", "full") == "full" and
                        all(number(row, f"clustered_gather.{k}") in (PAPER[k],) for k in others))
    return sorted(filter(same, rows), key=lambda row: number(row, f"clustered_gather.{knob}"))


def main():
    options = arguments(__doc__, "clustered_gather_sweeps")
    rows = good(read(options.csv), ["relative_percent", "relight_ms"], options.csv)
    require_varying(rows, [f"clustered_gather.{k}" for k in PAPER], options.csv, "clustered_gather_sweeps")
    sweeps = {knob: sweep(rows, knob) for knob in PAPER}
    short = [knob for knob, runs in sweeps.items() if len(runs) < 2]
    if short:
        sys.exit(f"{options.csv}: fewer than two runs of the sweep over {', '.join(short)}: is the experiment complete?")
    figure, panels = pyplot.subplots(2, len(PAPER), figsize=(3.0 * len(PAPER), 4.8), sharey="row")
    for column, (knob, runs) in enumerate(sweeps.items()):
        x = [number(row, f"clustered_gather.{knob}") for row in runs]
        errors, times = panels[0][column], panels[1][column]
        for name, label, colour in (("relative_percent", "all pixels", COLOURS[0]),
                                    ("edges_out_percent", "without edges", COLOURS[2]),
                                    ("indirect_percent", "indirect light alone", COLOURS[1])):
            errors.plot(x, [number(row, name) for row in runs], "o-", color=colour, markersize=3.5, label=label)
        middle = [number(row, "relight_ms") for row in runs]
        low = [m - number(row, "relight_min_ms") for m, row in zip(middle, runs)]
        high = [number(row, "relight_max_ms") - m for m, row in zip(middle, runs)]
        times.errorbar(x, middle, yerr=[low, high], fmt="o-", color="#303030", markersize=3.5)
        for axes in (errors, times):
            axes.axvline(PAPER[knob], color="#999999", linewidth=0.8, linestyle=":")
            axes.set_xscale("log")
            plain(axes)
            plain_numbers(axes.xaxis)
        times.set_xlabel(knob.replace("_", " "), fontsize=8)
    for row in panels:  # shared along a row: set once all of it is drawn
        row[0].set_ylim(bottom=0)
    panels[0][0].set_ylabel("relative error, %", fontsize=8)
    panels[1][0].set_ylabel("relight time, ms", fontsize=8)
    panels[0][0].legend(fontsize=7, frameon=False)
    save(figure, options.out)


if __name__ == "__main__":
    main()
