"""Choices that kernels know by number; everywhere else they go by these names."""

from enum import IntEnum

Source = IntEnum("Source", "kind node point place", start=0)  # where a desire comes from
Weighting = IntEnum("Weighting", "equal resolution cells", start=0)  # of maps: by N to the power of this number
UpdateOn = IntEnum("UpdateOn", "cell step", start=0)
Credit = IntEnum("Credit", "share happened last count activity own", start=0)
MapState = IntEnum("MapState", "object self per_object", start=0)  # what the state of a map of things is
Vector = IntEnum("Vector", "position velocity objects boundaries landmarks own", start=0)  # that an axis is based on
Feature = IntEnum("Feature", "component foveated margin length direction", start=0)  # of that vector, along an axis
Cut = IntEnum("Cut", "equal centred closed boundaries", start=0)  # of an axis; closed: other than a direction
Action = IntEnum("Action", "N S E W no_op", start=0)  # of worlds whose actions are `scene.CARDINAL`
