#!/usr/bin/env python3
"""Prints the values that tests/diff/metrics_test.cpp expects, from implementations that are not ours:
NVIDIA's FLIP (flip-evaluator), scikit-image's SSIM, and PSNR and relMSE spelled out with numpy.

    pip install flip-evaluator==1.7 scikit-image==0.26.0
    python3 tests/diff/oracle.py
"""
import flip_evaluator
import numpy as np
from skimage.metrics import structural_similarity

WIDTH, HEIGHT = 300, 80
Y, X, C = np.meshgrid(np.arange(HEIGHT), np.arange(WIDTH), np.arange(3), indexing="ij")


def noise(x, y, c):
    h = ((x * 73856093) ^ (y * 19349663) ^ ((c + 1) * 83492791)) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((h >> 16) & 255) / 255.0


def base(x, y, c):
    return ((x * (5 + c) + y * (3 + 2 * c)) % 64) / 128.0 + noise(x // 8, y // 8, c) / 2


def distorted(kind, x, y, c):
    v = base(x, y, c)
    if kind == 0: return v + 0.02
    if kind == 1: return v * 0.8
    if kind == 2: return v + 0.2 * (noise(x, y, c + 7) - 0.5)
    if kind == 3: return base(x + 1, y, c)
    if kind == 4: return base(x, y, (c + 1) % 3)
    if kind == 5: return (base(x, y, c) + base(x + 1, y, c) + base(x, y + 1, c) + base(x + 1, y + 1, c)) / 4
    if kind == 6: return np.where((x >= 250) & (x < 262) & (y >= 60) & (y < 70), 1.0, v)
    if kind == 7: return 1 - v
    if kind == 8: return np.floor(v * 8) / 8
    return (v - 0.5) * 1.5 + 0.5


def coded(linear):
    x = np.clip(linear, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


for hdr in (False, True):
    for kind in range(10):
        a, b = np.clip(base(X, Y, C), 0, 1), np.clip(distorted(kind, X, Y, C), 0, 1)
        if hdr:
            a, b = (20 * a**4).astype(np.float32), (20 * b**4).astype(np.float32)
        else:
            a, b = np.floor(a * 255 + 0.5) / 255, np.floor(b * 255 + 0.5) / 255
        ca, cb = (coded(a.astype(float)), coded(b.astype(float))) if hdr else (a, b)
        f32 = lambda image: np.ascontiguousarray(image, dtype=np.float32)
        flip = flip_evaluator.evaluate(f32(ca), f32(cb), "LDR")[1]
        hdr_flip = flip_evaluator.evaluate(f32(a), f32(b), "HDR")[1] if hdr else -1
        ssim = structural_similarity(ca, cb, channel_axis=2, gaussian_weights=True, sigma=1.5,
                                     use_sample_covariance=False, data_range=1)
        psnr = -10 * np.log10(np.mean((ca - cb) ** 2))
        d = a.astype(float) - b.astype(float)
        relmse = np.mean(d**2 / (a.astype(float) ** 2 + 0.01))
        print(f"    {{{str(hdr).lower()}, {kind}, {flip:.6f}, {hdr_flip:.6f}, {ssim:.6f}, {psnr:.5f}, {relmse:.8f}}},")
