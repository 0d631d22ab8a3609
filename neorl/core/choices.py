"""What the kernels know by number; everywhere else it goes by these names."""

from enum import IntEnum

Source = IntEnum("Source", "green red node point place", start=0)  # where a desire comes from
Weighting = IntEnum("Weighting", "equal resolution cells", start=0)  # of maps: by N to the power of this number
UpdateOn = IntEnum("UpdateOn", "cell step", start=0)
Credit = IntEnum("Credit", "share happened last count activity", start=0)
Capture = IntEnum("Capture", "contact leap silent", start=0)
Attention = IntEnum("Attention", "each nearest wanted", start=0)
Vector = IntEnum("Vector", "position velocity objects boundaries landmarks", start=0)  # what a modality starts from
Tuning = IntEnum("Tuning", "cartesian proximal polar angle length", start=0)  # what its cells keep of that
Action = IntEnum("Action", "N S E W no_op", start=0)
N_EVENTS = 4  # the no-op is no event
