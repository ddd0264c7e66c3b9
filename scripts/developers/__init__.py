"""Tools for those who change Clepsydra; the commands are in scripts/ and in this folder."""
