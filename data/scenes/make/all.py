"""Writes every scene again: python3 data/scenes/make/all.py (Python 3, standard library only)."""

import cornell_box
import cubes
import pixel_grid
import teapot
import textured_wall
import turntable

for scene in (cornell_box, cubes, pixel_grid, textured_wall, teapot, turntable):
    scene.main()
