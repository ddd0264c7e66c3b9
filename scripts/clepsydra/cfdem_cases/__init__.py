"""Cases of CFDEMcoupling, read and rewritten: parts of scripts/importCfdem."""
