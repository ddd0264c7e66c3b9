"""Colours, lines and the drawing library that all pictures of runs share."""

import matplotlib.pyplot as pyplot

pyplot.switch_backend("Agg")  # no picture needs a display

PARTICLES = "YlOrRd"  # by speed: particles at rest are pale, not black
WATER = "Blues"  # by speed
STREAMLINES = "tab:blue"
LINE, MARK = "tab:blue", "tab:red"
STEPS = {"dry": "tab:red", "submerged": "tab:blue"}
CELL, CELL_EDGE = "#edf2ff", "#404d66"
DPI = 130
