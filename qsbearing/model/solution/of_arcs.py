"""Contacts of every arc of the grooves: of most bearings there is one arc in each ring, of four-point bearings more."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.bearing import BearingKind
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.of_cases import SolutionOfCases
from qsbearing.model.solution.raceway_contacts import OppositeContacts, RacewayContacts

if TYPE_CHECKING:
    from qsbearing.model.solution.moved import Moved


class SolutionOfArcs(SolutionOfCases):
    """What a solution says of its arcs, by what it knows of both raceways."""

    _moved: Moved | None
    scene: Scene
    displacement: Any

    @property
    def inner(self) -> RacewayContacts:
        """Contacts with the inner raceway."""
        raise NotImplementedError

    @property
    def outer(self) -> RacewayContacts:
        """Contacts with the outer raceway."""
        raise NotImplementedError

    @property
    def opposite(self) -> OppositeContacts | None:
        """Of a four-point bearing, the contacts of its other arcs; then `inner` and `outer` are those of the arcs for
        angles above zero, or of a ring's one arc. None of other bearings."""
        if self._moved is None or self._moved.opposite is None:
            return None
        return OppositeContacts(*(None if each is None else RacewayContacts(each.get) for each in self._moved.opposite))

    @property
    def arcs(self) -> tuple[RacewayContacts, ...]:
        """Contacts of every arc: those of both raceways, and of a four-point bearing the opposite ones."""
        return (self.inner, self.outer, *filter(None, self.opposite or ()))

    @property
    def arcs_of_rings(self) -> tuple[tuple[str, tuple[RacewayContacts, ...]], ...]:
        """The same of each ring, by its name."""
        others = self.opposite or (None, None)
        both = ("inner", self.inner, others[0]), ("outer", self.outer, others[1])
        return tuple((name, (first,) if other is None else (first, other)) for name, first, other in both)

    @property
    def inner_load(self) -> NDArray:
        """On each ball of the inner raceway: of a four-point bearing, the sum of its two contacts; shape
        (*cases, ball) [N]."""
        other = None if self.opposite is None else self.opposite.inner
        return self.inner.load if other is None else self.inner.load + np.nan_to_num(other.load)

    @property
    def axial_from_middle(self) -> Any:
        """Axial displacement from where the grooves of both rings lie in one plane; shape (*cases) [m].

        Of a deep-groove or four-point bearing, whose `displacement` counts from where its balls just touch one side.
        None of an angular-contact bearing, which has no middle.
        """
        scene = self.scene
        clearance = scene.bearing.axial_clearance
        if clearance is not None:
            return (self.displacement[..., 0] + 0.5 * clearance)[()]
        if scene.bearing.kind is not BearingKind.DEEP_GROOVE:
            return None
        to_middle = scene.operating_bearing.touching_offset - scene.axial_datum_shift
        return (self.displacement[..., 0] + to_middle)[()]
