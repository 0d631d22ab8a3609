"""What the notebooks of the chapters and papers run and draw, a room each, and what they share.

A chapter's room may use the rooms of the chapters before it, and every other room of `neorl`; none of those uses this
one.
"""
