"""Tables: equal for every data frame, in every process, in every file; and what they say."""

import copy
import pathlib
import pickle
import subprocess
from typing import Any

import numpy as np
import pytest
from conftest import optional

import uchain


def short(name: str = "straight", **values: Any) -> uchain.Scenario:
    return uchain.Scenario.from_name(name).with_(**({"duration_s": 5} | values))


@pytest.fixture(scope="module")
def table() -> uchain.Table:
    """Some of its runs cannot be flown: most of their cells are absent."""
    scenario = short("corner", **{"faults.dead": [{"uav": 0, "start_s": 1}]})
    vary: dict[str, list[Any]] = {"chain.spacing_m": [0.05, 0.25], "faults.dead.0.start_s": [1, 100]}
    return uchain.sweep(scenario, vary, replicates=6, progress=False)


def as_lists(table: uchain.Table) -> dict[str, list[Any]]:
    """Its columns as lists of Python, absent as None."""

    def plain(value: Any) -> Any:
        if isinstance(value, np.ndarray):
            return [plain(item) for item in value]
        return None if value is None or value != value else value

    return {name: [plain(value) for value in table[name]] for name in table.columns}


def test_columns_are_arrays_of_the_types_that_the_schema_says(table: uchain.Table):
    assert len(table) == 24 and table.columns[:4] == ["run", "variant", "replicate", "seed"]
    assert list(table) == table.columns and "failed" in table and "fail" not in table and 3 not in table
    kinds = {"text": "object", "list of float64": "object", "list of float32": "object"}
    for name, kind in table.schema.items():
        array = table[name]
        assert array.shape == (24,)
        is_absent = kind == "int64" and array.dtype == np.float64 and bool(np.isnan(array).any())
        assert is_absent or array.dtype == kinds.get(kind, kind), name
    assert {"int64", "float64", "float32", "text"} < set(table.schema.values())
    assert any(kind.startswith("list") for kind in table.schema.values())
    assert list(table["run"]) == list(range(24)) and table["run"].dtype == np.int64
    flown = table["failed"] != table["failed"][0]
    assert flown.sum() == 12 and np.isnan(table["sim_s"][~flown]).all() and (table["sim_s"][flown] == 5).all()
    with pytest.raises(KeyError, match="no column 'speed'; `columns` lists"):
        table["speed"]
    with pytest.raises(TypeError, match="expected the name of a column"):
        table[3]  # type: ignore[index]


def test_data_frames_take_it_as_it_is(table: uchain.Table):
    wanted = as_lists(table)
    arrow = optional("pyarrow").table(table)
    assert arrow.to_pydict() == wanted
    assert optional("polars").DataFrame(table).to_dict(as_series=False) == wanted
    pandas = optional("pandas").DataFrame.from_arrow(table)
    assert pandas["digest"].dropna().tolist() == [text for text in wanted["digest"] if text]
    assert pandas["sim_s"].sum() == 5.0 * 12
    duckdb = optional("duckdb")
    runs = table
    assert duckdb.sql("select count(*), count(failed), sum(sim_s) from runs").fetchall() == [(24, 18, 60.0)]
    assert runs is table


def test_a_schema_may_be_asked_for(table: uchain.Table):
    pyarrow = optional("pyarrow")
    schema = pyarrow.schema(table)
    assert schema.names == table.columns and schema.field("digest").type == pyarrow.string()
    larger = pyarrow.schema([
        pyarrow.field(f.name, pyarrow.large_string()) if f.type == pyarrow.string() else f for f in schema
    ])
    cast = pyarrow.RecordBatchReader.from_stream(table, schema=larger).read_all()
    assert cast.schema.field("digest").type == pyarrow.large_string()
    assert cast["digest"].to_pylist() == as_lists(table)["digest"]


def test_parquet_is_read_by_others_as_it_is_in_memory(table: uchain.Table, tmp_path: pathlib.Path):
    path = tmp_path / "runs.parquet"
    table.to_parquet(path)
    read = optional("pyarrow.parquet").read_table(path)
    assert read.to_pydict() == as_lists(table)
    assert read.schema.metadata[b"uchain.name"] == b"corner"
    assert [file.name for file in tmp_path.iterdir()] == ["runs.parquet"]
    with pytest.raises(FileNotFoundError, match="cannot write"):
        table.to_parquet(tmp_path / "absent" / "runs.parquet")
    assert not (tmp_path / "absent").exists()


def test_it_is_pickled_in_few_bytes_and_comes_back_equal(table: uchain.Table):
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        assert pickle.loads(pickle.dumps(table, protocol)) == table
    assert copy.deepcopy(table) == table and copy.copy(table) == table
    part = uchain.sweep(short(), replicates=50, shard=(2, 2), progress=False)
    assert pickle.loads(pickle.dumps(part)) == part
    few, many = (len(pickle.dumps(uchain.sweep(short(), replicates=n, progress=False))) for n in (100, 600))
    assert (many - few) / 500 < 400, "bytes a row"


def test_what_is_no_pickle_of_a_table_is_refused(table: uchain.Table):
    arguments: Any = table.__reduce__()[1]
    about, rows = arguments
    for bad_about, bad_rows in [("", rows), ("{}", rows), (about, b""), (about, rows[:-9]), (about, rows[:900])]:
        with pytest.raises(uchain.SweepError, match="<table> is damaged"):
            uchain.Table._unpickled(bad_about, bad_rows)


def test_tables_are_equal_bit_for_bit_and_know_what_they_are_of(table: uchain.Table):
    one, two = (uchain.sweep(short(), replicates=4, seed=seed, progress=False) for seed in (1, 2))
    assert one != two and one == one and one != 3
    with pytest.raises(TypeError, match="unhashable"):
        hash(one)
    assert (one.scenario, one.seed, one.replicates, one.variants, one.is_complete) == ("straight", 1, 4, 1, True)
    assert one.about["set"] == ["duration_s=5"] and one.about["runs"] == 4 and one.about["version"] == uchain.__version__
    assert table.about["design"] == {
        "vary": ["chain.spacing_m=0.05,0.25", "faults.dead.0.start_s=1,100"], "table": None
    }
    assert len(one.digest) == 16 and one.digest != two.digest
    assert repr(one) == f"<uchain.Table straight: 4 runs, {len(one.columns)} columns>"


def test_a_notebook_shows_the_first_rows(table: uchain.Table):
    html = table._repr_html_()
    assert html.count("<tr>") == 11 and "<th>radio" not in html and "<th>chain.spacing_m</th>" in html
    assert "<uchain" not in html and len(html) < 20_000


def test_many_rows_are_read_block_by_block():
    pyarrow = optional("pyarrow")
    # The shortest flights there are; three blocks of rows.
    many = uchain.sweep(short(duration_s=0.1), replicates=40_000, progress=False)
    sizes = [batch.num_rows for batch in pyarrow.RecordBatchReader.from_stream(many)]
    assert sizes == [16_384, 16_384, 7232]
    assert pyarrow.table(many)["run"].to_pylist() == list(range(40_000)) == list(many["run"])
    assert pickle.loads(pickle.dumps(many)) == many


# --- reports


@pytest.mark.parametrize("varied", [{"radio.sigma_db": [0, 4]}, None], ids=["two variants", "one"])
def test_a_report_has_the_files_of_the_command_line(
    cli: pathlib.Path, tmp_path: pathlib.Path, varied: dict[str, Any] | None
):
    out, ours = tmp_path / "out", tmp_path / "ours"
    table = uchain.sweep(short(), varied, replicates=5, out=out, progress=False)
    said = subprocess.run([cli, "report", out], check=True, capture_output=True, text=True).stdout
    memory = uchain.sweep(short(), varied, replicates=5, progress=False)
    report = memory.report()
    assert said.startswith(str(report)) and str(report).startswith("# Sweep of straight\n")
    report.save(ours)
    names = sorted(path.relative_to(ours) for path in ours.rglob("*") if path.is_file())
    assert pathlib.Path("plots/head_reach_m.png") in names
    for name in names:
        assert (ours / name).read_bytes() == (out / name).read_bytes(), name
    report.save(ours)
    assert table == memory


def test_a_report_counts_what_numpy_counts(table: uchain.Table):
    report = table.report()
    reach = report.numbers["head_reach_m"]
    values = table["head_reach_m"].astype(float).reshape(4, 6)
    assert list(reach["runs"]) == [0, 0, 6, 6]
    np.testing.assert_allclose(reach["mean"][2:], values[2:].mean(axis=1))
    np.testing.assert_allclose(reach["median"][2:], np.median(values[2:], axis=1))
    assert np.isnan(reach["mean"][:2]).all() and (reach["mean_low"][2:] <= reach["mean"][2:]).all()
    assert [(row["runs"], row["first"]) for row in report.failures] == [(12, 0), (6, 12)]
    assert report.failures[0]["failed"].startswith("not flown: ") and "at 1.00 s" in report.failures[1]["verdict"]
    assert "![" in str(report) and "![" not in report._repr_markdown_()
    assert str(pickle.loads(pickle.dumps(report))) == str(report)


def test_a_report_leaves_the_pictures_of_others_alone(table: uchain.Table, tmp_path: pathlib.Path):
    (tmp_path / "plots").mkdir()
    (tmp_path / "plots" / "mine.png").touch()
    with pytest.raises(uchain.SweepError, match=r"holds something else \(plots\); name another folder"):
        table.report().save(tmp_path)
    assert [path.name for path in tmp_path.rglob("*") if path.is_file()] == ["mine.png"]


def test_a_picture_of_a_report_is_that_of_the_command_line(cli: pathlib.Path, tmp_path: pathlib.Path):
    out = tmp_path / "out"
    table = uchain.sweep(short(), {"radio.sigma_db": [0, 4]}, replicates=3, out=out, progress=False)
    subprocess.run([cli, "report", out, "--quiet"], check=True)
    report = table.report()
    pictures = report.pictures()
    assert set(pictures) == {path.stem for path in (out / "plots").glob("*.png")}
    for name, picture in pictures.items():
        assert bytes(picture) == (out / "plots" / f"{name}.png").read_bytes(), name
    assert report.picture("head_reach_m") == pictures["head_reach_m"]
    constant = next(name for name in report.numbers if name not in pictures)
    assert report.picture(constant) is None
    with pytest.raises(KeyError, match="no number 'speed'"):
        report.picture("speed")
