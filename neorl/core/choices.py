"""The choices of an agent that the kernels know by number; everywhere else they go by these names."""

from enum import IntEnum

Source = IntEnum("Source", "green red node point place", start=0)  # where a desire comes from
Weighting = IntEnum("Weighting", "equal resolution cells", start=0)  # of maps: by N to the power of this number
UpdateOn = IntEnum("UpdateOn", "cell step", start=0)
Credit = IntEnum("Credit", "share happened last count activity", start=0)
Capture = IntEnum("Capture", "contact leap silent", start=0)
Attention = IntEnum("Attention", "each nearest wanted", start=0)
