"""Drawings of learning in boxes and mazes, and of neurons."""

import numpy as np
from matplotlib import pyplot as plt

from lib.chapter_2.neuron import firing_rate
from lib.shared.grid_figures import draw_grid, draw_policy, new_grids
from neorl.drawing.curves import POINTS, draw_curves
from neorl.drawing.style import AGENT, CURVES, GREEN, INK, LOW_PANEL, RED, name_ends


def draw_latencies(latencies, published):
    """Seconds to escape in each trial: {name: (runs, trials)} with bands, and an animal's published times as points."""
    (_, trials), *_ = (each.shape for each in latencies.values())
    axes = draw_curves(np.arange(trials) + 1, latencies, "trial", "seconds to escape")
    axes.plot(np.arange(len(published)) + 1, published, color=INK, linestyle="none", marker="o", markersize=5)
    axes.set_ylim(0, None)


def draw_sessions(curves, phases, ylabel):
    """Curves over sessions, {name: (runs, sessions)}, with phases {name: the session it begins with, from 0}.

    The names of curves stand above them, in the middle of the phase that sets them furthest apart.
    """
    (_, sessions), *_ = (each.shape for each in curves.values())
    axes = draw_curves(np.arange(sessions) + 1, curves, "session", ylabel)
    ends = [*phases.values()][1:] + [sessions]
    means = np.array([each.mean(axis=0) for each in curves.values()])
    middle = max(((begin + end) // 2 for begin, end in zip(phases.values(), ends)), key=lambda at: np.ptp(means[:, at]))
    for name in axes.texts:  # written by `draw_curves` beside ends, where these curves are alike
        height = means[[*curves].index(name.get_text()), middle]
        name.set(position=(0, 3), va="bottom", ha="center")
        name.xy, name.xycoords, name.anncoords = (middle + 1, height), "data", "offset points"
    axes.set_ylim(0, 1.1 * means.max())
    for (name, begin), end in zip(phases.items(), ends):
        axes.text((begin + end + 1) / 2, 1.02, name, transform=axes.get_xaxis_transform(), ha="center")
        if begin:
            axes.axvline(begin + 0.5, color=INK, linewidth=0.8, linestyle=":")


def draw_motives(grid, values, marks):
    """The best actions in a grid under each of several desires, {name: values (states, 4)}.

    marks: {state: text}, written in place of an action.
    """
    for axes, (name, q) in zip(new_grids(grid, columns=len(values)), values.items()):
        draw_grid(axes, grid)
        draw_policy(axes, grid, np.where(np.isin(np.arange(grid.states), [*marks])[:, None], 0.0, q))
        axes.set_title(name, fontsize=11)
        for state, text in marks.items():
            axes.text(*grid.places[state], text, ha="center", va="center_baseline", color=RED, weight="bold")


def draw_action_potential(axon, reversals):
    """The potential of an axon over time, with the reversal potentials {name: mV}, and its gates below."""
    width, _ = plt.rcParams["figure.figsize"]
    _, (top, bottom) = plt.subplots(2, sharex=True, figsize=(width, 1.05 * width), height_ratios=(3, 2))
    for name, level in reversals.items():
        top.axhline(level, color=INK, linewidth=0.8, linestyle=":")
    top.plot(axon.time, axon.potential, color=AGENT)
    top.set(ylabel="millivolts", ylim=(-90, 60))
    name_ends(top, [(level, name, INK) for name, level in reversals.items()])
    names = {"m": "m: Na⁺ opens", "h": "h: Na⁺ not shut", "n": "n: K⁺ opens"}
    ends = []
    for (gate, name), colour in zip(names.items(), CURVES):
        bottom.plot(axon.time, getattr(axon, gate), color=colour)
        ends.append((getattr(axon, gate)[-1], name, colour))
    bottom.set(xlabel="milliseconds", ylabel="share open", ylim=(0, 1), xlim=(0, axon.time[-1]))
    name_ends(bottom, ends)


def draw_firing_rates(currents, counted):
    """Spikes per second over the current, counted in a simulation and in closed form."""
    axes = plt.figure().add_subplot()
    fine = np.linspace(currents[0], currents[-1], POINTS)
    expected = firing_rate(fine)
    axes.plot(fine, expected, color=INK, linewidth=1.2)
    axes.plot(currents, counted, color=AGENT, linestyle="none", marker="o", markersize=5)
    axes.set(xlabel="current, nanoamperes", ylabel="spikes per second")
    name_ends(axes, [(counted[-1], "simulated", AGENT), (expected[-1], "closed form", INK)])


def draw_parts(time, inflow, potential, spikes, answers, threshold):
    """The signals in the four parts of a neuron over time, one panel each.

    inflow: the current into the dendrite. potential: of the soma, with its threshold. spikes: on the axon.
    answers: the postsynaptic potential {name: (steps,)}.
    """
    width, _ = plt.rcParams["figure.figsize"]
    _, panels = plt.subplots(4, sharex=True, figsize=(width, 1.35 * width), height_ratios=(3, 3, 1, 3))
    dendrite, soma, axon, synapse = panels
    dendrite.plot(time, inflow, color=CURVES[5], linewidth=1.0)
    dendrite.axhline(0, color=INK, linewidth=0.7)
    soma.plot(time, potential, color=AGENT, linewidth=1.0)
    soma.axhline(threshold, color=INK, linewidth=0.8, linestyle=":")
    axon.vlines(time[spikes], 0, 1, color=RED, linewidth=1.4)
    axon.set(ylim=(0, 1.1), yticks=[])
    ends = []
    for (name, answer), colour in zip(answers.items(), (GREEN, CURVES[4])):
        synapse.plot(time, answer, color=colour, linewidth=1.0)
        ends.append((answer[-1], name, colour))
    name_ends(synapse, ends, line=LOW_PANEL)
    name_ends(soma, [(threshold, "threshold", INK)])
    titles = ("dendrite: current in, nA", "soma: potential, mV", "axon: spikes", "synapse: the next neuron, mV")
    for axes, title in zip(panels, titles):
        axes.set_title(title, fontsize=11, loc="left")
    synapse.set(xlabel="milliseconds", xlim=(0, time[-1]))


def draw_efficacies(minutes, efficacies):
    """The efficacy of a synapse over time after shocks to the animal: {name: (minutes,)}."""
    axes = plt.figure().add_subplot()
    ends = []
    for (name, efficacy), colour in zip(efficacies.items(), CURVES):
        axes.plot(minutes, efficacy, color=colour)
        ends.append((efficacy[-1], name, colour))
    axes.set(xlabel="minutes", ylabel="efficacy of the synapse", ylim=(0, None), xlim=(0, minutes[-1]))
    name_ends(axes, ends)
