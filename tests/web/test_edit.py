"""The scenario as text: its errors stand at their line, and what is flown goes on until it is right."""

import pathlib
from typing import Any

import pytest


def edit(view: Any, page_file: pathlib.Path) -> Any:
    page = view.open(page_file)
    page.locator("#scenario").select_option("corner")
    page.wait_for_function("window.uchain.panes[0].scene.label === 'corner.toml'")
    page.evaluate("window.uchain.pause()")
    page.locator("#tab-edit").click()
    return page


@pytest.mark.parametrize(
    ("written", "instead", "words"),
    [
        ("width_m = 1.0", "width_m = -1.0", "width_m"),
        ("uavs = 4", "uavz = 4", "uavs"),
        ("uavs = 4", "uavs = four", ""),
        ('name = "corner"', 'name = "corner', ""),
        ("speed_mps = 0.2", "speed_mps = 1e99", "speed_mps"),
    ],
)
def test_a_mistake_is_shown_at_its_line(
    view: Any, page_file: pathlib.Path, written: str, instead: str, words: str
) -> None:
    page = edit(view, page_file)
    text = page.locator("#edit textarea")
    right = text.input_value()
    line = right[: right.index(written)].count("\n") + 1
    wrong = right.replace(written, instead, 1)
    text.fill(wrong)
    verdict = page.locator("#edit-verdict.error")
    verdict.wait_for()
    said = verdict.inner_text()
    assert f"Line {line}:" in said and words in said, said
    page.get_by_role("button", name="Fly this text").click()
    assert verdict.inner_text() == said
    assert page.evaluate("window.uchain.panes[0].scene.text") == right, "what is flown goes on"
    text.fill(right)
    page.locator("#edit-verdict.ok").wait_for()
    view.is_alive()


def test_a_text_that_is_right_is_flown(view: Any, page_file: pathlib.Path) -> None:
    page = edit(view, page_file)
    text = page.locator("#edit textarea")
    text.fill(text.input_value().replace("uavs = 4", "uavs = 2"))
    page.locator("#edit-verdict.ok").wait_for()
    text.press("Control+Enter")
    page.wait_for_function("window.uchain.panes[0].crew === 2")


def test_a_key_at_the_caret_is_explained(view: Any, page_file: pathlib.Path) -> None:
    page = edit(view, page_file)
    text = page.locator("#edit textarea")
    text.evaluate("area => { const at = area.value.indexOf('width_m'); area.focus(); area.setSelectionRange(at, at) }")
    page.keyboard.press("ArrowRight")
    page.locator("#edit").get_by_text("map.corridor.width_m").first.wait_for()
