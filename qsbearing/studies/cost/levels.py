"""The model levels, from the cheapest to the finest: the coarsest of everything, then one effect or choice finer at a
time, in the order of the list of effects. What needs parameters of its own is no level, and no hypothesis is one."""

from __future__ import annotations

from dataclasses import dataclass

from qsbearing.model.effects import EFFECTS
from qsbearing.model.scene.scene import Scene
from qsbearing.studies.chooser.choose import without


@dataclass(frozen=True)
class Level:
    """One model level: the first so many of the list, at their finest."""

    name: str
    """A key, in files: what it adds to the level before it."""
    text: str
    count: int

    def of(self, scene: Scene) -> Scene:
        """The scene's bearing and operation at this level, whatever effects and choices the scene names."""
        scene = without(scene, reversed(EFFECTS))
        for entry in EFFECTS[: self.count]:
            scene = scene if entry.hypothesis else entry.finer(scene)
        return scene


LEVELS = (
    Level("coarsest", "the coarsest of all", 0),
    *(
        Level(entry.name, f"+ {entry.what.partition(' (')[0]}", count)
        for count, entry in enumerate(EFFECTS, start=1)
        if not entry.needs and not entry.hypothesis
    ),
)
