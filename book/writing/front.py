"""The living part of the front page: the star (`star.py`), the game below it (`game.py`), and what runs them."""

import gzip
import json
from base64 import b64encode
from pathlib import Path

import neorl
from neorl.browser import wasm
from neorl.browser.explorer import text_of
from writing import game, star

SCRIPTS = ("simulator.js", "drawing.js", "movers.js", "settings.js")
OURS = ("star.js", "game.js")
BOOK = Path(__file__).parents[1]


def page(lesson=star.LESSON):
    """The star and the game as HTML: styles, markup, the kernels and the data of both, and one script."""
    engine = {"_engine": neorl.Explorer._engine.default_value, "_layout": {"plane": wasm.layout("plane")},
              "wasm": b64encode(wasm.modules()["plane"]).decode()}
    data = json.dumps(engine | star.data(lesson) | game.data()).encode()
    script = "\n".join([text_of(*SCRIPTS), *((BOOK / name).read_text(encoding="utf-8") for name in OURS)])
    return (f'<style>{text_of("widget.css")}</style>\n{star.markup()}{game.markup(lesson)}'
            f'<script type="text/plain" class="star-data">{b64encode(gzip.compress(data, mtime=0)).decode()}</script>\n'
            f'<script type="module">{script}</script>\n')
