"""The page opens from disk, alone, and shows a flight; on a phone and in the dark as well."""

import pathlib
from typing import Any

import pytest

# Far more than it takes (0.3 to 1 s); a busy machine is no reason to fail.
FIRST_FRAME_MS = 15_000


def test_it_opens_from_disk_and_shows_a_flight_at_once(view: Any, page_file: pathlib.Path) -> None:
    page = view.open(page_file)
    taken_ms = page.evaluate("performance.now()")
    print(f"a frame is there {taken_ms:.0f} ms after the page was asked for")
    assert taken_ms < FIRST_FRAME_MS
    assert page.title().endswith("uchain")
    assert view.said() == []
    # Something is drawn: many colours, not one.
    colours = page.evaluate(
        """() => {
            const canvas = document.querySelector("canvas[data-map='0']");
            const dots = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
            return new Set(new Uint32Array(dots.buffer)).size;
        }"""
    )
    assert colours > 20


def test_it_plays_and_stops(view: Any, page_file: pathlib.Path) -> None:
    page = view.open(page_file)
    page.locator("#play").click()
    page.wait_for_function("window.uchain.cursor > 40")
    page.locator("#play").click()
    assert page.evaluate("window.uchain.playing") is False


def test_an_error_in_its_script_would_be_noticed(make_view: Any, page_file: pathlib.Path) -> None:
    view = make_view()
    page = view.open(page_file)
    page.evaluate("setTimeout(() => { throw new Error('planted') })")
    page.evaluate("console.error('planted, too'); fetch('http://127.0.0.1:9/').catch(() => {})")
    page.wait_for_timeout(500)
    found = "\n".join(view.faults)
    view.faults.clear()
    assert "planted\n" in found and "planted, too" in found and "asked http://127.0.0.1:9/" in found


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1400])
def test_it_fits_a_phone_and_a_screen(make_view: Any, page_file: pathlib.Path, width: int, scheme: str) -> None:
    view = make_view(viewport={"width": width, "height": 844}, color_scheme=scheme)
    page = view.open(page_file)
    view.ask("app.seek(2000)".join(["() => { ", " }"]))
    view.settle(2000)
    assert page.evaluate("document.documentElement.scrollWidth <= window.innerWidth"), "it scrolls sideways"
    ground = page.evaluate("getComputedStyle(document.body).backgroundColor")
    light = sum(int(part) for part in ground.removeprefix("rgb(").removesuffix(")").split(",")[:3]) > 3 * 128
    assert light == (scheme == "light"), ground
