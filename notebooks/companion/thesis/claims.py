"""The rules that judge the claims of the thesis by the book's numbers, written down before the numbers.

`companion.thesis.verdict` defines verdicts, and `companion.thesis.statements` lists the claims.
"""
# ruff: noqa: F401

from companion.thesis.rules_chapters import (judge_changes, judge_composition, judge_cost, judge_efficiency,
                                             judge_extension, judge_generality, judge_knowledge, judge_latent_learning,
                                             judge_more_maps, judge_pasts, judge_persistence, judge_real_time,
                                             judge_scaling, judge_tables, judge_temporality, judge_time_scale)
from companion.thesis.rules_papers import (judge_alternatives, judge_exploration, judge_joining, judge_margin,
                                           judge_modalities, judge_multiple_layers, judge_networks, judge_pace,
                                           judge_points, judge_resolutions, judge_several, judge_single_layer,
                                           judge_untrained)
from companion.thesis.verdict import RUNS_FOR_A_VERDICT, VERDICTS, Claim
