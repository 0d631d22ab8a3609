"""What a living figure leaves where nothing can run: a sentence, and a still picture.

The place of a widget holds no more than the name of its model, so an exported notebook read offline is blank there. A
figure is therefore displayed as two outputs, and the style sheet hides the picture where the figure lives.
"""

from html import escape

import numpy as np

from neorl.common.extras import require

AnyWidget = require("anywidget", extra="wasm").AnyWidget
ipython = require("IPython.display", extra="wasm")

WIDTH, HEIGHT = 300, 150  # pixels of a picture
COLOURS = {"agent": "#3b8ad9", "green": "#12946d", "red": "#d9622b"}  # as in widget.css
GREY = "#808080"


class Figure(AnyWidget):
    """A widget that says what it is in a sentence, `_sentence()`, and draws what its picture contains, `_drawn()`."""

    _is_displayed = False

    def __repr__(self):
        return self._sentence()

    def _repr_mimebundle_(self, **kwargs):
        data, metadata = super()._repr_mimebundle_(**kwargs)
        return data | {"text/markdown": escape(self._sentence())}, metadata

    def _ipython_display_(self):
        data, metadata = self._repr_mimebundle_()
        ipython.display(data, metadata=metadata, raw=True)
        ipython.display(self._picture(), raw=True, display_id=self.model_id)
        self._is_displayed = True

    def _draw_again(self):
        """Draw the picture again wherever the figure has been displayed."""
        if self._is_displayed:
            ipython.update_display(self._picture(), raw=True, display_id=self.model_id)

    def _picture(self):
        return {"text/plain": self._sentence(), "text/html": (
            f'<figure class="neorl-still"><svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
            f'role="img" aria-label="{escape(self._sentence())}">{self._drawn()}</svg></figure>')}


def discs(places, kinds, radius):
    """Discs on a board, whose sides are 1, in the colours of their kinds."""
    found = "".join(f'<circle cx="{HEIGHT * x:.1f}" cy="{HEIGHT * y:.1f}" r="{HEIGHT * radius:.1f}" '
                    f'fill="{COLOURS.get(kind, GREY)}"/>' for (x, y, *_), kind in zip(places, kinds))
    return f'<rect width="{HEIGHT}" height="{HEIGHT}" fill="none" stroke="{GREY}"/>{found}'


def beginning(world, seed):
    """A world at the beginning of an episode."""
    scene = world.reset(seed).scene
    kinds = ["agent", *(world.kinds[kind] if kind >= 0 else "" for kind in scene.kinds)]
    radius = world.radius / world.size if hasattr(world, "radius") else 0.04
    return discs(np.vstack([scene.position[:2], scene.things[:, :2]]) / world.size, kinds, radius)


def curve(xs, ys):
    """A curve as wide as the picture."""
    low, high = min(0.0, *ys), max(1e-9, *ys)
    points = " ".join(f"{WIDTH * x / xs[-1]:.1f},{HEIGHT * (high - y) / (high - low):.1f}" for x, y in zip(xs, ys))
    return f'<polyline points="{points}" fill="none" stroke="{COLOURS["agent"]}" stroke-width="2"/>'
