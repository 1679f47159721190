"""Whatever is dropped on the page: an error in words, and the page flies on."""

import base64
import json
import pathlib
import random
import zlib
from collections.abc import Callable
from typing import Any

import pytest

MIB = 1 << 20
# Of every flight that reached the page: to its end, or up to where it fails.
TO_ITS_END = "() => { app.pause(); app.seek(app.end) }"
OVER = """
    (() => { const [pane] = window.uchain.panes; return pane.stopped && window.uchain.cursor >= pane.end || pane.broken })()
    || document.querySelector("#said .error")"""


@pytest.fixture(scope="module")
def recording(cli: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> bytes:
    folder = tmp_path_factory.mktemp("recording")
    cli("run", "corner", "--quiet", "--set", "duration_s=20", "--out", folder)
    return (folder / "run.mcap").read_bytes()


def refused(view: Any, *files: tuple[str, bytes]) -> str:
    """Drops files, looks for an error at once or in flight, and flies something else afterwards."""
    view.page.evaluate("document.querySelector('#said').replaceChildren(); window.uchain.pause()")
    view.drop(*files)
    view.page.wait_for_function("document.querySelector('#said .error')")
    said = "\n".join(view.said())
    # Words, no names of things in the program.
    assert "has a fault" not in said and "RuntimeError" not in said, said
    view.is_alive()
    return said


def test_recordings_with_a_bit_that_flipped(view: Any, page_file: pathlib.Path, recording: bytes) -> None:
    page = view.open(page_file)
    chance = random.Random(19)
    for place in [3, 60, *(chance.randrange(len(recording)) for _ in range(14))]:
        damaged = bytearray(recording)
        damaged[place] ^= 1 << chance.randrange(8)
        page.evaluate("document.querySelector('#said').replaceChildren()")
        before = page.evaluate("window.before = window.uchain.panes[0], null")
        assert before is None
        view.drop(("run.mcap", bytes(damaged)))
        page.wait_for_function("window.uchain.panes[0] !== window.before || document.querySelector('#said .error')")
        # Behind the last frame there is an index, which nobody reads who reads it all.
        view.ask(TO_ITS_END)
        page.wait_for_function(OVER)
        is_whole = view.ask("() => app.panes[0].scene.recorded === true && app.panes[0].tick === 400")
        assert view.said() or is_whole, f"byte {place} of {len(recording)}: neither an error nor the whole flight"
        assert "has a fault" not in "\n".join(view.said())
        view.is_alive()


def test_recordings_that_were_cut(view: Any, page_file: pathlib.Path, recording: bytes) -> None:
    page = view.open(page_file)
    for length in [0, 1, 8, 100, 5_000, len(recording) // 2, len(recording) - 1]:
        page.evaluate("document.querySelector('#said').replaceChildren(); window.before = window.uchain.panes[0]")
        view.drop(("run.mcap", recording[:length]))
        page.wait_for_function("window.uchain.panes[0] !== window.before || document.querySelector('#said .error')")
        if not view.said():
            # It is shown up to there.
            view.ask(TO_ITS_END)
            page.wait_for_function(OVER)
            assert view.ask("() => app.panes[0].scene.recorded && app.panes[0].tick <= 400"), length
        assert length > 100 or view.said(), f"{length} bytes are no recording"
        assert "has a fault" not in "\n".join(view.said())
        view.is_alive()
    # The control: whole, it is read to its end.
    view.drop(("run.mcap", recording))
    page.wait_for_function("window.uchain.panes[0].scene.recorded")
    view.ask(TO_ITS_END)
    page.wait_for_function("window.uchain.panes[0].stopped")
    assert view.ask("() => app.panes[0].tick") == 400 and view.said() == []


def test_files_that_are_too_large_or_something_else(view: Any, page_file: pathlib.Path, recording: bytes) -> None:
    page = view.open(page_file)
    # Files of 70 MB are not handed over one by one: the page makes them itself.
    for name in ["run.mcap", "huge.toml", "huge.uchain.json", "huge.png"]:
        page.evaluate("document.querySelector('#said').replaceChildren()")
        page.evaluate(
            """name => {
                const given = new DataTransfer();
                given.items.add(new File([new Uint8Array(70_000_000)], name));
                const picker = document.getElementById("file-picker");
                picker.files = given.files;
                picker.dispatchEvent(new Event("change"));
            }""",
            name,
        )
        page.wait_for_function("document.querySelector('#said .error')")
        assert "has a fault" not in "\n".join(view.said())
        view.is_alive()
    assert "picture.jpg" in refused(view, ("picture.jpg", b"\xff\xd8\xff"))
    refused(view, ("run.mcap", b"\0" * 100_000))
    refused(view, ("run.mcap", recording), ("more.mcap", recording))


def test_scenarios_that_are_none(view: Any, page_file: pathlib.Path) -> None:
    view.open(page_file)
    deep = b"a = " + b"[" * 100_000
    for text in [b"", b"\xff\xfe\x00bad", b"name = 1\n", deep, b"\0" * 1000, b"x" * (9 * MIB)]:
        refused(view, ("bad.toml", text))
    huge = b'name = "huge"\nduration_s = 86400.0\n[map.corridor]\ncentre_line_m = [[0.0, 0.0], [9.0, 0.0]]\nwidth_m = 1.0\n'
    refused(view, ("huge.toml", huge + b"[chain]\nuavs = 1000000000\nbase_m = [0.5, 0.0]\n"))


def test_a_scenario_with_a_map_that_the_page_cannot_read(view: Any, page_file: pathlib.Path) -> None:
    view.open(page_file)
    said = refused(view, ("mine.toml", b'name = "mine"\nduration_s = 5.0\n[map.ros]\nfile = "/etc/passwd"\n[explore]\n'))
    assert "map" in said


YAML = b"image: floor.pgm\nresolution: 0.1\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"


def room(width: int, height: int) -> bytes:
    rows = [
        bytes(0 if x in (0, width - 1) or y in (0, height - 1) else 254 for x in range(width)) for y in range(height)
    ]
    return f"P5\n{width} {height}\n255\n".encode() + b"".join(rows)


def test_maps_that_are_none(view: Any, page_file: pathlib.Path) -> None:
    page = view.open(page_file)
    picture = room(60, 40)
    for yaml, pgm in [
        (YAML, b""),
        (YAML, picture[: len(picture) // 2]),
        (YAML, b"P5\n1000000 1000000\n255\n"),
        (YAML, b"P5\n60 40\n255\n" + b"\0" * 2400),
        (b"image: floor.pgm\n", picture),
        (b"\xff", picture),
        (YAML.replace(b"0.1", b"-1.0"), picture),
    ]:
        refused(view, ("floor.yaml", yaml), ("floor.pgm", pgm))
    # The control: the same, whole, is explored.
    view.drop(("floor.yaml", YAML), ("floor.pgm", picture))
    page.wait_for_function("window.uchain.panes[0].scene.mission === 'exploration'")
    assert view.said() == []


def link(data: bytes) -> str:
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = packer.compress(data) + packer.flush()
    return "#flight=" + base64.urlsafe_b64encode(packed).decode().rstrip("=")


def flight(**more: Any) -> bytes:
    text = 'name = "x"\nduration_s = 5.0\n[map.corridor]\ncentre_line_m = [[0.0, 0.0], [9.0, 0.0]]\nwidth_m = 1.0\n'
    text += "[chain]\nuavs = 2\nbase_m = [0.5, 0.0]\n[[pilot]]\nstart_s = 0.0\nspeed_mps = 0.1\n"
    return json.dumps({"kind": "scenario", "label": "x.toml", "text": text, "seed": 1, **more}).encode()


LINKS = {
    "empty": "#flight=",
    "no base64": "#flight=%%%",
    "no deflate": "#flight=AAAA",
    "cut": link(flight())[:60],
    "no json": link(b"hello"),
    "no flight": link(b"[1, 2]"),
    "null": link(b"null"),
    "another kind": link(flight(kind="film")),
    "no text": link(flight(text=3)),
    "a seed of words": link(flight(seed="one")),
    "a seed that was rounded": link(flight(seed=2**60)),
    "inputs out of order": link(flight(inputs=[{"tick": 9, "speed_mps": 0.1, "follow": "centre"}] * 2)),
    "an input beyond all speed": link(flight(inputs=[{"tick": 1, "speed_mps": 1e30, "follow": "centre"}])),
    "inputs of another kind": link(flight(inputs="fast")),
    "walls that are none": link(flight(walls_csv="loop,x_m,y_m\n0,a,b\n", map_offset_m=[0, 0])),
    "a bomb": link(b"\0" * (40 * MIB)),
}


# In a file the bomb is nothing but a large text, and those are tested above.
WAYS = [(name, way) for name in LINKS for way in ["address", "file"] if (name, way) != ("a bomb", "file")]


@pytest.mark.parametrize(("name", "way"), WAYS)
def test_links_and_flights_that_are_damaged(view: Any, page_file: pathlib.Path, name: str, way: str) -> None:
    if way == "address":
        view.open(page_file, LINKS[name])
        view.page.wait_for_function("document.querySelector('#said .error')")
        view.is_alive()
        return
    view.open(page_file)
    code = LINKS[name].removeprefix("#flight=")
    try:
        data = zlib.decompress(base64.urlsafe_b64decode(code + "=" * (-len(code) % 4)), -15)
    except (ValueError, zlib.error):
        data = code.encode()
    refused(view, ("shared.uchain.json", data))


def test_a_sound_link_opens(view: Any, page_file: pathlib.Path) -> None:
    page = view.open(page_file, link(flight(seed="18446744073709551615")))
    assert view.said() == []
    assert page.evaluate("[app.scene.name, app.scene.seed]".replace("app", "window.uchain.panes[0]")) == ["x", "18446744073709551615"]
