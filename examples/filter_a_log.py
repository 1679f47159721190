"""A real log of RSSI through the filter that flies: does it expect the errors it makes, and what does motion add?

    python examples/filter_a_log.py FOLDER

FOLDER holds the data set "BLE RSS dataset for fingerprinting radio map calibration" (M. Kolakowski, 2021, CC BY 4.0,
doi:10.5281/zenodo.5457591): six anchors in a flat, and a robot that hears them while it drives. Each anchor is a link to
a base that stands; the robot's end of it moves by the speed at which the robot drives away from the anchor.

A filter that knows itself is right about its own errors: the innovation (sample minus prediction), divided by what the
filter expects of it, has mean square 1 and does not repeat from one sample to the next. The paper's noise (Laclau 2021:
R = 5 dB^2) is that of its simulator; `fitted` takes R and the slope of loss over distance from the 4,104 poses of the
calibration drives, and is judged by the test drive like the others. It prints

    719 samples in 352 s, 6 anchors
    filter                        RMS (dB)     NIS  repeats
    paper, no motion                  4.37    3.11     0.15
    paper, motion                     4.87    3.84     0.30
    fitted, no motion                 4.95    0.56     0.41
    fitted, motion                    4.82    0.53     0.37
    fitted: slope 1.8 to 3.1 dB/m, R 24 to 59 dB^2

So in this flat the paper's R is too small (the errors are three times what the filter expects), its gain on motion, four
to five times the physical slope on purpose, makes predictions worse, and with the slope of this flat motion helps a
little. With the R of a line through all poses the filter expects too much, and follows so slowly that its errors repeat:
what scatters about the line is mostly the place, not the sample.
"""

import csv
import pathlib
import sys

import numpy as np

from uchain.laws import ScalarKalman


def read(file: pathlib.Path, anchors: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times (n,) in s, places (n, 2) in m, losses (n, anchors) in dB; NaN where nothing was heard."""
    with open(file) as text:
        rows = list(csv.DictReader(text))
    time_s = np.array([float(row["ts"]) for row in rows]) * 1e-9
    at_m = np.array([[float(row["x"]), float(row["y"])] for row in rows])
    heard = [[row[f"rssi_{i + 1}"] for i in range(anchors)] for row in rows]
    loss_db = np.array([[-float(rssi) if rssi else np.nan for rssi in row] for row in heard], np.float32)
    return time_s - time_s[0], at_m, loss_db


def separating(anchor_m: np.ndarray, time_s: np.ndarray, at_m: np.ndarray) -> np.ndarray:
    """How fast the robot drives away from an anchor (n,), m/s: what optic flow knows on a straight way."""
    distance_m = np.linalg.norm(at_m - anchor_m, axis=1)
    period_s = np.maximum(np.diff(time_s, prepend=time_s[0]), 1e-3)
    return (np.diff(distance_m, prepend=distance_m[0]) / period_s).astype(np.float32)


def statistics(log: dict[str, np.ndarray]) -> tuple[float, float, float]:
    """RMS of the innovation (dB), its mean square against what was expected (NIS), correlation of neighbours."""
    innovation_db = log["innovation_db"].astype(float)
    expected_db2 = log["innovation_variance_db2"].astype(float)
    heard = np.isfinite(innovation_db)
    innovation_db, expected_db2 = innovation_db[heard], expected_db2[heard]
    repeats = float(np.corrcoef(innovation_db[:-1], innovation_db[1:])[0, 1])
    return float(np.sqrt(np.mean(innovation_db**2))), float(np.mean(innovation_db**2 / expected_db2)), repeats


def fitted(anchor_m: np.ndarray, at_m: np.ndarray, loss_db: np.ndarray) -> tuple[float, float]:
    """Slope of loss over distance (dB/m), and variance of the samples about that line (dB^2)."""
    heard = np.isfinite(loss_db)
    distance_m = np.linalg.norm(at_m[heard] - anchor_m, axis=1)
    line = np.polyfit(distance_m, loss_db[heard], 1)
    return float(line[0]), float(np.var(loss_db[heard] - np.polyval(line, distance_m)))


def main(folder: pathlib.Path) -> None:
    with open(folder / "anchors.csv") as text:
        anchors = np.array([[float(row["x"]), float(row["y"])] for row in csv.DictReader(text)])
    _, at_m, loss_db = read(folder / "calibration" / "calibration_df.csv", len(anchors))
    fits = [fitted(anchor, at_m, loss_db[:, i]) for i, anchor in enumerate(anchors)]
    time_s, at_m, loss_db = read(folder / "tests" / "test_robot_df.csv", len(anchors))
    print(f"{len(time_s)} samples in {time_s[-1]:.0f} s, {len(anchors)} anchors")
    print(f"{'filter':<28}{'RMS (dB)':>10}{'NIS':>8}{'repeats':>9}")
    kinds = [
        ("paper, no motion", False, lambda i: {"flow_gain_db_per_m": 0.0}),
        ("paper, motion", True, lambda i: {}),
        ("fitted, no motion", False, lambda i: {"measurement_variance_db2": fits[i][1]}),
        (
            "fitted, motion",
            True,
            lambda i: {"measurement_variance_db2": fits[i][1], "flow_gain_db_per_m": fits[i][0]},
        ),
    ]
    for name, moves, params in kinds:
        found = []
        for i, anchor in enumerate(anchors):
            speed_mps = separating(anchor, time_s, at_m) if moves else None
            log = ScalarKalman.filter(time_s, loss_db[:, i].copy(), speed_mps, **params(i))
            found.append(statistics(log))
        rms_db, nis, repeats = np.mean(found, axis=0)
        print(f"{name:<28}{rms_db:>10.2f}{nis:>8.2f}{repeats:>9.2f}")
    slopes, variances = zip(*fits, strict=True)
    print(
        f"fitted: slope {min(slopes):.1f} to {max(slopes):.1f} dB/m, "
        f"R {min(variances):.0f} to {max(variances):.0f} dB^2"
    )


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
