"""Clepsydra's Python: reads, checks, draws and evaluates cases of pimpleDemFoam."""

__version__ = "1.0.0"
