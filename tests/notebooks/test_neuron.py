"""The neuron against closed forms and known properties of the equations."""

import numpy as np
import pytest
from matplotlib import pyplot as plt

from lib.chapter_2 import neuron, psychology_figures
from lib.chapter_2.neuron import (REST, Neuron, action_potential, efficacy, firing_rate, gate_rates,
                                             gates_at_rest, integrate, peak, pulses_at_threshold, synaptic_current)
from lib.shared.grid import Grid
from neorl.drawing.style import LOW_PANEL, name_ends


def test_an_axon_that_is_left_alone_stays_at_rest():
    axon = action_potential(0.0)
    np.testing.assert_allclose(axon.potential, REST, atol=0.02)
    np.testing.assert_allclose(gates_at_rest(), [0.0529, 0.5961, 0.3177], atol=1e-4)  # as in textbooks


def test_the_gates_move_as_in_the_paper():
    """Values at a depolarisation of 25 and 10 mV, where the formulas are 0/0, and of 30 mV."""
    opening, closing = gate_rates(REST + 25)
    assert (opening[0], closing[0]) == pytest.approx((1.0, 4 * np.exp(-25 / 18)))
    opening, closing = gate_rates(REST + 10)
    assert (opening[2], closing[2]) == pytest.approx((0.1, 0.125 * np.exp(-1 / 8)))
    opening, closing = gate_rates(REST + 30)
    assert (opening[1], closing[1]) == pytest.approx((0.07 * np.exp(-1.5), 0.5))
    assert opening[0] == pytest.approx(0.1 * 5 / (1 - np.exp(-0.5)))


def test_an_action_potential_is_all_or_none():
    peaks = {current: action_potential(current).potential.max() for current in (3.0, 6.0, 8.0, 16.0)}
    assert peaks[3.0] < peaks[6.0] < -55.0
    assert 35.0 < peaks[8.0] < peaks[16.0] < 45.0


def test_the_threshold_lies_between_two_pulses_close_to_each_other(monkeypatch):
    monkeypatch.setattr("lib.chapter_2.neuron.peak", lambda current: 30.0 if current > 6.92 else -57.0)
    weak, strong = pulses_at_threshold()
    assert weak <= 6.92 < strong and strong - weak <= 0.05


def test_the_peak_is_the_highest_potential():
    assert peak(8.0) == action_potential(8.0).potential.max()


def test_after_an_action_potential_the_axon_is_below_rest():
    axon = action_potential(20.0)
    assert axon.potential.argmin() > axon.potential.argmax()
    assert -77.0 < axon.potential.min() < -70.0  # never below the reversal potential of potassium
    assert axon.time[axon.potential.argmax()] > 5.0 and len(axon.time) == 2_500


def test_the_axon_obeys_its_own_equation():
    """By finite differences, the membrane's charge changes by the injected current less that through the channels."""
    time, potential, m, h, n = action_potential(10.0)
    flow = 120 * m**3 * h * (potential - 50) + 36 * n**4 * (potential + 77) + 0.3 * (potential + 54.387)
    inside = (time > 5.05) & (time < 5.95)
    change = np.gradient(potential, time)
    np.testing.assert_allclose(change[inside], 10.0 - flow[inside], atol=0.05)
    np.testing.assert_allclose(change[time > 6.05], -flow[time > 6.05], atol=1.0)


@pytest.mark.parametrize("neuron", [Neuron(), Neuron(-70.0, -55.0, -75.0, 20.0, 5.0, 0.0)])
def test_the_soma_fires_as_often_as_the_closed_form_says(neuron):
    currents = np.array([1.0, 1.4, 2.5, 3.5, 4.5, 6.0])
    _, spikes = integrate(np.tile(currents, (40_000, 1)), neuron, step=0.05)
    np.testing.assert_allclose(spikes.sum(axis=0) / 2, firing_rate(currents, neuron), rtol=0.01, atol=0.5)
    assert firing_rate(currents, neuron)[0] == 0.0 and firing_rate(currents, neuron)[-1] > 50


def test_the_refractory_time_bounds_the_rate():
    assert firing_rate(1e6) == pytest.approx(500.0, rel=1e-3)
    _, spikes = integrate(np.full(10_000, 1e6))
    assert np.diff(np.flatnonzero(spikes)).min() == 21  # 2 ms at the reset, and one step up
    potential, spikes = integrate(np.full(300, 5.0), Neuron(reset=-72.0))
    (first, *_) = np.flatnonzero(spikes)
    assert np.all(potential[first + 1 : first + 21] == -72.0) and potential[first + 21] > -72.0


def test_below_threshold_the_soma_integrates_exactly():
    potential, spikes = integrate(np.full(300, 1.2), step=0.5)
    time = 0.5 * np.arange(1, 301)
    np.testing.assert_allclose(potential, -65.0 + 12.0 * (1 - np.exp(-time / 10.0)), rtol=1e-12)
    assert not spikes.any()


def test_a_neuron_is_the_same_alone_and_among_others():
    current = np.random.default_rng(0).uniform(0, 4, (500, 3))
    potential, spikes = integrate(current)
    np.testing.assert_array_equal(integrate(current[:, 1])[0], potential[:, 1])
    assert 0 < spikes.sum() and np.all(potential[~spikes] < -50.0)


def test_a_synapse_sets_off_a_current_for_each_spike():
    spikes = np.zeros(1_000, bool)
    spikes[[100, 400]] = True
    current = synaptic_current(spikes, weight=-0.5, decay=4.0, step=0.2)
    assert current[99] == 0.0 and current[100] == -0.5 and current[120] == pytest.approx(-0.5 / np.e)
    assert current[101] == pytest.approx(-0.5 * np.exp(-0.05))
    assert current[400] == pytest.approx(-0.5 * (1 + np.exp(-15.0))) and current[-1] == pytest.approx(0, abs=1e-10)


def test_one_shock_is_forgotten_and_five_apart_are_not():
    day = np.array([24 * 60.0])
    spaced, massed = 15.0 * np.arange(5), 0.1 * np.arange(5)
    assert efficacy(day, [0.0]) == pytest.approx(1.0)
    share = np.exp(-1.0)
    assert efficacy(day, spaced) == pytest.approx(1 + 4 * share * (1 - share))
    assert efficacy(day, massed) < 1.05 and efficacy(day, spaced[:2]) < 1.3


def test_a_shock_doubles_the_efficacy_for_minutes():
    np.testing.assert_allclose(efficacy([-1, 0, 15, 60], [0]), 1 + np.array([0, 1, np.exp(-1), np.exp(-4)]))
    np.testing.assert_allclose(efficacy([10, 20], [0, 15]),
                               [1 + np.exp(-2 / 3), 1 + np.exp(-1 / 3) + np.exp(-1) * (1 - np.exp(-1))])
    assert efficacy([5.0], []) == 1.0


def test_the_four_parts_are_drawn_over_one_time():
    time, spikes = 0.1 * np.arange(100), np.arange(100) % 40 == 39
    psychology_figures.draw_parts(time, time, -60 + time, spikes, {"before": time, "after": 2 * time}, -50.0)
    dendrite, soma, axon, synapse = plt.gcf().axes
    assert [segment[0][0] for segment in axon.collections[0].get_segments()] == pytest.approx([3.9, 7.9])
    np.testing.assert_array_equal(soma.lines[0].get_ydata(), -60 + time)
    assert {text.get_text(): text.xy[1] for text in synapse.texts} == pytest.approx({"before": 9.9, "after": 19.8})


def test_names_beside_a_low_panel_keep_apart():
    axes = plt.figure().add_subplot(ylim=(0, 10))
    name_ends(axes, [(5.0, "a", "red"), (5.1, "b", "blue"), (0.0, "c", "green")], LOW_PANEL)
    heights = {text.get_text(): text.xy[1] for text in axes.texts}
    assert heights["c"] == 0.0 and heights["b"] - heights["a"] == pytest.approx(1.7)


def test_a_desire_is_drawn_everywhere_but_in_the_marked_places():
    grid = Grid(("F..",))
    q = np.zeros((3, 4))
    q[:, 3] = 1.0  # west
    psychology_figures.draw_motives(grid, {"none": 0 * q, "west": q}, {0: "F"})
    none, west = plt.gcf().axes
    arrows = west.collections[-1]
    assert len(none.collections[-1].U) == 0 and arrows.U.tolist() == pytest.approx([-0.38, -0.38])


@pytest.mark.parametrize("call, message", [
    (lambda: Neuron(threshold=-70.0), "threshold is -70.0, allowed are potentials above rest and reset"),
    (lambda: Neuron(time_constant=0.0), "time_constant must be .*, but is 0.0"),
    (lambda: action_potential(1.0, start=3.0, stop=2.0), "rising times"),
    (lambda: integrate([np.inf]), r"current must be finite numbers from -1e\+30 to 1e\+30, but is array\(\[inf\]\)"),
    (lambda: synaptic_current([1], np.nan), "weight must be .*, but is nan"),
    (lambda: efficacy([1.0], [3.0, 2.0]), "shocks is .* allowed are rising times"),
])
def test_a_bad_argument_is_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def test_each_series_of_shocks_has_its_efficacy():
    minutes = np.array([0.0, 31.0, 200.0])
    found = neuron.efficacies(minutes, neuron.SHOCKS)
    assert list(found) == ["one shock", "five, apart", "five at once"]
    np.testing.assert_array_equal(found["one shock"], efficacy(minutes, [30]))
    assert found["five, apart"][2] > 1.1 > found["one shock"][2]
