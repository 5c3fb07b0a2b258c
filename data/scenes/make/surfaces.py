"""Procedural surfaces that tile: bricks and planks as height, colour and roughness.

A surface is a function of (u, v) in the unit square, v up, which returns the height in texture
widths, the colour as sRGB and the roughness, both in 0..1.
Everything random is a hash of integers.
"""

import math


def hashed(*integers):
    """A number in [0, 1) for a tuple of integers."""
    state = 0x9E3779B9
    for value in integers:
        state ^= (value & 0xFFFFFFFF) * 0x85EBCA6B & 0xFFFFFFFF
        state = (state ^ state >> 15) * 0x2C1B3C6D & 0xFFFFFFFF
        state = (state ^ state >> 12) * 0x297A2D39 & 0xFFFFFFFF
        state ^= state >> 15
    return state / 4294967296.0


def smooth_step(low, high, x):
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


def mixed(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def noise(u, v, cells_u, cells_v, seed):
    """Value noise in [0, 1] that repeats with the unit square."""
    x, y = u * cells_u, v * cells_v
    i, j = math.floor(x), math.floor(y)
    s, t = smooth_step(0, 1, x - i), smooth_step(0, 1, y - j)

    def at(a, b):
        return hashed(a % cells_u, b % cells_v, seed)

    low = at(i, j) + (at(i + 1, j) - at(i, j)) * s
    high = at(i, j + 1) + (at(i + 1, j + 1) - at(i, j + 1)) * s
    return low + (high - low) * t


BRICK_ROWS, BRICKS_A_ROW = 8, 3
MORTAR = 0.055  # of a row's height, half the joint


def bricks(u, v):
    y = v * BRICK_ROWS
    row = math.floor(y)
    x = u * BRICKS_A_ROW + (0.5 if row % 2 else 0.0)
    column = math.floor(x) % BRICKS_A_ROW
    wobble = 0.03 * (noise(u, v, 24, 24, 1) - 0.5)
    across = min(x - math.floor(x), 1 - (x - math.floor(x))) * BRICK_ROWS / BRICKS_A_ROW + wobble
    along = min(y - row, 1 - (y - row)) + wobble
    inside = smooth_step(MORTAR, MORTAR + 0.10, min(across, along))
    tone, age = hashed(row, column, 2), hashed(row, column, 3)
    grain = noise(u, v, 40, 40, 4)
    patch = noise(u, v, 9, 9, 5)
    clay = mixed(mixed((0.55, 0.27, 0.20), (0.71, 0.40, 0.28), tone), (0.42, 0.25, 0.22), age * 0.6)
    clay = tuple(value * (0.88 + 0.10 * grain + 0.10 * patch) for value in clay)
    lime = tuple(value * (0.85 + 0.2 * patch) for value in (0.66, 0.62, 0.56))
    height = 0.010 * inside * (0.8 + 0.4 * tone) + 0.0022 * grain * inside + 0.0012 * patch
    return height, mixed(lime, clay, inside), 0.95 - 0.22 * inside * age


PLANKS = 6
GAP = 0.022  # of a plank's width, half the joint


def planks(u, v):
    y = v * PLANKS
    plank = math.floor(y)
    shift = hashed(plank, 11)
    x = u + shift
    half = math.floor(x * 2) % 2
    across = min(y - plank, 1 - (y - plank))
    end = abs(x * 2 - round(x * 2)) * PLANKS / 2
    inside = smooth_step(GAP, GAP + 0.05, min(across, end))
    tone = hashed(plank, half, 12)
    swing = 0.35 * noise(u, v, 3, PLANKS, 13) + 0.12 * noise(u, v, 7, PLANKS * 2, 14)
    phase = (y - plank) * 5.0 + 4.0 * swing + 7.0 * tone
    ring = 0.5 + 0.5 * math.sin(2 * math.pi * phase)
    fiber = noise(u, v, 10, 96, 15)
    wood = mixed((0.50, 0.33, 0.20), (0.66, 0.47, 0.30), tone)
    wood = mixed(wood, (0.36, 0.22, 0.13), 0.42 * ring * ring + 0.12 * fiber)
    color = mixed((0.10, 0.07, 0.05), wood, inside)
    height = 0.0050 * inside * (0.9 + 0.2 * tone) - 0.0006 * ring * inside - 0.0004 * fiber
    return height, color, 0.24 + 0.16 * ring * ring + 0.10 * fiber + 0.35 * (1 - inside)
