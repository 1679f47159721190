"""Time is scrubbed, UAVs are asked why."""

import pathlib
from typing import Any

import pytest

SHOWN = "() => JSON.stringify(app.panes[0].frame.uavs.map((uav) => [uav.x_m, uav.y_m, uav.heading_rad]))"
FLOWN = """async (name, tick) => {
    const engine = await Engine.start();
    const { text } = engine.do("text", { name });
    engine.do("open", { flight: { kind: "scenario", label: name, text, seed: 1 } });
    while (engine.do("advance", { ticks: tick }).tick < tick);
    const frame = engine.do("frame", { tick });
    return JSON.stringify(frame.uavs.map((uav) => [uav.x_m, uav.y_m, uav.heading_rad]));
}"""


def choose(view: Any, page_file: pathlib.Path, name: str) -> Any:
    page = view.open(page_file)
    page.locator("#scenario").select_option(name)
    page.wait_for_function("name => window.uchain.panes[0].scene.label === `${name}.toml`", arg=name)
    page.evaluate("window.uchain.pause()")
    return page


def test_the_time_line_goes_anywhere_and_back_and_shows_what_was_there(view: Any, page_file: pathlib.Path) -> None:
    page = choose(view, page_file, "corner")
    shown = {}
    for tick in [1200, 400, 2000, 37, 1200]:
        page.locator("#scrub").fill(str(tick))
        view.settle(tick)
        now = view.ask(SHOWN)
        assert now == view.ask(FLOWN, "corner", tick), tick
        assert shown.setdefault(tick, now) == now
    assert len(set(shown.values())) == 4, "the control: nothing moved"


def test_keys_step_jump_and_play(view: Any, page_file: pathlib.Path) -> None:
    page = choose(view, page_file, "corner")
    page.locator("#scrub").fill("100")
    view.settle(100)
    page.locator("#stage").focus()
    for key, tick in [(".", 101), (",", 100), ("ArrowRight", 120), ("ArrowLeft", 100), ("End", 2400), ("Home", 0)]:
        page.keyboard.press(key)
        view.settle(tick)
    page.keyboard.press("Space")
    page.wait_for_function("window.uchain.playing && window.uchain.cursor > 5")
    page.keyboard.press("?")
    assert page.get_by_role("dialog", name="List of keys").is_visible()


@pytest.mark.parametrize("way", ["click", "digit"])
def test_a_uav_says_why_it_does_what_it_does(view: Any, page_file: pathlib.Path, way: str) -> None:
    page = choose(view, page_file, "corner")
    page.locator("#scrub").fill("900")
    view.settle(900)
    assert page.locator("#why").is_hidden()
    if way == "click":
        place = page.evaluate(
            """async () => {
                const { views } = await import("uchain/draw/stage.js");
                const uav = window.uchain.panes[0].frame.uavs[1];
                return { x: views[0].map.view.px(uav.x_m), y: views[0].map.view.py(uav.y_m) };
            }"""
        )
        page.locator("canvas[data-map='0']").click(position=place)
    else:
        page.locator("#stage").focus()
        page.keyboard.press("1")
    page.locator("#why").wait_for(state="visible")
    page.locator("#why .why-first").wait_for()
    words = view.ask("() => app.panes[0].engine.do('why', { tick: 900, uav: 1 }).words")
    told = page.locator("#why").inner_text()
    assert words and all(sentence in told for sentence in words), told
    assert "UAV 1" in told
    # What is told follows the cursor.
    page.locator("#scrub").fill("2300")
    view.settle(2300)
    later = view.ask("() => app.panes[0].engine.do('why', { tick: 2300, uav: 1 }).words")
    assert later != words, "the control: nothing has changed"
    page.wait_for_function("words => document.querySelector('#why').innerText.includes(words)", arg=later[0])


def test_an_exploration_shows_its_robots_and_its_graph(view: Any, page_file: pathlib.Path) -> None:
    page = choose(view, page_file, "apartment")
    page.locator("#scrub").fill("2000")
    view.settle(2000)
    counts = view.ask("() => ({ robots: app.panes[0].frame.robots.length, nodes: app.panes[0].graph.nodes.length })")
    assert counts["robots"] == 3 and counts["nodes"] > 10, counts
    page.keyboard.press("0")
    page.locator("#why").wait_for(state="visible")
