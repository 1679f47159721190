"""Before anyone flies: plans and optima, the same as the command line's."""

import json
import pathlib
import pickle
import subprocess
from typing import Any

import numpy as np
import pytest

import uchain


def plan_of(cli: pathlib.Path, folder: pathlib.Path, *words: str) -> tuple[dict[str, Any], str, bytes]:
    out = folder / "out"
    command = [cli, "plan", *words, "--out", out, "--force"]
    told = json.loads(subprocess.run([*command, "--json"], check=True, capture_output=True).stdout)
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return told, text, (out / "plan.png").read_bytes()


def test_a_plan_is_that_of_the_command_line(cli: pathlib.Path, tmp_path: pathlib.Path):
    told, text, png = plan_of(cli, tmp_path, "corner", "--to", "9", "--uavs", "3", "--speed", "0.1", "--step", "1")
    plan = uchain.plan("corner", to_m=9, uavs=3, speed_mps=0.1, step_m=1)
    assert plan.summary.to_dict() == told
    assert str(plan) == text[: text.index("files: ")] and plan.answer in text
    assert bytes(plan.plot()) == png == plan._repr_png_()
    assert plan.uavs_needed == told["uavs_needed"]
    rows = plan.rows
    assert rows.rows == len(told["rows"]) == 9
    np.testing.assert_array_equal(rows["depth_m"], [row["depth_m"] for row in told["rows"]])
    for row, told_row in enumerate(told["rows"]):
        listed = told_row["bottleneck_by_links_db"]
        np.testing.assert_array_equal(plan.bottleneck_by_links_db[row, : len(listed)], listed)
        assert np.isnan(plan.bottleneck_by_links_db[row, len(listed) :]).all()
        assert rows["feasible"][row] == told_row["feasible"]
    other, _, _ = plan_of(cli, tmp_path, "corner", "--to", "9", "--uavs", "3", "--speed", "0.2", "--step", "1")
    assert other != told, "the control: another speed"


def test_a_plan_takes_a_scenario_with_values_written_over_it(cli: pathlib.Path, tmp_path: pathlib.Path):
    told, _, _ = plan_of(cli, tmp_path, "straight", "--set", "takeoff.s_min_db=55")
    tight = uchain.Scenario.from_name("straight").with_(**{"takeoff.s_min_db": 55})
    assert uchain.plan(tight).summary.to_dict() == told
    assert uchain.plan("straight").uavs_needed < told["uavs_needed"]
    copy = pickle.loads(pickle.dumps(uchain.plan(tight)))
    assert copy.summary == told and copy.plot() == uchain.plan(tight).plot()


def test_what_cannot_be_planned_is_refused_in_words(tmp_path: pathlib.Path):
    with pytest.raises(uchain.ScenarioError, match="to_m = 99: the tunnel ends"):
        uchain.plan("straight", to_m=99)
    with pytest.raises(uchain.ScenarioError, match=r"base_m=\(99, 0\).*rock"):
        uchain.plan("straight", base_m=(99, 0))
    with pytest.raises(uchain.ScenarioError, match=r"cave.yaml is a bare map: add base_m=\(X, Y\)"):
        uchain.plan(tmp_path / "cave.yaml", goal_m=(1, 2))
    with pytest.raises(uchain.ScenarioError, match="cave.yaml"):
        uchain.plan(tmp_path / "cave.yaml", goal_m=(1, 2), base_m=(0, 0))
    for name, value in [("to_m", -1), ("to_m", float("nan")), ("speed_mps", 2), ("uavs", 0), ("heading_deg", 900)]:
        with pytest.raises(ValueError, match=f"{name} = .*: expected"):
            uchain.plan("straight", **{name: value})
    with pytest.raises(uchain.ScenarioError, match="explore"):
        uchain.plan("apartment")


def test_the_optimum_is_as_good_as_can_be_and_where_it_says():
    best = uchain.optimum("straight", head_depth_m=12, relays=2)
    assert best.relays == 2 and best.depths_m[0] == 12 and best.depths_m[-1] == 0
    assert (np.diff(best.depths_m) < 0).all()
    assert best.bottleneck_db == best.link_loss_db.max()
    # In a straight tunnel all links are equal (Laclau 2021, Eq. 9).
    np.testing.assert_allclose(best.link_loss_db, best.bottleneck_db, atol=0.01)
    steps_m = np.hypot(*np.diff(best.places_m, axis=0).T)
    np.testing.assert_allclose(steps_m, -np.diff(best.depths_m), rtol=1e-4)
    assert uchain.optimum("straight", head_depth_m=12, relays=3).bottleneck_db < best.bottleneck_db
    copy = pickle.loads(pickle.dumps(best))
    np.testing.assert_array_equal(copy.places_m, best.places_m)


def test_the_optimum_is_the_row_of_a_plan():
    plan = uchain.plan("corner", step_m=1)
    depth_m = float(plan.rows["depth_m"][-1])
    best = uchain.optimum("corner", depth_m)
    assert best.relays == plan.rows["relays_needed"][-1]
    assert best.bottleneck_db == plan.rows["bottleneck_db"][-1]
    np.testing.assert_array_equal(
        plan.bottleneck_by_links_db[-1, :2],
        [uchain.optimum("corner", depth_m, relays).bottleneck_db for relays in (0, 1)],
    )


def test_an_optimum_that_there_is_not_is_refused_in_words():
    with pytest.raises(uchain.ScenarioError, match="apartment is no chain"):
        uchain.optimum("apartment")
    with pytest.raises(ValueError, match="head_depth_m = 99.*the tunnel ends"):
        uchain.optimum("straight", 99)
    with pytest.raises(ValueError, match="relays = -1: expected a whole number"):
        uchain.optimum("straight", relays=-1)


def test_places_batteries_budget_and_flights_are_those_of_the_command_line(cli: pathlib.Path, tmp_path: pathlib.Path):
    words = ["straight", "--to", "9", "--stay", "1.5", "--reserve", "0.1", "--budget", "crazyflie", "--fly", "2"]
    told, text, _ = plan_of(cli, tmp_path, *words)
    asked: dict[str, Any] = {"to_m": 9, "stay_min": 1.5, "reserve": 0.1, "budget": "crazyflie"}
    plan = uchain.plan("straight", fly=2, **asked)
    assert plan.summary.to_dict() == told and str(plan) == text[: text.index("files: ")]
    assert len(told["flown"]["runs"]) == 2 and told["budget"]["tx_dbm"] == 0
    keys = {"tx_dbm": 0, "sensitivity_dbm": -85, "margin_db": 20}
    assert uchain.plan("straight", **{**asked, "budget": keys}).summary["budget"] == told["budget"]
    relays = uchain.plan("straight", to_m=12).places
    np.testing.assert_allclose(relays["depth_m"], [8, 4], atol=0.01)
    np.testing.assert_allclose(relays["margin_db"], 60 - 59.08, atol=0.02)
    for wrong, words in [({"stay_min": -1}, "expected minutes"), ({"reserve": 1}, "expected a share")]:
        with pytest.raises(ValueError, match=words):
            uchain.plan("straight", **wrong)
    with pytest.raises(ValueError, match="unknown field `gain`"):
        uchain.plan("straight", budget={"gain": 2.0})
