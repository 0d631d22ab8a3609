"""The contestants of the page on alternatives, by name, what those earn that are not agents, and the claim on them."""

from lib.alternatives.controllers import PLANNED, nearest_green, pd, planner
from lib.alternatives.living import BOARDS, FPS, bins_of, identity, live
from lib.alternatives.search import DEEP, best_settings
from lib.alternatives.tabular_learners import TABULAR
from lib.shared import judging
from lib.shared.report import CALIBRATED, LETTER
from neorl import Condition, brownian, multimodal
from neorl.evidence import claims
from neorl.evidence.reading import PRIMES, TO_THE_LETTER, Reading, networks
from neorl.evidence.verdict import FINAL, RUNS_FOR_A_VERDICT, fewest_runs

INFORMED = {"nearest green": lambda gains: nearest_green(), "PD": pd, "planner": planner}  # given the physics
BROWNIAN = "Brownian motion"
N_CREEPS, STEPS = 3, 150_000  # of the board and the runs by which claim C5 is judged


def of_thesis(readings):
    """The thesis's agents under some readings, {name: `Reading`}: {"agent, reading": `Agent`}."""
    return {f"{agent}, {name}": made for name, each in readings.items() for agent, made in {
        "PC + OVC": multimodal(PRIMES, place_gain=each.place_gain, **each.agents),
        "network D": networks(each)["D"]}.items()}


def of_others(settings, board, steps, runs, seed):
    """What contestants that are not agents of neoRL earn on a board: {name: `Earned`}."""
    others = {name: make(settings[name]) for name, make in TABULAR.items()}
    others |= {name: make(settings["PD"]) for name, make in INFORMED.items()}
    length = {"planner": max(bins_of(steps), round(PLANNED * steps))}
    return {name: live(each, board, steps=length.get(name, steps), runs=runs, bins=bins_of(steps), seed=seed)
            for name, each in others.items()}


def judge(results, earned):
    """Claim C5 by what contestants earn on one board, a list: none unless they and the board are the page's own.

    Learners count that ran as long as the agents, in as many runs or enough for a verdict.
    results: {name: `Result`} of agents. earned: {name: `Earned`} of all.
    """
    thesis, board = of_thesis({LETTER: TO_THE_LETTER, CALIBRATED: Reading()}), BOARDS[N_CREEPS]
    wanted = {name: Condition(agent, board, STEPS, 1) for name, agent in {BROWNIAN: brownian(), **thesis}.items()}
    ran = results | {name: earned[name].identity for name in TABULAR if name in earned}
    settings = best_settings()
    wanted |= {name: identity(make(settings[name]), board) for name, make in TABULAR.items()}

    def rule():
        steps, enough = results[BROWNIAN].steps, min(fewest_runs(*results.values()), RUNS_FOR_A_VERDICT)
        learners = {name: earned[name] for name in (*TABULAR, *DEEP) if name in earned}
        return [claims.judge_alternatives(
            {name: (each.rate(*FINAL), each.seconds) for name, each in learners.items()
             if each.steps == steps and len(each.rewards) >= enough},
            {name: earned[name].rate(*FINAL) for name in thesis}, earned[BROWNIAN].rate(*FINAL), 1 / FPS)]

    return judging.judged(rule, ran, wanted)
