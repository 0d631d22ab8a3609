"""Modules that several chapters share."""
