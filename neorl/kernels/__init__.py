"""How kernels are compiled, cached and called, and told apart from others: the machinery around numba.

It knows nothing of agents. `neorl.kernels.kernel` says what a kernel is and may contain.
"""
