"""The rules by which the numbers here decide the claims of the thesis, written down before the numbers.

`neorl.verdict` says what a verdict is, and `neorl.statements` what is claimed. The rules stand in
`neorl.rules_paper_a`, `neorl.rules_paper_b`, `neorl.rules_paper_c` and `neorl.rules_chapters`; this module gathers them
under one name.
"""

from neorl.rules_chapters import (judge_changes, judge_cost, judge_latent_learning, judge_more_maps, judge_persistence,
                                  judge_real_time, judge_tables, judge_temporality, judge_time_scale)
from neorl.rules_paper_a import judge_multiple_layers, judge_single_layer
from neorl.rules_paper_b import judge_joining, judge_modalities, judge_pace, judge_points, judge_resolutions
from neorl.rules_paper_c import judge_networks
from neorl.verdict import EARLY, FINAL, RUNS_FOR_A_VERDICT, VERDICTS, Claim

__all__ = ["EARLY", "FINAL", "RUNS_FOR_A_VERDICT", "VERDICTS", "Claim", "judge_changes", "judge_cost", "judge_joining",
           "judge_latent_learning", "judge_modalities", "judge_more_maps", "judge_multiple_layers", "judge_networks",
           "judge_pace", "judge_persistence", "judge_points", "judge_real_time", "judge_resolutions",
           "judge_single_layer", "judge_tables", "judge_temporality", "judge_time_scale"]
