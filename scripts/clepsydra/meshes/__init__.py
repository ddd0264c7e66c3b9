"""Generators of hopper meshes and surfaces; the commands are in meshes/."""
