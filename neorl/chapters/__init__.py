"""Experiments, figures and sentences of the book's pages, a room per page; `shared` serves several.

A chapter's room may import from the rooms of the chapters before it and from every other room of `neorl`; none of those
imports from this one.
"""
