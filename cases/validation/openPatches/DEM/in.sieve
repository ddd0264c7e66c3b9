# A floor that all beads fall through

include         DEM/in.bottomless
