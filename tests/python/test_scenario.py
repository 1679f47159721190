"""Scenarios: read, written over, refused in words, pickled."""

import pathlib
import pickle

import numpy as np
import pytest

import uchain


def test_a_scenario_that_comes_along_is_found_by_its_name():
    names = uchain.scenarios()
    assert {"corner", "straight", "lab"} <= set(names)
    for name in names:
        assert uchain.Scenario.from_name(name).name == name


def test_what_is_wrong_is_said_with_place_key_and_the_nearest_name():
    corner = uchain.Scenario.from_name("corner")
    with pytest.raises(uchain.ScenarioError, match=r"radio\.sigma=2.*unknown key.*did you mean 'sigma_db'"):
        corner.with_(**{"radio.sigma": 2})
    with pytest.raises(uchain.ScenarioError, match="did you mean 'corner'"):
        uchain.Scenario.from_name("crner")
    with pytest.raises(uchain.ScenarioError, match=r"<toml>:2"):
        uchain.Scenario.from_toml('name = "x"\nduration_s = = 3\n')


def test_a_file_is_read_and_its_relative_paths_start_where_it_lies(tmp_path: pathlib.Path):
    text = uchain.Scenario.from_name("straight").toml
    path = tmp_path / "mine.toml"
    path.write_text(text)
    assert uchain.Scenario.from_file(path).toml == text
    path.write_text(text.replace("duration_s", "duration_"))
    with pytest.raises(uchain.ScenarioError, match=r"mine\.toml:\d+"):
        uchain.Scenario.from_file(path)
    with pytest.raises(uchain.ScenarioError, match="absent"):
        uchain.Scenario.from_file(tmp_path / "absent.toml")


@pytest.mark.parametrize("value", [3, 3.0, np.float64(3), np.int32(3), np.array(3.0)])
def test_numbers_of_python_and_numpy_are_values(value: object):
    scenario = uchain.Scenario.from_name("corner").with_(**{"duration_s": 60, "radio.sigma_db": value})
    assert float(scenario.overrides["radio.sigma_db"]) == 3.0


def test_a_word_a_list_and_a_table_are_values():
    corner = uchain.Scenario.from_name("corner")
    assert corner.with_(preset="cavemod").overrides == {"preset": '"cavemod"'}
    script = [{"start_s": 0.0, "speed_mps": 0.1}, {"start_s": 9.0, "speed_mps": 0.0}]
    assert "0.1" in corner.with_(pilot=script).overrides["pilot"]


def test_a_value_that_toml_has_no_word_for_is_refused_with_its_key():
    corner = uchain.Scenario.from_name("corner")
    for value in [None, 1j, object(), {1: 2}]:
        with pytest.raises(TypeError, match="duration_s"):
            corner.with_(duration_s=value)
    endless: list[object] = []
    endless.append(endless)
    for value in [endless, 1 << 64]:
        with pytest.raises(ValueError, match="duration_s"):
            corner.with_(duration_s=value)
    for value in [float("nan"), float("inf"), -1, "long"]:
        with pytest.raises(uchain.ScenarioError, match="duration_s"):
            corner.with_(duration_s=value)


def test_what_is_written_later_holds():
    scenario = uchain.Scenario.from_name("corner").with_(duration_s=10).with_(duration_s=20)
    assert scenario.duration_s == 20
    assert scenario.overrides == {"duration_s": "20"}


def test_a_scenario_comes_out_of_a_pickle_as_it_went_in():
    scenario = uchain.Scenario.from_name("corner").with_(duration_s=10)
    again = pickle.loads(pickle.dumps(scenario))
    assert again == scenario and hash(again) == hash(scenario)
    assert again != uchain.Scenario.from_name("corner")


def test_walls_are_segments_in_metres():
    walls = uchain.Scenario.from_name("straight").walls_m
    assert walls.shape[1:] == (2, 2) and walls.dtype == np.float32
    assert np.isfinite(walls).all()
