"""Sentences and tables on the errors and the knowledge of animals in the maze."""

import numpy as np

from lib.chapter_2.latent_learning import FIRST_REWARD, LEARNERS
from lib.shared import wording


def in_short(by_learner, claim):
    """What the maze shows of latent learning, in three sentences.

    by_learner: {learner: {group: `Record`}}. claim: on demonstration H1.
    """
    drops = [(name, by_learner[name]["delayed"].errors.mean(axis=0)) for name in LEARNERS]
    (first, errors), *others = ((name, [f"{daily[day]:.1f}" for day in (FIRST_REWARD - 1, FIRST_REWARD)])
                                for name, daily in drops)
    also = " and ".join(f"from {before} to {after} with {name}" for name, (before, after) in others)
    verdict = {"reproduced": "they overtake, since it lies below 0",
               "partly": "they draw level but do not overtake, which takes an interval below 0",
               }.get(claim.verdict, "they overtake if the whole interval lies below 0")
    return (f"In Tolman and Honzik's maze of 1930, rats that first found food on day {FIRST_REWARD} overtook rats fed "
            f"throughout. Simulated animals go from {errors[0]} errors on that day to {errors[1]} on the next if they "
            f"learn as the thesis proposes ({first}); two standard kinds of learner go {also}. From then on the errors "
            f"per day of the {first} animals, less those of animals fed throughout, are {claim.here}, with the 95 % "
            f"interval in brackets: {verdict}.")


def describe_errors(by_learner):
    """Errors before and after a first meal, late and early, and on the first day: {learner: {group: `Record`}}."""
    errors = {learner: {group: record.errors.mean(axis=0) for group, record in groups.items()}
              for learner, groups in by_learner.items()}
    drops = ", ".join(f"from {errors[name]['delayed'][FIRST_REWARD - 1]:.1f} to "
                      f"{errors[name]['delayed'][FIRST_REWARD]:.1f} ({name})" for name in LEARNERS)
    neorl, sarsa = errors["neoRL"], errors["Sarsa(λ)"]
    return (f"From day {FIRST_REWARD}, on which it first finds food, to day {FIRST_REWARD + 1} the errors of the "
            f"delayed group go {drops}. On day 2, after as much food, the group fed throughout makes "
            f"{neorl['throughout'][1]:.1f} (neoRL) and {sarsa['throughout'][1]:.1f} (Sarsa(λ)). On the very "
            f"first day Sarsa(λ) makes {sarsa['never'][0]:.1f} errors where a random walk makes "
            f"{neorl['never'][0]:.1f}, since it prefers untried actions; after that day no action is untried.")


def findings_table(found):
    """Which of the original's findings each kind of animal shows, as a Markdown table: {learner: {name: `Finding`}}."""
    rows = [[row[0].text, *(f"**{'yes' if each.holds else 'no'}** {each.here}" for each in row)]
            for row in zip(*(findings.values() for findings in found.values()))]
    return wording.table(["", *found], rows)


def describe_findings(found):
    """Which kinds of animal show the findings that a map would explain: {learner: {name: `Finding`}}."""
    level, one_meal, below, never = (
        " and ".join(name for name in found if found[name][key].holds) or "none of the three"
        for key in ("level", "one meal", "below", "never"))
    return (f"The delayed group is level with the group fed throughout right after its first food with {level}. With "
            f"{one_meal} this is due to latent learning, not to quick learning. It overtakes with {below}. The "
            f"unrewarded group improves without food with {never}.")


def describe_known(by_learner, units):
    """The knowledge of the delayed groups before they find food: {learner: {group: `Record`}}. units: of the maze."""
    neorl, q_learning, sarsa = (by_learner[name]["delayed"].known[:, FIRST_REWARD - 2].mean() * units
                                for name in LEARNERS)
    same = np.array_equal(by_learner["neoRL"]["delayed"].known, by_learner["neoRL"]["throughout"].known)
    fed = ("With neoRL this equals the knowledge of the group fed throughout, on each day and in every animal, so the "
           "delayed group draws level and does not overtake" if same else
           "With neoRL the group fed throughout does not know quite the same")
    return (f"On the evening of day {FIRST_REWARD - 1}, before it has found any food, the delayed group knows the way "
            f"to the food box at {neorl:.1f} of {units} choice points with neoRL, at {q_learning:.1f} with Q-learning "
            f"and at {sarsa:.1f} with Sarsa(λ). {fed}: in a maze with one way out and one-way doors, every animal "
            f"passes every choice point once a day, hungry or not, and its knowledge of the food box spreads back by "
            f"one place each time. Time in blind alleys teaches only about blind alleys.")


def describe_settings(rows, judged, worth):
    """How the verdict on H1 and two findings depend on the settings.

    rows, judged: what `lib.chapter_2.latent_settings.vary` finds. worth: errors per day that food saves.
    """
    below, one_meal = zip(*(row["neoRL"] for row in rows.values()))
    leads = [lead.value for lead in below]
    span = f"{min(leads):z.2f} and {max(leads):z.2f}".replace("-", "−")
    level = sum(lead.low <= 0 <= lead.high for lead in below)
    rivals = [f"{name} with {setting}" for setting, row in rows.items() for name in LEARNERS[1:]
              if row[name][1].high < 0]
    reproduced = "reproduced" in [claim.verdict for claim in judged.values()]
    luck = (". Even between equal groups, about one interval in forty lies below 0"
            if reproduced else "")
    return (f"On days 12 to 17, the errors of the neoRL animals fed late, less those of the group fed throughout, lie "
            f"between {span} per day; never being fed costs {worth:.1f} errors per day. In {level} of {len(rows)} "
            f"settings the interval contains 0. The verdict on H1 also requires that day 12 alone shows them level, "
            f"which takes many animals. It is {_by_verdict(judged)}{luck}. After one meal each, the neoRL animals fed "
            f"late are ahead in {sum(each.high < 0 for each in one_meal)} settings. Other learners are ahead in "
            + (f"these cases: {' and '.join(rivals)}." if rivals else "none."))


def describe_verdict(claim):
    """What the verdict on H1 shows, in a sentence or two; nothing where there is none."""
    return {"reproduced": "Here the interval lies below 0. Yet both groups have the same knowledge on each day, so "
                          "this can only be chance; the settings above have other animals. ",
            "partly": "Their knowledge brings the animals level with the group fed throughout, and no further. ",
            "not reproduced": "With this number of animals, level cannot be distinguished from slightly behind. "
            }.get(claim.verdict, "")


def describe_first_meals(errors):
    """Errors on the day of a first meal and on the next, a line for each day: {day: (errors, errors)}."""
    return "\n".join(f"first meal on day {day}: {fed:.1f} errors that day, {after:.1f} on the next"
                     for day, (fed, after) in errors.items())


def _by_verdict(judged):
    """The number of settings with each verdict, and their names except for the most frequent one."""
    outcomes = {}
    for setting, claim in judged.items():
        outcomes.setdefault(claim.verdict, []).append(setting)
    usual = max(outcomes, key=lambda verdict: (len(outcomes[verdict]), verdict))
    return "; ".join(f"*{verdict}* in {len(where)}" + (f" ({', '.join(where)})" if verdict != usual else "")
                     for verdict, where in outcomes.items())
