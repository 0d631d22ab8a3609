"""The verdicts on claims, beside the share of readings within the text that agree with them."""

from neorl.drawing.style import AGENT, SMALL, axes_or_new, width_of_figures

ROW = 0.26  # inches


def draw_standing(record, names):
    """The verdicts of claims, and the share of evenly drawn readings that agree at the papers' lengths, with counts."""
    axes = axes_or_new(None, figsize=(width_of_figures(), ROW * len(names) + 0.5))
    for row, name in enumerate(names):
        share = record["shares"].get(name, {})
        if share.get("measured"):
            axes.barh(row, share["agrees"] / share["measured"], 0.55, color=AGENT)
            axes.annotate(f"{share['agrees']} of {share['measured']}", (1, row), xytext=(9, 0),
                          textcoords="offset points", fontsize=SMALL, va="center")
        else:
            axes.text(0.01, row, "not varied over readings", fontsize=SMALL, va="center")
    verdicts = {name: record["claims"].get(name, {"verdict": "not computed"})["verdict"] for name in names}
    axes.set_yticks(range(len(names)), [f"{name}  {verdicts[name]}" for name in names], fontsize=10)
    axes.set_xticks([0, 0.5, 1], ["none", "half", "all readings"])
    axes.set(xlim=(0, 1), ylim=(len(names) - 0.4, -0.6))
    axes.tick_params(axis="y", length=0)
    axes.spines["left"].set_visible(False)
