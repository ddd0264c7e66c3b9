# A floor that all particles fall through

include         DEM/in.bottomless
