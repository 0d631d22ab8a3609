"""The page "Performance": how fast the package is on the machine that computes the page.

Times are minima over several repetitions, and compared programs take turns, so that disturbances affect all alike.
Nothing here is judged as a claim: the numbers are those of one machine.
"""
