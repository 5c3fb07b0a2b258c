"""Measured spectra to scene-linear Rec. 709.

Colour matching functions: the multi-lobe fits of Wyman, Sloan and Shirley, "Simple Analytic
Approximations to the CIE XYZ Color Matching Functions", JCGT 2(2), 2013, section 2.2. Illuminant
D65: the CIE's table at 10 nm. Spectra are linear between their samples.
"""

import math

FIRST, LAST, STEP = 400, 700, 1  # nm, the range of the measurements

D65 = [82.7549, 91.486, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923, 108.811,
       109.354, 107.802, 104.79, 107.689, 104.405, 104.046, 100.0, 96.3342, 95.788, 88.6856,
       90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213,
       71.6091]  # 400, 410, ... 700 nm

RGB_FROM_XYZ = [(3.2404542, -1.5371385, -0.4985314),
                (-0.9692660, 1.8760108, 0.0415560),
                (0.0556434, -0.2040259, 1.0572252)]


def _lobe(wavelength, peak, width_below, width_above):
    t = (wavelength - peak) / (width_below if wavelength < peak else width_above)
    return math.exp(-0.5 * t * t)


def matching_functions(wavelength):
    x = (1.056 * _lobe(wavelength, 599.8, 37.9, 31.0) + 0.362 * _lobe(wavelength, 442.0, 16.0, 26.7)
         - 0.065 * _lobe(wavelength, 501.1, 20.4, 26.2))
    y = 0.821 * _lobe(wavelength, 568.8, 46.9, 40.5) + 0.286 * _lobe(wavelength, 530.9, 16.3, 31.1)
    z = 1.217 * _lobe(wavelength, 437.0, 11.8, 36.0) + 0.681 * _lobe(wavelength, 459.0, 26.0, 13.8)
    return (x, y, z)


def sampled(values, wavelength):
    """`values` are equally spaced from FIRST to LAST."""
    position = (wavelength - FIRST) / (LAST - FIRST) * (len(values) - 1)
    i = min(int(position), len(values) - 2)
    return values[i] + (values[i + 1] - values[i]) * (position - i)


def _xyz(spectrum):
    """Integrals against the matching functions, in units of that of y."""
    total, unit = [0.0, 0.0, 0.0], 0.0
    for wavelength in range(FIRST, LAST + 1, STEP):
        weights = matching_functions(wavelength)
        unit += weights[1]
        for axis in range(3):
            total[axis] += weights[axis] * spectrum(wavelength)
    return [value / unit for value in total]


def _rgb(xyz):
    return [sum(row[axis] * xyz[axis] for axis in range(3)) for row in RGB_FROM_XYZ]


def radiance_rgb(values):
    """Of an emission spectrum in units of radiance: a constant spectrum of 1 has luminance 1."""
    return _rgb(_xyz(lambda wavelength: sampled(values, wavelength)))


def reflectance_rgb(values):
    """Under D65, where a perfect reflector is (1, 1, 1)."""
    colour = _rgb(_xyz(lambda wavelength: sampled(values, wavelength) * sampled(D65, wavelength)))
    white = _rgb(_xyz(lambda wavelength: sampled(D65, wavelength)))
    return [value / reference for value, reference in zip(colour, white)]
