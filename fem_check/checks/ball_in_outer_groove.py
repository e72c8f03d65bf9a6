"""Does the finite-element contact of a ball and its outer groove, as half-spaces, agree with Hertz at real loads?"""

from functools import partial

from fem_check.checks import groove_contacts
from fem_check.rows.agreement import Check, Kind

CHECK = Check(
    name="ball_in_outer_groove",
    question="Outer raceway, half-spaces: do finite elements give Hertz's contact at real loads?",
    kind=Kind.VERIFICATION,
    reference="Hertz in closed form, exact for this idealised problem",
    tolerance="quick 0.3 %; release 0.02 % approach, 0.05 % semi-axes, pressure and shear",
    run=partial(groove_contacts.run, "outer"),
    largest_dofs=groove_contacts.largest_dofs,
)
