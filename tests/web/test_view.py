"""`uchain view`: what is put into a page flies in it as it does here."""

import json
import os
import pathlib
from collections.abc import Callable
from typing import Any

import pytest

ROOT = pathlib.Path(__file__).parents[2]
END = """async () => {
    app.pause();
    const { engine } = app.panes[0];
    while (!engine.do("advance", { ticks: 20000 }).stopped);
    return engine.do("summary").digest;
}"""


def put(cli: Callable[..., Any], folder: pathlib.Path, *words: Any) -> pathlib.Path:
    """The page that the command writes."""
    return folder / cli("view", "--no-open", *words, folder=folder).stdout.strip()


def test_a_scenario(view: Any, cli: Callable[..., Any], digest_of: Callable[..., str], tmp_path: pathlib.Path) -> None:
    view.open(put(cli, tmp_path, "corner", "--seed", 3, "--set", "chain.uavs=3"))
    assert view.ask("() => [app.panes[0].scene.label, app.panes[0].scene.seed, app.panes[0].crew]") == ["corner.toml", 3, 3]
    assert view.ask(END) == digest_of("corner", 3, "--set", "chain.uavs=3") != digest_of("corner", 3)


def test_a_file_with_letters_of_all_kinds(
    view: Any, cli: Callable[..., Any], digest_of: Callable[..., str], tmp_path: pathlib.Path
) -> None:
    text = cli("show", "bend").stdout + "\n# </script><!-- --><script>throw 1</script> \u2028 \u00e9\u4e2d\U0001f681\n"
    (tmp_path / "höhle.toml").write_text(text)
    view.open(put(cli, tmp_path, "höhle.toml"))
    assert view.ask("() => app.panes[0].scene.text") == text
    assert view.ask(END) == digest_of(str(tmp_path / "höhle.toml"), 1)


def test_a_map(view: Any, cli: Callable[..., Any], digest_of: Callable[..., str], tmp_path: pathlib.Path) -> None:
    from test_damage import YAML, room

    (tmp_path / "floor.yaml").write_bytes(YAML)
    (tmp_path / "floor.pgm").write_bytes(room(90, 60))
    view.open(put(cli, tmp_path, "floor.yaml"))
    assert view.ask("() => app.panes[0].scene.mission") == "exploration"
    assert view.ask(END) == digest_of(str(tmp_path / "floor.yaml"), 1)


def test_a_recording_to_look_at_and_to_go_on_with(view: Any, cli: Callable[..., Any], tmp_path: pathlib.Path) -> None:
    summary = json.loads(cli("run", "circuit", "--json", "--out", tmp_path / "r").stdout)
    page = view.open(put(cli, tmp_path, "r"))
    assert view.ask("() => [app.panes[0].scene.recorded, app.panes[0].scene.flies_again]") == [True, True]
    page.evaluate("window.uchain.seek(1000)")
    view.settle(1000)
    assert view.ask(END) == summary["digest"]
    page.evaluate("window.uchain.seek(600)")
    view.settle(600)
    page.keyboard.press("f")
    page.wait_for_function("window.uchain.mode === 'fly'")
    page.keyboard.press("ArrowUp")
    page.wait_for_function("window.uchain.panes[0].engine.do('inputs').length > 0")


def test_a_row_of_a_sweep(view: Any, cli: Callable[..., Any], tmp_path: pathlib.Path) -> None:
    cli("sweep", "corner", "--vary", "radio.sigma_db=0,4", "--replicates", 2, "--quiet", "--out", tmp_path / "s")
    digest = json.loads(cli("repro", "s", "--run", 3, "--json", folder=tmp_path).stdout)["digest"]
    view.open(put(cli, tmp_path, "s", "--run", 3))
    assert view.ask(END) == digest


def test_the_page_alone(view: Any, cli: Callable[..., Any], tmp_path: pathlib.Path, page_file: pathlib.Path) -> None:
    page = put(cli, tmp_path)
    assert page.read_bytes() == page_file.read_bytes()
    view.open(page)


def test_a_real_building(view: Any, cli: Callable[..., Any], digest_of: Callable[..., str], tmp_path: pathlib.Path) -> None:
    if not (ROOT / "../shared/data").is_dir():
        missing = "the map of stata is not beside the project"
        pytest.fail(missing) if os.environ.get("CI") == "true" else pytest.skip(missing)
    page = tmp_path / "stata.html"
    cli("view", "stata", "--no-open", "--out", page, "--set", "duration_s=120", folder=ROOT)
    view.open(page)
    assert view.ask("() => app.panes[0].scene.map.loops.length") > 1
    assert view.ask(END) == digest_of("stata", 1, "--set", "duration_s=120")
