"""What the page "Performance" measures, computes and draws: how fast the package is where the page runs.

Times are the least of several repetitions, and what is compared takes turns, so that both share what disturbs. Nothing
here is judged as a claim: the numbers are those of one machine.
"""
