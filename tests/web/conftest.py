"""The page in a real browser, opened from disk as anybody opens it: any error in its console fails the test."""

import json
import os
import pathlib
import shutil
import subprocess
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, sync_playwright

ROOT = pathlib.Path(__file__).parents[2]
BROWSERS = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"]
# A machine that does other things besides is slow; nothing here measures.
PATIENCE_MS = 60_000
# A page in a file asks nobody for anything.
OWN_SCHEMES = ("file:", "data:", "blob:")


def setting(name: str) -> pathlib.Path:
    """A path that the gate hands over."""
    path = os.environ.get(name)
    if path is None:
        pytest.fail(f"{name} is expected to be set; `cargo xtask test web` does so")
    return pathlib.Path(path)


@pytest.fixture(scope="session")
def page_file() -> pathlib.Path:
    """The page that `cargo xtask web` built."""
    return setting("UCHAIN_PAGE")


@pytest.fixture(scope="session")
def cli() -> Callable[..., subprocess.CompletedProcess[str]]:
    """The command `uchain` of the same sources; it has to end well, or with the code that is expected."""
    program = setting("UCHAIN_CLI")

    def call(*words: Any, code: int = 0, folder: pathlib.Path | None = None) -> subprocess.CompletedProcess[str]:
        done = subprocess.run(
            [program, *map(str, words)], capture_output=True, text=True, cwd=folder, timeout=300, check=False
        )
        assert done.returncode == code, f"uchain {words} ended with {done.returncode}:\n{done.stdout}{done.stderr}"
        return done

    return call


@pytest.fixture(scope="session")
def digest_of(
    cli: Callable[..., subprocess.CompletedProcess[str]], tmp_path_factory: pytest.TempPathFactory
) -> Callable[..., str]:
    """The digest of a flight on this computer, without any browser."""

    def fly(scenario: str, seed: int, *more: str) -> str:
        out = tmp_path_factory.mktemp("run")
        done = cli("run", scenario, "--json", "--no-record", "--seed", seed, "--out", out, *more)
        return json.loads(done.stdout)["digest"]

    return fly


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """The system's browser, without a screen."""
    program = os.environ.get("UCHAIN_BROWSER") or next(filter(None, map(shutil.which, BROWSERS)), None)
    if program is None:
        pytest.fail("no browser: apt-get install chromium, or name one in UCHAIN_BROWSER")
    options = ["--disable-dev-shm-usage"]
    if os.geteuid() == 0:
        # Chromium's sandbox refuses to be set up by root, as whom many a CI runs.
        options.append("--no-sandbox")
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=program, args=options)
        yield started
        started.close()


class View:
    """The page in a tab of its own."""

    def __init__(self, browser: Browser, **context: Any):
        self.context = browser.new_context(accept_downloads=True, reduced_motion="reduce", **context)
        self.context.set_default_timeout(PATIENCE_MS)
        self.page = self.context.new_page()
        self.faults: list[str] = []
        self.page.on("pageerror", lambda error: self.faults.append(f"{error.message}\n{error.stack}"))
        self.page.on("console", self._heard)
        self.page.on("crash", lambda _: self.faults.append("the tab crashed"))
        self.page.on("request", self._asked)

    def _heard(self, message: Any) -> None:
        if message.type == "error":
            self.faults.append(f"console: {message.text}")

    def _asked(self, request: Any) -> None:
        if not request.url.startswith(OWN_SCHEMES):
            self.faults.append(f"the page asked {request.url}")

    def open(self, file: pathlib.Path, end: str = "") -> Page:
        """Opens a page from disk and waits for a flight to be shown; movement is reduced, so that it does not play."""
        self.page.goto(file.resolve().as_uri() + end)
        self.page.wait_for_function("window.uchain?.panes[0]?.frame")
        # Over the stage stands what a newcomer reads.
        self.page.evaluate("document.getElementById('welcome')?.remove()")
        return self.page

    def ask(self, script: str, *arguments: Any) -> Any:
        """Runs a function in the page; `app` is what the page is about, `Engine` the engine's class."""
        return self.page.evaluate(
            "async ([script, ...rest]) => {"
            "  const { Engine } = await import('uchain/engine.js');"
            "  return await new Function('app', 'Engine', `return (${script})`)(window.uchain, Engine)(...rest);"
            "}",
            [script, *arguments],
        )

    def drop(self, *files: tuple[str, bytes]) -> None:
        """Chooses files as somebody does in the file dialog."""
        self.page.locator("#file-picker").set_input_files(
            [{"name": name, "mimeType": "application/octet-stream", "buffer": data} for name, data in files]
        )

    def said(self) -> list[str]:
        """The lines of error on the page."""
        return self.page.locator("#said .error").all_inner_texts()

    def settle(self, tick: int) -> None:
        """Waits until a tick is shown."""
        self.page.wait_for_function(
            # The first frame is that after the first tick.
            "tick => { const pane = window.uchain.panes[0];"
            " return window.uchain.cursor === tick && pane.frame.tick === Math.max(1, tick) && pane.frame.exact }",
            arg=tick,
        )

    def is_alive(self) -> None:
        """Another flight is chosen from the menu, and flies."""
        for dialog in self.page.locator("dialog[open]").all():
            dialog.press("Escape")
        self.page.evaluate("document.querySelector('#said').replaceChildren()")
        self.page.locator("#scenario").select_option("straight")
        self.page.wait_for_function("window.uchain.panes[0].scene.label === 'straight.toml'")
        self.page.wait_for_function("window.uchain.cursor > 20")
        assert self.said() == []
        self.page.evaluate("window.uchain.pause()")


@pytest.fixture
def make_view(browser: Browser, request: pytest.FixtureRequest) -> Iterator[Callable[..., View]]:
    """Makes tabs; at the end each leaves a screenshot, and none may have had an error."""
    views: list[View] = []

    def make(**context: Any) -> View:
        views.append(View(browser, **context))
        return views[-1]

    yield make
    folder = setting("UCHAIN_SCREENSHOTS")
    folder.mkdir(parents=True, exist_ok=True)
    for i, view in enumerate(views):
        name = "".join(c if c.isalnum() else "-" for c in request.node.name) + (f"-{i}" if i else "")
        # A page whose script never ends leaves no picture.
        view.page.screenshot(path=folder / f"{name}.png", timeout=PATIENCE_MS)
        view.context.close()
    assert [view.faults for view in views if view.faults] == []


@pytest.fixture
def view(make_view: Callable[..., View]) -> View:
    """One tab."""
    return make_view(viewport={"width": 1400, "height": 900})
