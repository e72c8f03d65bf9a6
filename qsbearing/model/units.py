"""Units as factors: multiply on the way in, divide on the way out.

Everything inside is SI and radians, so `22.225 * mm` is a length in metres and
`speed / rpm` reads a speed in revolutions per minute.
"""

from math import pi

m = 1.0
mm = 1e-3
um = 1e-6

rad = 1.0
mrad = 1e-3
deg = pi / 180.0

rpm = 2.0 * pi / 60.0

N = 1.0
kN = 1e3  # noqa: N816
Nm = 1.0
Nmm = 1e-3

Pa = 1.0
MPa = 1e6
GPa = 1e9

kg = 1.0
kg_m3 = 1.0

zero_celsius = 273.15
"""Temperatures are in kelvin: add this to degrees Celsius, `60 + qs.zero_celsius`."""
