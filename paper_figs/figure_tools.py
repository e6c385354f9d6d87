"""What the scripts of this folder have in common: reading table.csv of `relight run`, and writing an SVG."""

import argparse
import csv
import os
import sys
import tempfile

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot
from matplotlib.ticker import LogLocator, NullFormatter

COLOURS = ["#0a5f8a", "#c26a15", "#1a7f37", "#8e3b8a", "#b3261e", "#5c6f00", "#3d4fb8", "#7a5a3a"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "*"]
# Dates and random names would make two figures of one table differ.
pyplot.rcParams["svg.hashsalt"] = "relight"


def read(file):
    """The rows of table.csv; a sentence and exit code 1 if it is not one."""
    if not os.path.exists(file):
        sys.exit(f"{file}: there is no such table; `relight run experiments/NAME.toml` writes it")
    with open(file, newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    if not rows or "relative_percent" not in rows[0] or "relight_ms" not in rows[0]:
        sys.exit(f"{file}: not a table.csv of `relight run`: it has no errors or no times")
    return rows


def arguments(doc, experiment):
    """csv and out; `doc` is the script's own."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("csv", help=f"table.csv of experiments/{experiment}.toml")
    parser.add_argument("out", help="the SVG to write")
    return parser.parse_args()


def require_varying(rows, knobs, file, experiment):
    """table.csv has columns for the knobs that vary; exits if one of these does not."""
    missing = [k for k in knobs if k not in rows[0]]
    if missing:
        sys.exit(f"{file}: {', '.join(missing)} did not vary: run experiments/{experiment}.toml")


def number(row, column):
    """NaN for an empty cell or a missing column."""
    try:
        return float(row.get(column) or "nan")
    except ValueError:
        return float("nan")


def is_good(row, columns):
    return not row.get("failed") and all(number(row, c) > 0 for c in columns)


def good(rows, columns, file):
    """The runs without failures that have a positive number in each column; exits if there are none."""
    kept = [row for row in rows if is_good(row, columns)]
    if not kept:
        sys.exit(f"{file}: no run without failures has {' and '.join(columns)}")
    return kept


def scene_name(row):
    return os.path.splitext(os.path.basename(row["scene"]))[0]


def distinct(rows, key):
    return list(dict.fromkeys(key(row) for row in rows))


def plain(axes):
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=8)
    axes.grid(True, which="major", color="#e4e4e4", linewidth=0.6)


def plain_numbers(axis):
    """No powers of ten on a logarithmic axis; labels between the decades where it spans few of them."""
    low, high = axis.get_view_interval()
    few = high / low < 150
    axis.set_major_locator(LogLocator(subs=(1, 2, 5) if few else (1,)))
    axis.set_major_formatter(lambda value, _: f"{value:g}")
    axis.set_minor_formatter(NullFormatter())


def save(figure, out, room_above=0.0):
    figure.tight_layout(rect=(0, 0, 1, 1 - room_above / figure.get_figheight()))  # [inches]
    folder = os.path.dirname(os.path.abspath(out))
    os.makedirs(folder, exist_ok=True)
    with tempfile.NamedTemporaryFile(dir=folder, suffix=".svg", delete=False) as temporary:
        figure.savefig(temporary, format="svg", metadata={"Date": None})
    os.chmod(temporary.name, 0o644)
    os.replace(temporary.name, out)
