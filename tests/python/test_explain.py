"""What keys mean: the cards of the command line, as objects."""

import json
import pathlib
import pickle
import subprocess

import pytest

import uchain


def test_a_card_is_that_of_the_command_line(cli: pathlib.Path):
    for name in ["sigma_db", "pilot.0.speed_mps", "equalize.law", "chain.base_m", "explore.strategy", "name"]:
        told = subprocess.run([cli, "explain", name], check=True, capture_output=True, text=True).stdout
        [key] = uchain.explain(name)
        assert str(key) == told


def test_a_key_says_what_it_may_be_and_where_it_comes_from():
    [alpha] = uchain.explain("alpha_wall")
    assert (alpha.key, alpha.default, alpha.kind, alpha.is_table) == ("radio.alpha_wall", "6", "number", False)
    assert alpha.range is not None and alpha.range[0] <= 6 <= alpha.range[1]
    assert alpha.source is not None and "Laclau 2021" in alpha.source
    [law] = uchain.explain("equalize.law")
    assert law.kind == "word" and "lipschitz" in law.choices and law.unit is None
    [speed] = uchain.explain("radio.sigma_db=3")
    assert speed.key == "radio.sigma_db" and speed.unit == "dB"


def test_a_table_comes_with_its_keys_and_nothing_asks_for_all():
    radio = uchain.explain("[radio]")
    assert radio[0].is_table and all(key.key.startswith("radio.") for key in radio[1:])
    every = uchain.explain()
    assert set(radio) < set(every) and len({key.key for key in every}) == len(every) > 100
    assert all(pickle.loads(pickle.dumps(key)) == key for key in every[:40])


def test_a_slip_of_the_finger_is_answered_with_the_nearest_name():
    with pytest.raises(uchain.ScenarioError, match="radio.sigma_db"):
        uchain.explain("radio.sigma_d")
    with pytest.raises(uchain.ScenarioError, match="equalize.law, center.law"):
        uchain.explain("law")


def test_the_schema_is_that_of_the_command_line(cli: pathlib.Path):
    told = subprocess.run([cli, "schema"], check=True, capture_output=True, text=True).stdout
    assert uchain.schema() == json.loads(told)
