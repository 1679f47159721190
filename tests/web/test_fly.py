"""Somebody flies the head by hand; what he leaves is flown again by the command line, bit for bit."""

import json
import pathlib
from collections.abc import Callable
from typing import Any

from playwright.sync_api import Page

HEAD = "() => app.panes[0].frame.head?.pilot_mps ?? 0"


def take_over(view: Any, page_file: pathlib.Path, name: str = "circuit") -> Page:
    page = view.open(page_file)
    page.locator("#scenario").select_option(name)
    page.wait_for_function("name => window.uchain.panes[0].scene.label === `${name}.toml`", arg=name)
    page.evaluate("window.uchain.pause(); window.uchain.seek(0)")
    page.keyboard.press("f")
    page.wait_for_function("window.uchain.mode === 'fly'")
    view.ask("() => { app.rate = 20 }")
    return page


def fly(view: Any, page_file: pathlib.Path, name: str = "circuit") -> Page:
    """Forward, right, a stop, back, and away again."""
    page = take_over(view, page_file, name)
    for key, count in [("ArrowUp", 6), ("ArrowRight", 1), (" ", 1), ("ArrowDown", 2), ("ArrowUp", 7)]:
        for _ in range(count):
            page.keyboard.press(key)
        page.wait_for_function("before => window.uchain.cursor > before + 120", arg=page.evaluate("window.uchain.cursor"))
    return page


def save(page: Page, words: str, into: pathlib.Path) -> pathlib.Path:
    page.locator("#save").click()
    with page.expect_download() as download:
        page.locator("[role=menuitem]").filter(has=page.get_by_text(words, exact=True)).click()
    file = into / download.value.suggested_filename
    download.value.save_as(file)
    return file


def to_its_end(view: Any) -> str:
    """The digest of the whole flight."""
    view.ask("() => { app.mode = 'watch'; app.pause(); app.seek(app.end) }")
    view.page.wait_for_function("window.uchain.panes[0].stopped")
    return view.ask("() => app.panes[0].engine.do('summary').digest")


def test_arrow_keys_move_the_head_and_space_stops_it(view: Any, page_file: pathlib.Path) -> None:
    page = take_over(view, page_file)
    reach = "window.uchain.panes[0].frame.head_reach_m"
    page.wait_for_function("window.uchain.cursor > 100")
    assert view.ask(HEAD) == 0, "the control: nobody has asked for anything"
    start_m = page.evaluate(reach)
    for _ in range(5):
        page.keyboard.press("ArrowUp")
    page.wait_for_function(f"{reach} > {start_m} + 0.5")
    assert view.ask(HEAD) > 0.05
    page.keyboard.press("Space")
    page.wait_for_function("window.uchain.panes[0].frame.head.pilot_mps === 0")
    page.keyboard.press("ArrowDown")
    page.wait_for_function("window.uchain.panes[0].frame.head.pilot_mps < 0")
    inputs = view.ask("() => app.panes[0].engine.do('inputs')")
    assert len(inputs) >= 4 and [one["tick"] for one in inputs] == sorted(one["tick"] for one in inputs)


def test_a_branch_is_chosen_with_the_arrow_keys(view: Any, page_file: pathlib.Path) -> None:
    page = take_over(view, page_file)
    page.keyboard.press("ArrowUp")
    for key, follow in [("ArrowLeft", "left"), ("ArrowRight", "centre"), ("ArrowRight", "right")]:
        page.wait_for_function("before => window.uchain.cursor > before + 5", arg=page.evaluate("window.uchain.cursor"))
        page.keyboard.press(key)
        page.wait_for_function(
            "follow => window.uchain.panes[0].engine.do('inputs').at(-1)?.follow === follow", arg=follow
        )


def test_a_flight_by_hand_is_verified_by_the_command_line(
    view: Any, page_file: pathlib.Path, cli: Callable[..., Any], tmp_path: pathlib.Path
) -> None:
    page = fly(view, page_file)
    inputs = view.ask("() => app.panes[0].engine.do('inputs')")
    assert len(inputs) > 5
    digest = to_its_end(view)
    assert digest != view.ask(
        "async () => { const e = await Engine.start(); e.do('open', { flight: { ...app.panes[0].engine.do('flight'),"
        " inputs: [] } }); while (!e.do('advance', { ticks: 20000 }).stopped); return e.do('summary').digest }"
    ), "the control: the inputs made no difference"
    recording = save(page, "Recording", tmp_path)
    said = cli("verify", recording).stdout
    assert "are the same, bit for bit" in said, said
    assert json.loads(cli("inspect", recording, "--json").stdout)["digest"] == digest
    # The control: one byte of it is another one.
    data = bytearray(recording.read_bytes())
    data[len(data) // 2] ^= 1
    recording.write_bytes(data)
    cli("verify", recording, code=3)


def test_a_flight_by_hand_is_a_scenario(
    view: Any, page_file: pathlib.Path, digest_of: Callable[..., str], tmp_path: pathlib.Path
) -> None:
    page = fly(view, page_file, "corner")
    digest = to_its_end(view)
    scenario = save(page, "Scenario with your inputs", tmp_path)
    assert "[[pilot]]" in scenario.read_text()
    assert digest_of(str(scenario), 1) == digest
    assert digest_of("corner", 1) != digest, "the control"


def test_a_shared_flight_is_the_same_flight(make_view: Any, page_file: pathlib.Path, tmp_path: pathlib.Path) -> None:
    view = make_view()
    page = fly(view, page_file)
    digest = to_its_end(view)
    page.locator("#share").click()
    link = page.get_by_label("link to this flight").input_value()
    page.keyboard.press("Escape")
    file = save(page, "Flight", tmp_path)
    for way in ["link", "file"]:
        other = make_view()
        if way == "link":
            other.open(page_file, "#" + link.split("#")[1])
        else:
            other.open(page_file)
            other.drop((file.name, file.read_bytes()))
            other.page.wait_for_function("window.uchain.panes[0].flight.inputs?.length > 5")
        assert to_its_end(other) == digest, way


def test_a_scenario_is_flown_again_with_the_same_inputs_and_another_key(view: Any, page_file: pathlib.Path) -> None:
    page = fly(view, page_file, "corner")
    before = view.ask("() => app.panes[0].engine.do('inputs')")
    digest = to_its_end(view)
    page.locator("#tab-edit").click()
    text = page.locator("#edit textarea")
    text.fill(text.input_value().replace("width_m = 1.0", "width_m = 1.05"))
    page.get_by_role("button", name="Fly this text").click()
    page.wait_for_function("window.uchain.panes[0].scene.text.includes('width_m = 1.05')")
    assert to_its_end(view) != digest
    assert view.ask("() => app.panes[0].engine.do('inputs')") == before
