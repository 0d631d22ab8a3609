"""A neuron in three sketches: its action potential, its integrating soma, and its plastic synapse.

1. *Action potential*: the equations of Hodgkin and Huxley (1952) for the giant axon of the squid at 6.3 °C. Gates open
   and close at rates that depend on the potential, and let sodium in and potassium out.
2. *Integration*: a leaky integrate-and-fire neuron (Lapicque 1907). Input current raises the potential, a leak draws it
   back to rest; at the threshold the neuron fires and is reset. Between two steps the solution is exact.
3. *Synapse*: each spike sets off a current that decays exponentially. Its efficacy changes with what happens to the
   animal, for minutes or for good (Kandel and Tauc 1965; Sutton et al. 2002; thesis section 2.2).

Units throughout: milliseconds, millivolts, megaohms and nanoamperes; for the axon, microamperes per square centimetre.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.signal import lfilter
from scipy.special import exprel

from neorl import checks

# Hodgkin and Huxley 1952, table 3, with the potential inside relative to outside and rest at −65 mV.
REST = -65.0
CAPACITY = 1.0  # µF/cm²
SODIUM, POTASSIUM, LEAK = 120.0, 36.0, 0.3  # mS/cm², all channels open
SODIUM_AT, POTASSIUM_AT, LEAK_AT = REST + 115.0, REST - 12.0, REST + 10.613  # mV, reversal potentials
RESOLUTION = 0.01  # ms between two points of an action potential
SHOCKS = {"one shock": [30], "five, apart": [30, 45, 60, 75, 90],
          "five at once": [30, 30.1, 30.2, 30.3, 30.4]}  # to the animal, times in minutes
PULSES_APART = 0.05  # µA/cm², precision of the search for the axon's threshold


class Axon(NamedTuple):
    """The state of an axon over time: all float64 (points,)."""

    time: np.ndarray  # ms
    potential: np.ndarray  # mV
    m: np.ndarray  # share of the sodium gates that activation has opened
    h: np.ndarray  # share of the sodium gates that inactivation has not closed
    n: np.ndarray  # share of the potassium gates that are open


def action_potential(current, start=5.0, stop=6.0, duration=25.0):
    """The response of an axon at rest to a pulse of current (Hodgkin and Huxley 1952, eq. 26): an `Axon`.

    current: µA/cm². The pulse lasts from ``start`` to ``stop``, the trace from 0 to ``duration``; ms, in this order.
    Raises ValueError for anything else.
    """
    checks.real("current", current)
    times = [checks.real(name, value, 0) for name, value in
             [("start", start), ("stop", stop), ("duration", duration)]]
    if not times[0] < times[1] < times[2]:
        raise ValueError(f"start, stop and duration are {start}, {stop} and {duration}, allowed are rising times")
    state, parts = np.array([REST, *gates_at_rest()]), []
    # In pieces, so that the solver never steps across an edge of the pulse.
    for begin, end, inflow in zip([0.0, start, stop], times, [0.0, current, 0.0]):
        points = np.arange(round(begin / RESOLUTION), round(end / RESOLUTION)) * RESOLUTION
        solution = solve_ivp(_axon_change, (begin, end), state, method="LSODA", t_eval=[*points, end], args=(inflow,),
                             rtol=1e-7, atol=1e-8)
        state = solution.y[:, -1]
        parts.append(np.vstack([solution.t, solution.y])[:, :-1])
    return Axon(*np.concatenate(parts, axis=1))


def peak(current):
    """The highest potential of an axon in response to the pulse of `action_potential`, in mV."""
    return action_potential(current).potential.max()


def pulses_at_threshold():
    """A pulse just too weak to set off an action potential, and one just strong enough: two currents, µA/cm².

    They differ by at most `PULSES_APART`. An action potential is a peak above 0 mV.
    """
    weak, strong = 1.0, 20.0
    while strong - weak > PULSES_APART:
        middle = (weak + strong) / 2
        if peak(middle) > 0:
            strong = middle
        else:
            weak = middle
    return weak, strong


def gates_at_rest():
    """How far the gates m, h and n are open at rest: float64 (3,), from 0 to 1."""
    opening, closing = gate_rates(REST)
    return opening / (opening + closing)


def gate_rates(potential):
    """The rates at which the gates m, h and n open and close at a potential in mV: two float64 (3,), per ms.

    Hodgkin and Huxley 1952, eq. 12, 13, 20, 21, 23 and 24.
    """
    above = potential - REST
    opening = np.array([1.0 / exprel((25 - above) / 10), 0.07 * np.exp(-above / 20), 0.1 / exprel((10 - above) / 10)])
    closing = np.array([4.0 * np.exp(-above / 18), 1.0 / (np.exp((30 - above) / 10) + 1), 0.125 * np.exp(-above / 80)])
    return opening, closing


def _axon_change(time, state, inflow):
    potential, gates = state[0], state[1:]
    m, h, n = gates
    outflow = (SODIUM * m**3 * h * (potential - SODIUM_AT) + POTASSIUM * n**4 * (potential - POTASSIUM_AT)
               + LEAK * (potential - LEAK_AT))
    opening, closing = gate_rates(potential)
    return np.array([(inflow - outflow) / CAPACITY, *(opening * (1 - gates) - closing * gates)])


@dataclass(frozen=True)
class Neuron:
    """A leaky integrate-and-fire neuron; by default that of Dayan and Abbott (2001, chapter 5).

    rest, threshold, reset: mV, with ``rest`` and ``reset`` below ``threshold``.
    time_constant: of the leak, ms, above 0. resistance: MΩ, above 0. refractory: ms at ``reset`` after a spike, ≥ 0.

    Raises ValueError for anything else.
    """

    rest: float = -65.0
    threshold: float = -50.0
    reset: float = -65.0
    time_constant: float = 10.0
    resistance: float = 10.0
    refractory: float = 2.0

    def __post_init__(self):
        for name in ("rest", "threshold", "reset"):
            checks.real(name, getattr(self, name))
        for name in ("time_constant", "resistance", "refractory"):
            checks.real(name, getattr(self, name), 0 if name == "refractory" else 1e-9)
        if not max(self.rest, self.reset) < self.threshold:
            raise ValueError(f"threshold is {self.threshold}, allowed are potentials above rest and reset")


def integrate(current, neuron=Neuron(), step=0.1):
    """Let neurons integrate a current and fire: potentials in mV, float64, and spikes, bool, both of its shape.

    current: float (steps, …), nA, time first; constant during a step. step: ms, above 0.
    Raises ValueError for anything else.
    """
    current = checks.finite("current", np.asarray(current, float))
    fraction = -np.expm1(-checks.real("step", step, 1e-9) / neuron.time_constant)
    pause = round(neuron.refractory / step)
    target = neuron.rest + neuron.resistance * current
    potential, spikes = np.empty(current.shape), np.zeros(current.shape, bool)
    now, resting = np.full(current.shape[1:], neuron.rest), np.zeros(current.shape[1:], int)
    for t in range(len(current)):
        now = np.where(resting > 0, neuron.reset, now + fraction * (target[t] - now))
        resting = np.maximum(resting - 1, 0)
        spikes[t] = now >= neuron.threshold
        potential[t] = now
        now = np.where(spikes[t], neuron.reset, now)
        resting = np.where(spikes[t], pause, resting)
    return potential, spikes


def firing_rate(current, neuron=Neuron()):
    """Spikes per second of a neuron under a constant current in nA, in closed form: float64, of the current's shape.

    It is the inverse of the refractory time plus the time from reset to threshold (Dayan and Abbott 2001, eq. 5.11).
    """
    drive = neuron.rest + neuron.resistance * checks.finite("current", np.asarray(current, float))
    fires = drive > neuron.threshold
    safe = np.where(fires, drive, neuron.threshold + 1.0)
    rise = neuron.time_constant * np.log((safe - neuron.reset) / (safe - neuron.threshold))
    return np.where(fires, 1000.0 / (neuron.refractory + rise), 0.0)


def synaptic_current(spikes, weight, decay=5.0, step=0.1):
    """The postsynaptic current in nA that spikes set off: float64, of the shape of ``spikes``, time first.

    spikes: the number in each step. weight: nA per spike, negative if the synapse inhibits. decay: time constant, ms.
    """
    decay = np.exp(-checks.real("step", step, 1e-9) / checks.real("decay", decay, 1e-9))
    return lfilter([checks.real("weight", weight)], [1.0, -decay], np.asarray(spikes, float), axis=0)


def efficacies(minutes, shocks):
    """`efficacy` after several series of shocks, {name: [minute, …]}: {name: (minutes,)}."""
    return {name: efficacy(minutes, at) for name, at in shocks.items()}


def efficacy(minutes, shocks, fading=15.0, short=1.0, lasting=1.0):
    """The efficacy of a synapse over time in an animal that receives shocks, 1 before the first: float64 (minutes,).

    A shock sets a trace to 1, which fades with the time constant ``fading``, in minutes; efficacy is raised by
    ``short`` times the trace. It rises permanently by ``lasting`` × trace × (1 − trace) at a shock that falls on the
    trace of another, so that neither a single shock nor shocks in quick succession leave a permanent change. This
    sketches the observations, not the mechanism.

    minutes: when to evaluate it, (minutes,). shocks: their times, rising. Raises ValueError for anything else.
    """
    minutes = checks.finite("minutes", np.asarray(minutes, float))
    shocks = checks.finite("shocks", np.asarray(shocks, float))
    checks.real("fading", fading, 1e-9)
    if np.any(np.diff(shocks) <= 0):
        raise ValueError(f"shocks is {shocks!r}, allowed are rising times")
    found = np.exp(-np.diff(shocks) / fading)
    kept = np.concatenate([[0.0, 0.0], np.cumsum(lasting * found * (1 - found))])[: len(shocks) + 1]
    past = np.searchsorted(shocks, minutes, side="right")
    latest = np.concatenate([[-np.inf], shocks])[past]
    return 1.0 + short * np.exp(-(minutes - latest) / fading) + kept[past]
