"""Memory of a run: as much after many steps as after few."""

import tracemalloc

import psutil

from neorl import Run, WaterWorld, multimodal

STEPS = 200_000


def test_the_agent_of_twelve_maps_takes_no_more_memory_the_longer_it_lives():
    run = Run(multimodal(), WaterWorld())
    assert len(run.agent.maps) == 12
    run.advance(STEPS)  # by which time every value has been touched
    tracemalloc.start()
    try:
        run.advance(STEPS // 10)  # which fills caches of Python's own
        before, traced = psutil.Process().memory_info().rss, tracemalloc.get_traced_memory()[0]
        for _ in range(10):
            run.advance(STEPS // 10)
        grown, allocated = psutil.Process().memory_info().rss - before, tracemalloc.get_traced_memory()[0] - traced
    finally:
        tracemalloc.stop()
    assert allocated < 20_000
    assert grown < 2**20
