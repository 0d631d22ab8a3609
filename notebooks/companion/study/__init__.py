"""The study of what the thesis leaves open: the search for a reading that agrees with its printed numbers, and on which
choices the claims depend.

`calibration.csv` is the table of readings that were run at the papers' lengths; ``python notebooks/calibrate.py 17``
runs its row 17 again. The page of claims and those on the text and on the search draw their conclusions from it.
`base_rate.csv` has, for the page of claims, how many claims a reading drawn at random agrees with.
"""
