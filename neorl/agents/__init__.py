"""Agents as data (nodes, desires, learning, policy), the papers' agents, and the arrays that kernels take of them."""
