"""The table of a sweep, read by the reference implementation of the format.

Usage: read_parquet.py DIR

DIR holds what `uchain sweep` and `uchain report` left: both readers have to find the same numbers.
"""

import csv
import json
import math
import sys
from pathlib import Path

import pyarrow.parquet as pq


def main(folder):
    # Every page has a checksum, and pyarrow finds it right.
    table = pq.read_table(folder / "runs.parquet", page_checksum_verification=True)
    metadata = {key.decode(): value.decode() for key, value in table.schema.metadata.items()}
    sweep = json.loads((folder / "sweep.json").read_text(encoding="utf-8"))
    assert metadata["uchain.version"] == sweep["version"]
    assert metadata["uchain.scenario"] == sweep["scenario"]
    assert json.loads(metadata["uchain.design"]) == sweep["design"]
    assert int(metadata["uchain.seed"]) == sweep["seed"]

    rows = table.to_pylist()
    assert [row["run"] for row in rows] == list(range(sweep["runs"])), "a row a run, in order"
    replicates = sweep["replicates"]
    seeds = {}
    for i, row in enumerate(rows):
        assert (row["variant"], row["replicate"]) == divmod(i, replicates)
        assert seeds.setdefault(row["replicate"], row["seed"]) == row["seed"], "common random numbers"
        flown = row["digest"] is not None
        assert flown or row["failed"], "a run without results says why"
        if flown:
            assert len(row["launches_s"]) == row["launches"]
            assert row["launches_s"][-1:] == ([row["last_launch_s"]] if row["launches"] else [])
            assert len(row["link_true_db"]) == len(row["link_filtered_db"])
    assert len(set(seeds.values())) == replicates
    assert any(row["failed"] for row in rows) and not all(row["failed"] for row in rows)

    checked = 0
    with open(folder / "report.csv", encoding="utf-8", newline="") as file:
        for cell in csv.DictReader(file):
            values = [row[cell["metric"]] for row in rows if row["variant"] == int(cell["variant"])]
            values = [value for value in values if value is not None]
            assert len(values) == int(cell["runs"])
            assert math.isclose(sum(values) / len(values), float(cell["mean"]), rel_tol=1e-12, abs_tol=1e-12)
            checked += 1
    assert checked > 0
    print(f"{table.num_rows} rows of {table.num_columns} columns, {checked} means of the report found again")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
