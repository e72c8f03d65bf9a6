"""Published and twice-computed numbers of B218 that both the reference and the package must meet."""

from __future__ import annotations

from typing import Any

import pytest


def printed(number: str, units: float = 0.5) -> Any:
    """A printed number: right to half a unit in its last place unless told otherwise."""
    mantissa, _, exponent = number.partition("e")
    decimals = len(mantissa.partition(".")[2])
    place = 10.0 ** (int(exponent or 0) - decimals)
    return pytest.approx(float(number), rel=1e-13, abs=(units + 1e-6) * place)  # and rounding of the comparison


# Fa N, rpm; alpha_i, alpha_o in degrees; Qi, Qo in N; axial displacement in um; axial stiffness in N/um.
THRUST_TABLE = [
    (2000, 0, "40.3633", "40.3633", "193.011", "193.011", "8.580", "352.7"),
    (2000, 6000, "56.5706", "13.9945", "149.779", "400.724", "-104.814", "19.17"),
    (2000, 10000, "58.8974", "4.7993", "145.986", "1091.631", "-175.518", "44.59"),
    (2000, 15000, "59.9217", "2.0430", "144.452", "2526.534", "-195.763", "97.22"),
    (8000, 10000, "55.5173", "19.5356", "606.578", "1208.277", "-57.387", "69.02"),
    (10000, 10000, "53.9996", "23.2540", "772.547", "1320.451", "-32.574", None),
    (17800, 0, "41.4932", "41.4932", "1679.168", "1679.168", "35.874", "769.7"),
    (17800, 10000, "49.9379", "31.3354", "1453.587", "1921.634", "14.700", "289.1"),
    (44500, 15000, "50.7469", "33.0313", "3591.682", "4622.030", "45.038", "600.0"),
]

# race, Rx mm, Ry mm, k, then Q N: (a mm, b mm, p0 MPa, approach um)
CONTACTS = [
    (-1, "9.602089", "250.6153", "8.155395", 1000.0, "1.738585", "0.213182", "1288.233", "8.397011"),
    (-1, "9.602089", "250.6153", "8.155395", 1679.168, "2.066462", "0.253386", "1531.179", "11.862808"),
    (1, "12.622911", "250.6153", "6.897520", 1000.0, "1.700768", "0.246577", "1138.529", "8.179344"),
    (1, "12.622911", "250.6153", "6.897520", 1679.168, "2.021513", "0.293078", "1353.242", "11.555301"),
]
