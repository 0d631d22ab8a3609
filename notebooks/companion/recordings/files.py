"""Small files of recordings, each written by the library that writes such files, from a path in the unit square."""

import warnings
from datetime import UTC, datetime

import gymnasium
import minari
import numpy as np
import pandas as pd
import pynwb
from minari.data_collector import EpisodeBuffer

DATA_SET = "rat/box-v0"
CAMERA = 640  # pixels, of the side of the box
EXAMPLE = {"algorithm_name": "none", "author": "nobody", "author_email": "nobody@example.org",
           "code_permalink": "https://example.org", "description": "An example."}


def write_deeplabcut(file, path, likelihood):
    """Write a CSV as DeepLabCut does: three rows of names; then x and y in pixels, and the likelihood, of a nose."""
    names = pd.MultiIndex.from_product([["network"], ["nose"], ["x", "y", "likelihood"]],
                                       names=["scorer", "bodyparts", "coords"])
    pd.DataFrame(np.c_[CAMERA * path, likelihood], columns=names).to_csv(file)


def write_sleap(file, path, score):
    """Write a CSV as SLEAP does: a row for each frame in which the animal was found, here those with a score."""
    found = score > 0
    table = pd.DataFrame({"track": "", "frame_idx": np.arange(len(path)), "instance.score": score,
                          "nose.x": CAMERA * path[:, 0], "nose.y": CAMERA * path[:, 1], "nose.score": score})
    table[found].to_csv(file, index=False)


def write_nwb(file, path, rate):
    """Write a file of Neurodata Without Borders, with the position in centimetres at so many frames a second."""
    session = pynwb.NWBFile(session_description="A rat in a box.", identifier="example",
                            session_start_time=datetime(2026, 1, 1, tzinfo=UTC))
    series = pynwb.behavior.SpatialSeries(name="SpatialSeries", data=100 * path, reference_frame="a corner of the box",
                                          rate=rate, unit="meters", conversion=0.01)
    position = pynwb.behavior.Position(spatial_series=series)
    session.create_processing_module(name="behavior", description="tracking").add(position)
    with pynwb.NWBHDF5IO(file, "w") as io:
        io.write(session)


def write_minari(episodes):
    """Write a data set of Minari, where the variable MINARI_DATASETS_PATH says. episodes: paths, (steps + 1, 2)."""
    buffers = [EpisodeBuffer(id=k, observations=path, actions=np.diff(path, axis=0), rewards=[0.0] * (len(path) - 1),
                             terminations=[False] * (len(path) - 1),
                             truncations=[False] * (len(path) - 2) + [True]) for k, path in enumerate(episodes)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # there is no environment to evaluate in
        minari.create_dataset_from_buffers(
            DATA_SET, buffer=buffers, observation_space=gymnasium.spaces.Box(0, 1, (2,), np.float64),
            action_space=gymnasium.spaces.Box(-1, 1, (2,), np.float64), **EXAMPLE)
