"""What neoRL stands on: small experiments that chapters 1 to 5 of the book run.

Each module holds one idea, told in its first lines. None of them takes part in a run in WaterWorld.
"""
