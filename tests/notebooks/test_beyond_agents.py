"""The page on the forager: its parts, its sentences and the record of the search."""

import re

import numpy as np
import pytest

from lib.beyond_agents import experiments, figures, report, search
from neorl import WaterWorld, forager, simulate
from neorl.core.maps import NresMap
from neorl.drawing.style import GREEN, RED, letters


@pytest.fixture(scope="module")
def lived():
    return experiments.live(2_000, 2, 5)


def test_all_parts_make_the_forager_and_none_the_bare_agent():
    agents = experiments.way_agents()
    assert list(agents) == [experiments.BARE, *(f"+ {part}" for part in experiments.PARTS)]
    assert agents[f"+ {experiments.PARTS[-1]}"] == forager()
    bare = agents[experiments.BARE]
    assert (bare.contacts.fear, bare.contacts.rivals) == ("approach", "add")
    assert bare.contacts.first_value == bare.contacts.trace_rate == 0 and len(bare.nodes[0].modality.axes) == 2
    assert len(set(map(repr, [*agents.values(), *experiments.without_agents().values()]))) == 2 * len(experiments.PARTS)
    with pytest.raises(ValueError, match="parts has wings"):
        experiments.forager_with(["wings"])


def test_receptive_fields_are_as_large_without_mirror_images():
    mirrored, plain = (experiments.forager_with(set(experiments.PARTS) - {*without}).nodes[0]
                       for without in (("several resolutions",), ("several resolutions", "mirror images")))
    point = np.array([0.3, 0.2, 0.1, -0.4])
    widths = []
    for node in (mirrored, plain):
        a_map = NresMap(node.resolutions[0], node.modality)
        at = np.linspace(0, 1, 2_001)
        cells = a_map.encode(np.column_stack([at, *(np.full(at.shape, each) for each in point[1:])]))
        widths.append(len(set(cells.tolist())))
    assert abs(widths[0] - widths[1]) <= 1


def test_the_page_says_and_draws_what_was_found(lived):
    assert "per second over the last third" in report.summary(lived) and "**" not in report.summary(lived)
    assert re.search(r"most without “[^”]+” \(to [\d.−]+\), “", report.summary(lived))
    assert report.target_table(lived).count("\n") == 1 + len(experiments.TARGETS)
    assert report.part_table(lived).count("\n") == 1 + len(experiments.PARTS)
    for draw in (figures.draw_learning, figures.draw_long, figures.draw_parts, figures.draw_revalued):
        draw(lived)
    names = {text.get_text(): text.get_color() for text in figures.draw_revalued(lived).texts}
    assert names == {"green": letters(GREEN), "red": letters(RED)}


def test_hits_per_second_count_all_hits(lived):
    minutes, rates = experiments.hits_per_second(lived.revalued, stretches=4)
    seconds = lived.revalued.seconds / 4
    assert np.allclose(sum(rates["green"].T) * seconds, lived.revalued.hits[:, :, 0].sum(axis=1))
    assert np.allclose(minutes, (np.arange(4) + 0.5) * seconds / 60)


def test_fear_stays_low_where_there_is_a_way_out():
    middles, fears = experiments.fear_by_approach(20_000, 2, 3)
    mean = report.mean_fear(fears)
    assert np.nanmax(mean[middles < 0.6]) < 0.1 < np.nanmax(mean)
    assert "half a contact" in report.fear_in_words(middles, fears)


def test_what_was_used_is_less_than_what_is_held():
    cost = experiments.cost(1_000)
    assert 0 < cost.used < cost.held and cost.microseconds > 0
    assert "KiB" in report.cost_in_words(cost)


def test_the_record_of_the_search_was_made_by_this_code():
    record = search.read_record()
    best = record[0]
    assert search.agent_of(best) == forager()
    found = simulate(search.agent_of(best), WaterWorld(), runs=4, steps=150_000, seed=search.SEED, progress=False)
    assert np.isclose(found.rate(2 / 3).mean(), best["with_3"], atol=2e-3)
    assert str(len(record)) in report.search_in_words() and "horizon 0.389 s, " in report.search_in_words()


def test_settings_span_their_ranges():
    low, high = (search.settings_at([each] * 7) for each in (0.0, 1.0))
    assert tuple(low["resolutions"]) == search.RESOLUTIONS[0] and tuple(high["resolutions"]) == search.RESOLUTIONS[-1]
    for name, (least, most) in search.RANGES.items():
        assert low[name] == pytest.approx(least) and high[name] == pytest.approx(most)
