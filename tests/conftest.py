"""Settings and fixtures of the test suite, among them the browser that opens pages."""

import functools
import http.server
import os
import shutil
import signal
import subprocess
import sys
import threading
from pathlib import Path

import matplotlib
import pytest
from hypothesis import settings
from matplotlib import pyplot as plt
from saved_files import share_compiled

# No deadline: a kernel compiles on its first call. Derandomised: a test that fails here fails everywhere.
settings.register_profile("neorl", deadline=None, derandomize=True)
settings.load_profile("neorl")
matplotlib.use("agg")
# Interpreters that tests start find the pages' modules, as the kernels of notebooks do, and the tests'.
ROOT = Path(__file__).parents[1]
os.environ["PYTHONPATH"] = os.pathsep.join([*map(str, (ROOT / "notebooks", ROOT / "tests")),
                                            *filter(None, [os.environ.get("PYTHONPATH")])])

# The shell has no window, which costs the others a second a page.
BROWSERS = ["chromium-headless-shell", "chromium", "chromium-browser", "google-chrome", "google-chrome-stable"]
QUIET = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync"]  # no requests of its own
PATIENCE = 60_000  # milliseconds that a test waits for a page, since the machine may be busy

# The files that take longest, lest one is left when all other workers have finished; those that open pages come later.
FIRST = ("test_make", "test_sweeping", "test_compiling", "test_variations", "test_chapter_4", "test_other_spaces",
         "test_store", "test_staleness", "test_fuzzing", "test_fuzzed_kernels", "test_record", "test_star",
         "test_engine", "test_jupyterlab", "test_explorer_tries", "test_explorer_page", "test_explorer_loads",
         "test_exactness", "test_explorer_shown", "test_calibration", "test_saved_code", "test_book", "test_readme")


# The kernels of nearly all tests, and the modules of those that open pages.
KERNELS = """from neorl import WaterWorld, forager, multimodal, network_d, place_cells, simulate
for agent in (place_cells([3]), multimodal([3]), network_d([3]), forager([3])):
    simulate(agent, WaterWorld(), steps=2, runs=1, progress=False)"""
MODULES = "from neorl.browser import wasm; wasm.modules()"


def pytest_configure(config):
    """Compile kernels once for all workers, while these collect the tests: each would compile the same ones."""
    if config.getoption("numprocesses", None):
        config.compiling = [subprocess.Popen([sys.executable, "-c", KERNELS])]


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_node_collection_finished(node, ids):
    """Let no test begin before that. Modules are built beside the first tests."""
    compiling = node.config.compiling
    if compiling[0].wait() == 0 and len(compiling) == 1 and any("browser" in each for each in ids):
        compiling.append(subprocess.Popen([sys.executable, "-c", MODULES]))


def pytest_unconfigure(config):
    for process in getattr(config, "compiling", ()):
        process.terminate()
        process.wait()


def pytest_collection_modifyitems(items):
    items.sort(key=lambda item: FIRST.index(item.path.stem) if item.path.stem in FIRST else len(FIRST))


@pytest.fixture(autouse=True)
def closed():
    """Close all figures after each test, and undo what it has set of matplotlib."""
    with plt.rc_context():
        yield
    plt.close("all")


@pytest.fixture
def cache_folder(tmp_path, monkeypatch):
    """An empty cache folder in place of the user's, with which it shares only what is compiled."""
    share_compiled(tmp_path)
    monkeypatch.setenv("NEORL_CACHE", str(tmp_path))
    return tmp_path


@pytest.fixture
def interruptible():
    """Make Ctrl-C raise KeyboardInterrupt, since a process started in the background may ignore it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def mount():
    """Mount a disk in memory at a folder for the duration of a test: mount(folder, options) returns the folder."""
    mounted = []

    def mount(folder, options):
        folder.mkdir(exist_ok=True)
        if subprocess.run(["mount", "-t", "tmpfs", "-o", options, "none", folder], capture_output=True).returncode:
            pytest.skip("no permission to mount a disk")
        mounted.append(folder)
        return folder

    if sys.platform != "linux" or not shutil.which("mount"):
        pytest.skip("needs the mount command of Linux")
    yield mount
    for folder in mounted:
        subprocess.run(["umount", folder], check=True)


@pytest.fixture(scope="session")
def chromium():
    """The Chromium of this machine, or else the one installed by Playwright."""
    api = pytest.importorskip("playwright.sync_api")
    api.expect.set_options(timeout=PATIENCE)
    found = next(filter(None, map(shutil.which, BROWSERS)), None)
    with api.sync_playwright() as playwright:
        try:
            browser = playwright.chromium.launch(executable_path=found, args=QUIET)
        except api.Error:
            if found:
                raise
            pytest.skip("no Chromium: install it, or run playwright install chromium")
        yield browser
        browser.close()


@pytest.fixture
def open_page(chromium):
    """Open a page of a folder. By the end of the test it must have no errors, warnings or requests to other origins.

    `open_page(folder, path, over="http" or "file")` returns Playwright's page; `**options` are those of its context.
    A test that expects an error removes it from `open_page.complaints`.
    """
    yield from opened(chromium)


@pytest.fixture(scope="module")
def open_shared_page(chromium):
    """As `open_page`, for a page that all tests of a module share."""
    yield from opened(chromium)


def opened(chromium):
    servers, contexts, complaints = [], [], []

    def open_page(folder, path, over="http", **options):
        if over == "http":
            servers.append(serve(folder))
            origin = f"http://127.0.0.1:{servers[-1].server_port}/"
        else:
            origin = f"{folder.as_uri()}/"

        def check(request):
            if not request.url.startswith((origin, "blob:", "data:")):
                complaints.append(f"request to {request.url}")

        context = chromium.new_context(**options)
        context.set_default_timeout(PATIENCE)
        contexts.append(context)
        context.on("request", check)
        context.on("weberror", lambda uncaught: complaints.append(f"uncaught {uncaught.error}"))
        context.on("console", lambda message: message.type in ("error", "warning") and complaints.append(
            f"console {message.type}: {message.text} ({message.location})"))
        page = context.new_page()
        page.goto(origin + path)
        return page

    open_page.complaints = complaints
    yield open_page
    for context in contexts:
        context.close()
    for server in servers:
        server.shutdown()
        server.server_close()
    assert not complaints


class QuietHandler(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


def serve(folder):
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(QuietHandler, directory=folder))
    threading.Thread(target=server.serve_forever, args=(0.05,), daemon=True).start()
    return server
