#!/usr/bin/python3
"""Hasan, Pellacini, Bala 2006, table 2 and section 3.7, beside what was measured here, as a Markdown table.

Reads the table.csv of `relight run experiments/hasan2006_table2.toml`; writes nothing but its output:

    paper_figs/hasan2006_table2.py out/hasan2006_table2/table.csv [remark] > results/hasan2006_table2/README.md
"""
import csv
import os
import sys
import tomllib

# Where the paper's figures are kept, for `relight run`, too.
NUMBERS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "experiments", "paper_numbers",
                       "hasan2006_table2.toml")
# Ours -> the paper's scene of the same kind.
LIKE = {"sponza": "Sponza", "still_life": "Still", "hair_ball": "Hair", "temple": "Temple"}


def paper(scene):
    """What the paper prints of the scene, by what it is."""
    with open(NUMBERS, "rb") as file:
        groups = tomllib.load(file)["groups"]
    return {f["what"]: f["printed"] for g in groups if g["match"].get("scene") == scene for f in g["figures"]}


def middle(printed):
    low, high = map(float, printed.split(" to "))
    return f"{(low + high) / 2:.1f}"


def number(row, column):
    return float(row[column]) if row.get(column) else None


def show(value, form="{:.1f}"):
    return "-" if value is None else form.format(value)


def scene_name(row):
    return os.path.splitext(os.path.basename(row["scene"]))[0]


def find(rows, scene, lights, preset, cull):
    """The run at that culling; where a preset was run at one culling only, that run stands for -1 (nothing culled)."""
    runs = [r for r in rows if (scene_name(r), r["lights"], r["preset"]) == (scene, lights, preset)
            and r.get("frames_a_second")]
    for row in runs:
        if float(row["direct_to_indirect.cull_epsilon"] or 0) == cull:
            return row
    return runs[0] if len(runs) == 1 and cull == -1.0 else {}


def first(rows, scene, preset, column):
    """Only the run that precomputed has the stage; the others loaded what it made."""
    for row in rows:
        if (scene_name(row), row["preset"]) == (scene, preset) and row.get(column):
            return float(row[column])
    return None


def costs(rows, scenes, presets):
    print("| scene | preset | final gather s | rays a pixel | matrix MB | stored MB | spot fps, cull on / off "
          "| omni fps, cull on / off |\n|---|---|---|---|---|---|---|---|")
    for scene in scenes:
        if scene in LIKE:
            said = paper(scene)
            fps = {(lights, cull): middle(said[f"frames a second, {lights}, culling {cull}"])
                   for lights in ("spot", "omni") for cull in ("on", "off")}
            print(f"| {LIKE[scene]} | *the paper's* | *{said['final gather preprocess']} h* "
                  f"| *{said['visibility rays a view sample']}* | | *{said['final gather size']}* "
                  f"| *{fps['spot', 'on']} / {fps['spot', 'off']}* | *{fps['omni', 'on']} / {fps['omni', 'off']}* |")
        for preset in presets:
            rays = first(rows, scene, preset, "count.visibility_rays")
            fps = {(lights, cull): number(find(rows, scene, lights, preset, cull), "frames_a_second")
                   for lights in ("spot", "omni") for cull in (-1.0, 0.0001)}
            if not any(fps.values()):
                continue
            print(f"| `{scene}` | {preset} | {show(first(rows, scene, preset, 'precompute.final_gather_s'))} "
                  f"| {show(rays / 307200 if rays else None, '{:.0f}')} "
                  f"| {show(first(rows, scene, preset, 'megabytes.final_gather_matrix'))} "
                  f"| {show(first(rows, scene, preset, 'megabytes.transfer_product'))} "
                  f"| {show(fps['spot', 0.0001])} / {show(fps['spot', -1.0])} "
                  f"| {show(fps['omni', 0.0001])} / {show(fps['omni', -1.0])} |")


def stages(rows, scenes, presets):
    print("\n| scene | preset | light | shadow maps / rays ms | shading | transform, cull on / off | filtering |\n"
          "|---|---|---|---|---|---|---|")
    for scene in scenes:
        for preset in presets:
            for lights in ("spot", "omni"):
                on, off = (find(rows, scene, lights, preset, cull) for cull in (0.0001, -1.0))
                if not off:
                    continue
                ms = lambda row, stage: number(row, f"relight.{stage}_ms")
                print(f"| `{scene}` | {preset} | {lights} | {show(ms(off, 'shadow_maps'))} / {show(ms(off, 'shadow_rays'))} "
                      f"| {show(ms(off, 'direct_shading'))} | {show(ms(on, 'transfer'))} / {show(ms(off, 'transfer'))} "
                      f"| {show(ms(off, 'reconstruction'))} |")


def errors(rows, scenes, presets):
    print("\n| scene | light | preset | all pixels % | edges out % | indirect alone % | floor % | culled at 1e-4: all |\n"
          "|---|---|---|---|---|---|---|---|\n| *the paper's* | | | *13.6* | *5.4* | | | |")
    for scene in scenes:
        for lights in ("spot", "spot2", "omni"):
            for preset in presets:
                row = find(rows, scene, lights, preset, -1.0)
                if row:
                    culled = find(rows, scene, lights, preset, 0.0001)
                    cells = [number(row, c + "_percent")
                             for c in ("relative", "edges_out", "indirect", "noise_floor")]
                    cells.append(number(culled, "relative_percent"))
                    print(f"| `{scene}` | {lights} | {preset} | " +
                          " | ".join(show(c, "{:.2f}") for c in cells) + " |")


def main():
    with open(sys.argv[1], newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    scenes = list(dict.fromkeys(scene_name(r) for r in rows))
    presets = list(dict.fromkeys(r["preset"] for r in rows))
    cpus = ", ".join(sorted({r["cpu"] for r in rows if r.get("cpu")}))
    commits = ", ".join(sorted({r["commit"] for r in rows if r.get("commit")}))
    print("# Hasan, Pellacini, Bala 2006, table 2, made again\n\n"
          "Made by `paper_figs/hasan2006_table2.py` from table.csv, which `relight run experiments/hasan2006_table2.toml` "
          f"wrote on: {cpus}, two cores, OSMesa (no GPU); commits {commits}. 640x480, 65,536 gather samples, 100 "
          "coefficients, one bounce. The paper: GeForce 7800, Pentium 4; its scenes are other models of the same kind, "
          "except Sponza. Stored MB: the product's form (8 bits; `best` 16). Frame rates are of the median of five relights; "
          "culling on is `cull_epsilon=0.0001`, off is -1; `best` multiplies by rows and culls nothing." + "".join(f" {r}" for r in sys.argv[2:]) + "\n")
    costs(rows, scenes, presets)
    stages(rows, scenes, presets)
    errors(rows, scenes, presets)


if __name__ == "__main__":
    main()
