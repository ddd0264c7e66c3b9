"""Colours and lines that all pictures of runs share."""

PARTICLES = "YlOrRd"                # by speed: particles at rest are pale, not black
WATER = "Blues"                 # by speed
STREAMLINES = "tab:blue"
LINE, MARK = "tab:blue", "tab:red"
STEPS = {"dry": "tab:red", "submerged": "tab:blue"}
CELL, CELL_EDGE = "#edf2ff", "#404d66"
DPI = 130
