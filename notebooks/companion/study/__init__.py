"""The study of what the thesis leaves open: the multiverse of readings, and the calibration to its printed numbers.

The pages on assumptions and on calibration show it. `calibration.csv` is the table of calibrated readings, which
``python notebooks/calibrate.py`` continues.
"""
