"""In the browser a flight has the bits that it has here: every compiled-in scenario, three seeds each."""

import pathlib
from collections.abc import Callable
from typing import Any

import pytest

# The compiled-in scenarios that need no map file; another one is noticed.
SCENARIOS = [
    "apartment",
    "bend",
    "circuit",
    "circuit-cavemod",
    "circuit-frontiers2021",
    "corner",
    "corridors",
    "lab",
    "staircase",
    "straight",
]
SEEDS = [1, 2, 3]

FLY = """async (name, seeds, sets) => {
    const digests = [];
    for (const seed of seeds) {
        const engine = await Engine.start();
        let { text } = engine.do("text", { name });
        for (const [from, to] of sets) text = text.replace(from, to);
        engine.do("open", { flight: { kind: "scenario", label: `${name}.toml`, text, seed } });
        while (!engine.do("advance", { ticks: 20000 }).stopped);
        digests.push(engine.do("summary").digest);
    }
    return digests;
}"""


@pytest.fixture(scope="module")
def opened(browser: Any, page_file: pathlib.Path) -> Any:
    from conftest import View

    view = View(browser)
    view.open(page_file)
    yield view
    view.context.close()
    assert view.faults == []


def test_these_are_all_scenarios_that_fly(opened: Any) -> None:
    scenarios = opened.ask("async () => (await Engine.start()).do('about').scenarios")
    assert [one["name"] for one in scenarios if one["flies"]] == SCENARIOS
    assert [one["name"] for one in scenarios if not one["flies"]] == ["stata"]


@pytest.mark.parametrize("name", SCENARIOS)
def test_the_bits_are_those_of_the_command_line(opened: Any, digest_of: Callable[..., str], name: str) -> None:
    assert opened.ask(FLY, name, SEEDS, []) == [digest_of(name, seed) for seed in SEEDS]


def test_another_flight_has_another_digest(opened: Any, digest_of: Callable[..., str]) -> None:
    here = digest_of("corner", 1)
    assert opened.ask(FLY, "corner", [1], []) == [here]
    # The controls: another seed, another speed.
    assert opened.ask(FLY, "corner", [2], []) != [here]
    slower = opened.ask(FLY, "corner", [1], [["speed_mps = 0.2", "speed_mps = 0.19"]])
    assert slower != [here]
