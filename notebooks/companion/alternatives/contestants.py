"""The contestants of the page on alternatives, what those earn that are not agents, and the claims on them."""

from companion.alternatives.controllers import PLANNED, nearest_green, pd, planner
from companion.alternatives.contests import (BOARDS, DEFAULTS, FPS, PAPER_A, bins_of, identity, read, run_contestant,
                                              stored)
from companion.alternatives.search import DEEP, best_settings
from companion.alternatives.tabular_learners import TABULAR
from companion.page import judging
from neorl import Condition, brownian, multimodal
from companion.thesis import claims
from companion.thesis.reading import NAMES, PRIMES, READINGS, networks
from companion.thesis.verdict import FINAL, RUNS_FOR_A_VERDICT, fewest_runs

INFORMED = {"nearest green": lambda gains: nearest_green(), "PD": pd, "planner": planner}  # given the physics
BROWNIAN = "Brownian motion"
SEES = {False: "relative positions", True: "relative positions and velocities"}  # of creeps, whether deep or not
N_CREEPS, STEPS = 3, 150_000  # of the board by which claim C5 is judged, and of the runs by which C5 and A10 are


def of_thesis():
    """The thesis's agents under both readings: {"agent, reading": `Agent`}."""
    return {f"{kind}, {NAMES[name]}": agent for name, reading in READINGS.items() for kind, agent in {
        "PC + OVC": multimodal(PRIMES, place_gain=reading.place_gain, **reading.agents),
        "network D": networks(reading)["D"]}.items()}


def of_others(settings, board, steps, runs, seed):
    """What contestants that are not agents of neoRL earn on a board: {name: `Earned`}."""
    others = {name: make(settings[name]) for name, make in TABULAR.items()}
    others |= {name: make(settings["PD"]) for name, make in INFORMED.items()}
    length = {"planner": max(bins_of(steps), round(PLANNED * steps))}
    return {name: run_contestant(each, board, steps=length.get(name, steps), runs=runs, bins=bins_of(steps), seed=seed)
            for name, each in others.items()}


def judge(results, earned, control):
    """Claims C5 and A10 by what contestants earn, a list: none unless they and the boards are those that it is about.

    Learners count that ran as long as the agents, in as many runs or enough for a verdict.
    results: {number of creeps: {name: `Result`}} of agents. earned: the same with `Earned`, of all. control: the
    `Result` of Brownian motion on the board of paper A, with which stored runs of deep learners there are compared.
    """
    return [*_attempts(results[N_CREEPS], earned[N_CREEPS]), *untrained(control)]


def _attempts(results, earned):
    thesis, board = of_thesis(), BOARDS[N_CREEPS]
    wanted = {name: Condition(agent, board, STEPS, 1) for name, agent in {BROWNIAN: brownian(), **thesis}.items()}
    ran = results | {name: earned[name].identity for name in TABULAR if name in earned}
    settings = best_settings()
    wanted |= {name: identity(make(settings[name]), board) for name, make in TABULAR.items()}

    def rule():
        learners = _learners((*TABULAR, *DEEP), results, earned)
        return [claims.judge_alternatives(
            {name: (each.rate(*FINAL), each.seconds, SEES[name in DEEP]) for name, each in learners.items()},
            {name: earned[name].rate(*FINAL) for name in thesis}, earned[BROWNIAN].rate(*FINAL), 1 / FPS)]

    return judging.judge(rule, ran, wanted)


def untrained(control):
    """Claim A10 by the stored runs with defaults that last as long as Brownian motion, a list: see `judge`."""
    deep = stored(read(DEFAULTS), DEEP, PAPER_A.n_creeps, control.steps)

    def rule():
        return [claims.judge_untrained({name: each.rewards.sum(axis=1) for name, each in deep.items()}, control.totals)]

    return judging.judge(rule, control, Condition(brownian(), PAPER_A, STEPS, 1)) if deep else []


def _learners(names, results, earned):
    """Those that ran as long as Brownian motion, in as many runs as agents or enough: {name: `Earned`}."""
    steps, enough = results[BROWNIAN].steps, min(fewest_runs(*results.values()), RUNS_FOR_A_VERDICT)
    return {name: earned[name] for name in names
            if name in earned and earned[name].steps == steps and len(earned[name].rewards) >= enough}
