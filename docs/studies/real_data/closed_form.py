#!/usr/bin/env python3
"""What the sets of this folder show by themselves: least squares of log E, by hand, before nacre is asked.

usage: closed_form.py [SET...]
Of each set: E as a power of the rate within every material, piece and temperature (mean exponent, and its standard
error by the scatter between pieces or temperatures, or of the line where there is one alone); the change with
temperature at equal frequency; machines at equal rate; blends off the line between their neighbours; errors at rates
that are left out.
"""
import csv
import math
import pathlib
import sys


def read(folder):
    with open(folder / "measurements.csv") as file:
        rows = [row for row in csv.DictReader(file) if row.get("valid", "1") != "0"]
    for row in rows:
        row["log_e"] = math.log(float(row["modulus_pa"]))
        row["rate"] = float(row["strain_rate_per_s"] or "nan")
        row["around"] = round(float(row.get("temperature_c") or "nan") / 5) * 5 if row.get("temperature_c") else None
        row["piece"] = row.get("sample") or row["specimen"]
    return rows


def line(points):
    """Slope of y over x, its standard error (None without freedom left), and the scatter about the line."""
    n = len(points)
    mx, my = sum(x for x, _ in points) / n, sum(y for _, y in points) / n
    sxx = sum((x - mx) ** 2 for x, _ in points)
    if sxx == 0:
        return None
    slope = sum((x - mx) * (y - my) for x, y in points) / sxx
    if n < 3:
        return slope, None, None
    sd = math.sqrt(sum((y - my - slope * (x - mx)) ** 2 for x, y in points) / (n - 2))
    return slope, sd / math.sqrt(sxx), sd


def groups(rows, *keys):
    result = {}
    for row in rows:
        result.setdefault(tuple(row.get(key) for key in keys), []).append(row)
    return result


def mean_and_error(values):
    n, mean = len(values), sum(values) / len(values)
    if n < 2:
        return mean, None
    return mean, math.sqrt(sum((v - mean) ** 2 for v in values) / (n - 1) / n)


def said(value, error):
    return f"{value:+.3f}" + (f" +- {error:.3f}" if error is not None else " (no error: nothing repeated)")


def rates(rows):
    for (pattern,), of_pattern in sorted(groups(rows, "pattern").items()):
        swept = [g for g in groups(of_pattern, "piece", "around", "machine").values() if len({r["rate"] for r in g}) > 2]
        if swept:
            slopes = [line([(math.log(r["rate"]), r["log_e"]) for r in g])[0] for g in swept]
            print(f"  {pattern}: exponent of the rate {said(*mean_and_error(slopes))} over {len(slopes)} sweeps,"
                  f" {min(slopes):+.3f} to {max(slopes):+.3f}")
            continue
        points = [(math.log(r["rate"]), r["log_e"]) for r in of_pattern if r["rate"] == r["rate"]]
        fit = line(points) if len({x for x, _ in points}) > 1 else None
        if fit:
            scatter = f", scatter {fit[2]:.3f}" if fit[2] is not None else ""
            print(f"  {pattern}: exponent of the rate {said(fit[0], fit[1])} over {len(points)} tests{scatter}")
        else:
            mean, error = mean_and_error([r["log_e"] for r in of_pattern])
            sd = error * math.sqrt(len(of_pattern)) if error else float("nan")
            print(f"  {pattern}: {len(of_pattern)} tests of one rate or of none noted, scatter {sd:.3f}")


def temperatures(rows):
    for (pattern,), of_pattern in sorted(groups(rows, "pattern").items()):
        by = {k[0]: sum(r["log_e"] for r in g) / len(g) for k, g in groups(of_pattern, "around").items() if k[0] is not None}
        if len(by) > 1:
            low, high = min(by), max(by)
            print(f"  {pattern}: E at {high} C over E at {low} C {math.exp(by[high] - by[low]):.3g}, {len(by)} temperatures")


def machines(rows):
    if len({r.get("machine") for r in rows}) < 2:
        return
    for (around,), at in sorted(groups(rows, "around").items(), key=lambda i: str(i[0])):
        fits = {}
        for (machine,), of_machine in groups(at, "machine").items():
            levels, slopes = [], []
            for piece in groups(of_machine, "piece").values():
                points = [(math.log(r["rate"]), r["log_e"]) for r in piece if 5e-3 < r["rate"] < 0.1]
                if len({x for x, _ in points}) < 2:
                    continue
                slope = line(points)[0]
                mx, my = (sum(v) / len(points) for v in zip(*points))
                levels.append(my + slope * (math.log(0.02) - mx)), slopes.append(slope)
            if levels:
                fits[machine] = (mean_and_error(levels), mean_and_error(slopes))
        for machine, (level, slope) in fits.items():
            print(f"  {around} C, {machine}: log E at 0.02 1/s {said(*level)}, exponent {said(*slope)}")


def blends(rows):
    share = {"soft": 0.0, "interface": 0.5, "rigid": 1.0}
    levels = {}
    for (pattern, around), g in groups(rows, "pattern", "around").items():
        f = share.get(pattern, float(pattern[4:]) if pattern.startswith("mix:") else None)
        levels.setdefault(around, {})[f] = mean_and_error([r["log_e"] for r in g])
    for around, of in sorted(levels.items(), key=lambda i: str(i[0])):
        at = sorted(of)
        for low, middle, high in zip(at, at[1:], at[2:]):
            w = (middle - low) / (high - low)
            straight = (1 - w) * of[low][0] + w * of[high][0]
            print(f"  {around} C, mix:{middle:g}: log E off the straight line between mix:{low:g} and mix:{high:g}"
                  f" {of[middle][0] - straight:+.2f}")


def held_out(rows):
    """Every rate of a material, temperature and machine left out in turn: mean error of log E there by a constant and by
    a power of the rate, drawn through the other rates."""
    by_constant, by_power = [], []
    for of in groups(rows, "pattern", "around", "machine").values():
        at = {}
        for row in of:
            if row["rate"] == row["rate"]:
                at.setdefault(round(math.log(row["rate"]) / math.log(1.3)), []).append(row)
        if len(at) < 3:
            continue
        for left_out, tests in at.items():
            others = [(math.log(r["rate"]), r["log_e"]) for k, g in at.items() if k != left_out for r in g]
            slope = line(others)[0]
            mx, my = (sum(v) / len(others) for v in zip(*others))
            x, y = (sum(v) / len(tests) for v in zip(*((math.log(r["rate"]), r["log_e"]) for r in tests)))
            by_constant.append(abs(y - my)), by_power.append(abs(y - my - slope * (x - mx)))
    if by_constant:
        constant, power = (sum(v) / len(v) for v in (by_constant, by_power))
        print(f"  held-out rates: error of a constant {constant:.3f}, of a power {power:.3f}, {1 - power / constant:.0%} less")


def main():
    here = pathlib.Path(__file__).resolve().parent
    for name in sys.argv[1:] or sorted(p.parent.name for p in here.glob("*/measurements.csv")):
        rows = read(here / name)
        print(f"{name}: {len(rows)} rows, {len({r['piece'] for r in rows})} pieces")
        for part in (rates, temperatures, machines, blends, held_out):
            part(rows)


main()
