"""Living figures that stand before the experiment, and get the page's own runs once it has them."""

from IPython.display import DisplayHandle, display


class Living:
    """A widget in the place where it was made, until `show` puts another there."""

    def __init__(self, widget):
        self._widget = widget
        self._place = display(widget, display_id=True) or DisplayHandle()  # None outside IPython

    def show(self, widget):
        """Put a widget in the place of the one before."""
        self._place.update(widget)
        self._widget.close()
        self._widget = widget
