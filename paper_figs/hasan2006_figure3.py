#!/usr/bin/python3
"""Hasan, Pellacini, Bala 2006, figure 3: error against the number of kept wavelet coefficients.

    paper_figs/hasan2006_figure3.py out/figure3/table.csv figure.svg

Reads table.csv of `relight run experiments/figure3.toml`. The paper prints two numbers, at 100 coefficients (section 3.7);
its picture of the other numbers of coefficients has no errors.
"""

from figure_tools import (COLOURS, MARKERS, arguments, distinct, good, number, plain, plain_numbers, pyplot, read,
                          require_varying, save, scene_name)

X = "direct_to_indirect.coefficients"
PAPER = {"relative_percent": 13.6, "edges_out_percent": 5.4}
TITLES = {"relative_percent": "all pixels", "edges_out_percent": "without edges", "indirect_percent": "indirect light alone"}


def main():
    options = arguments(__doc__, "figure3")
    rows = read(options.csv)
    require_varying(rows, [X], options.csv, "figure3")
    rows = good(rows, [X, *TITLES], options.csv)
    series = distinct(rows, lambda row: (scene_name(row), row["lights"], row["preset"]))
    figure, panels = pyplot.subplots(1, len(TITLES), figsize=(3.3 * len(TITLES), 3.0))
    for axes, (column, title) in zip(panels, TITLES.items()):
        for name, colour, marker in zip(series, COLOURS, MARKERS):
            mine = sorted((row for row in rows if (scene_name(row), row["lights"], row["preset"]) == name),
                          key=lambda row: number(row, X))
            widths = [number(row, "relative_half_width") for row in mine] if column == "relative_percent" else None
            axes.errorbar([number(row, X) for row in mine], [number(row, column) for row in mine], yerr=widths,
                          color=colour, marker=marker, markersize=3.5, linewidth=1.1, label=", ".join(name))
        if column in PAPER:
            axes.plot(100, PAPER[column], "x", color="black", markersize=7, label="the paper (its own scene)")
        axes.set_xscale("log")
        axes.set_ylim(bottom=0)
        axes.set_title(title, fontsize=9)
        axes.set_xlabel("coefficients a row", fontsize=8)
        plain(axes)
        plain_numbers(axes.xaxis)
    panels[0].set_ylabel("relative error, %", fontsize=8)
    panels[1].legend(fontsize=7, frameon=False)
    save(figure, options.out)


if __name__ == "__main__":
    main()
