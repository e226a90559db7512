"""Threads of Qt."""
