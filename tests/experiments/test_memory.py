"""The memory of a run does not grow with the number of steps."""

import psutil

from neorl import Run, WaterWorld, multimodal

STEPS = 200_000


def test_an_agent_of_twelve_maps_takes_no_more_memory_the_longer_it_runs():
    run = Run(multimodal(), WaterWorld())
    assert len(run.agent.maps) == 12
    run.advance(STEPS)  # by then every value has been touched
    before = psutil.Process().memory_info().rss
    for _ in range(10):
        run.advance(STEPS // 10)
    assert psutil.Process().memory_info().rss - before < 2**19  # fewer than three bytes per step
