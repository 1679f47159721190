"""A module of a user's own in Rust: the whole of uchain, and a law of hers as a word in scenarios."""

import pickle

import pytest
from conftest import optional

import uchain

own_law = optional("own_law")
HALF = {"chain.brain": "half", "duration_s": 60}


def test_her_module_has_all_that_uchain_has():
    missing = [name for name in uchain.__all__ if not hasattr(own_law, name) and name != "__version__"]
    assert not missing


def test_her_law_is_a_word_in_scenarios_and_flies_otherwise():
    corner = own_law.Scenario.from_name("corner").with_(duration_s=60)
    node, half = own_law.run(corner, 1), own_law.run(corner.with_(**HALF), 1)
    assert node.digest == uchain.run(uchain.Scenario.from_name("corner").with_(duration_s=60), 1).digest
    assert half.digest != node.digest
    with pytest.raises(uchain.ScenarioError, match="chain.brain"):
        uchain.Scenario.from_name("corner").with_(**HALF)
    with pytest.raises(own_law.ScenarioError, match="did you mean 'half'"):
        corner.with_(**{"chain.brain": "hlf"})


def test_her_law_is_swept_beside_the_built_in_one():
    table = own_law.sweep(
        own_law.Scenario.from_name("corner").with_(duration_s=60),
        vary={"chain.brain": ["node", "half"]},
        replicates=3,
        progress=False,
    )
    assert list(table["chain.brain"]) == ["node"] * 3 + ["half"] * 3
    assert len(set(table["digest"])) == 6


def test_what_is_hers_is_pickled_as_hers():
    scenario = pickle.loads(pickle.dumps(own_law.Scenario.from_name("corner").with_(**HALF)))
    assert type(scenario) is own_law.Scenario and type(scenario) is not uchain.Scenario
    assert scenario.overrides["chain.brain"] == '"half"'


def test_her_command_line_knows_her_word(capfd: pytest.CaptureFixture[str]):
    assert own_law.main(["check", "corner", "--set", "chain.brain=half"]) == 0
    assert uchain.main(["check", "corner", "--set", "chain.brain=half"]) != 0
    assert "half" in capfd.readouterr().err
