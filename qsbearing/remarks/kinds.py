"""Every remark that there is: its code, how much it matters, where the guide says more, and its sentence.

Codes stand in JSON and in the guide (guide/remarks.md): they are never renamed. A sentence is a format string over the
remark's values, which are in the units of their names, over whom it is about, {who}, {raceways}, {balls}, and over a
field in the words of whoever reads it: {field}.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import IntEnum
from string import Formatter
from typing import Any

import numpy as np

from qsbearing.documents.numbers import plain
from qsbearing.model.effects import EFFECTS, Entry
from qsbearing.model.solution.judgement import ANOTHER_RESULT, WORDS, changed, estimated, shifted, unit_of
from qsbearing.model.validation import Field, Setting
from qsbearing.remarks.wording import Audience, Raceways, Words, listed, spanned


class Severity(IntEnum):
    """How much a remark matters, what matters most first."""

    WRONG_MODEL = 1
    """The numbers do not describe this case: an equation is used beyond its range."""
    INCOMPLETE_MODEL = 2
    """The numbers would change with an effect that the model does not include."""
    CHECK_DATA = 3
    """The numbers describe what is given, which is unusual: a slip of input, or a design that does not work."""
    GOOD_TO_KNOW = 4
    """The numbers hold; they need a word."""

    @property
    def words(self) -> str:
        """As people read it."""
        return self.name.replace("_", " ").capitalize() if self is not Severity.CHECK_DATA else "Check your data"

    @property
    def status(self) -> str:
        """Of a remark in a document."""
        return "note" if self is Severity.GOOD_TO_KNOW else "warning"


WRONG, INCOMPLETE, CHECK, NOTE = Severity

_NO_FIELD = Field()
STATUSES, HEAT = "how_to#meaning-of-each-status", "how_to#heat-fits-and-rotation"
HYPOTHESES, AXIS, CHOICES = "limits#hypotheses", "ball_axis", "readings#choices-that-change-the-numbers"
PRELOAD, RINGS = "sets#preload", "elastic_rings"


@dataclass(frozen=True)
class Kind:
    """All remarks of one code."""

    code: str
    severity: Severity
    see: str
    """Page of the guide, and its section behind a #."""
    sentence: str
    """A format string."""
    more: str = ""
    """A second one, of remarks that have its values."""
    say: Callable[[Mapping[str, Any], Words], str] | None = None
    """What makes the sentence where a format string cannot."""
    field: Field = _NO_FIELD
    """What to give, {field} in the sentence."""

    def text(self, values: Mapping[str, Any], words: Words, path: str = "") -> str:
        """The sentence with these in it, and fields in somebody's words.

        Args:
            path: of a field beside those that it names.
        """
        if self.say is not None:
            return self.say(values, words)
        more = self.more if all(name in values for name in _fields(self.more)) else ""
        return _IN_WORDS.vformat(self.sentence + more, (), {**values, "field": words.spell(self.field, path)})

    def outline(self, words: Words) -> str:
        """The sentence with … for each number."""
        blank = _Blank(who="the bearing", raceways=Raceways(("…",)), field=words.spell(self.field, ""))
        return (self.sentence + self.more).format_map(blank)

    @property
    def values(self) -> tuple[str, ...]:
        """What remarks of this kind have beside whom they are about."""
        return tuple(name for name in _fields(self.sentence + self.more) if name not in BESIDE)


class _Blank(dict[str, Any]):
    """Stands for each number of a sentence."""

    def __missing__(self, name: str) -> _Blank:
        return self

    def __format__(self, spec: str) -> str:
        return f"… balls {spec.partition('/')[2]}" if "/" in spec else "…"


class _InWords(Formatter):
    """Of numbers without powers of ten."""

    def format_field(self, value: Any, spec: str) -> str:
        return plain(value, spec) if isinstance(value, float | int) and spec else format(value, spec)


_IN_WORDS = _InWords()


def _fields(sentence: str) -> list[str]:
    return list(dict.fromkeys(name for _, name, *_ in Formatter().parse(sentence) if name))


def to_add(settings: Sequence[Setting], words: Words) -> str:
    """What to do for effects that could be named as it is."""
    return _ADD[words.reader].format(", ".join(words.spell(each, "") for each in settings))


def _missing(fields: Mapping[str, Any], words: Words) -> str:
    """Effects that could be named as it is, and what each would change."""
    moved = iter(fields.get("displacements_um", ()))
    said = [
        f"{EFFECT[name].what} ({_of_quantity(quantity, _changes(fields, quantity, change, moved))})"
        for name, quantity, change in zip(fields["effects"], fields["quantities"], fields["changes"], strict=True)
    ]
    are = "is" if len(said) == 1 else "are"
    return f"{listed(said)} {are} not included. {to_add(fields['add'], words)}"


def needed(entry: Entry, has_size: bool, words: Words) -> str:
    """What to give for an effect that needs numbers of the scene: in a file not what its bearing has."""
    beside = entry.needs_beside_size if has_size and words.reader is not Audience.PYTHON else ""
    return words.of(beside or entry.needs)


def _lacking(fields: Mapping[str, Any], words: Words) -> str:
    """An effect that needs numbers of the scene: what it would change, and what to give."""
    entry, quantity = EFFECT[fields["effect"]], fields["quantity"]
    changes = _changes(fields, quantity, fields["changes"], iter(fields.get("displacements_um", ())), MORE)
    by = [f"{change}{f' ({under})' * bool(under)}" for change, under in zip(changes, fields["under"], strict=True)]
    begun = entry.without_it or f"{entry.what} is not included; it"
    change = _of_quantity(quantity, by if len(set(changes)) > 1 else changes[:1], BY)
    needs = needed(entry, bool(fields.get("has_size")), words)
    return f"{begun} would change the {change}. To include it, {_ADVICE[words.reader]} {needs}"


def _differing(fields: Mapping[str, Any], words: Words) -> str:
    """What displacement and stiffness are by all hypotheses, and how to see each."""
    said = [
        f"{fields[name]} is {fields[f'{name}_least']:.4g} to {fields[f'{name}_most']:.4g} {fields[f'{name}_unit']} "
        f"(here {fields[f'{name}_here']:.4g})"
        for name in ("displacement", "stiffness")
        if name in fields and _largest(fields[f"{name}_most"]) > _largest(fields[f"{name}_least"])
    ]
    return f"{_DIFFERING} {' and the '.join(said)}. {_LIST[words.reader]}"


def _pressing(fields: Mapping[str, Any], words: Words) -> str:
    """Rows that press each other, and what to write so that one of them slides."""
    said = KINDS["rows_press"].sentence.format_map(fields)
    written = {Audience.PYTHON: ': carries="none"', Audience.FILE: ': carries = "none"'}
    return f"{said}{written.get(words.reader, '')}."


def _cut(fields: Mapping[str, Any], words: Words) -> str:
    """A contact cut by the edge, with as many of its numbers as there are."""
    said = f"the ellipse of {fields['raceways']:an} contact runs over the groove's edge"
    if "beyond_percent" not in fields:
        return f"{said}: pressure there exceeds Hertz's"
    written = lambda name: _IN_WORDS.format_field(fields[name], ".2g")  # noqa: E731
    said += f", with {written('beyond_percent')} % of its major axis: "
    is_small = "turn_deg" not in fields
    if _largest(fields["beyond_percent"]) >= 10.0:
        said += "it is no longer Hertz's contact; " + "most of it is beyond the edge" * is_small
    elif is_small:
        return f"{said}load and angle hold, and the pressure rises at the edge"
    if not is_small:
        said += (
            f"at the same approach it carries {written('load_loss_percent')} % less load, which acts "
            f"{written('turn_deg')} deg farther from the edge; "
        )
        if "edge_pressure_MPa" not in fields:
            return f"{said}at a sharp edge the pressure has no limit"
        pressure = fields["edge_pressure_MPa"]
        above = "above " if _largest(pressure) >= fields["limit_MPa"] else ""
        said += f"the pressure at the edge is {above}{pressure:.0f} MPa"
    return said


def _largest(number: Any) -> float:
    return float(np.max(number))


MORE, BY = "more than 100", " by "
"""`ANOTHER_RESULT` in a sentence, and what then stands between a quantity and its change."""


def _changes(
    fields: Mapping[str, Any], quantity: str, changes: Sequence[Any], moved: Iterator[Any], more: str = ANOTHER_RESULT
) -> list[str]:
    """Changes of a quantity, each of which may be a `Span`: in its own unit where solved, else relative ones."""
    if quantity == "displacement" and not fields["is_estimated"]:
        return [f"{spanned(shifted, next(moved))} {unit_of(quantity)}" for _ in changes]
    number = estimated if fields["is_estimated"] else changed
    return [f"{spanned(lambda each: more if each > 1.0 else number(each, ''), change)} %" for change in changes]


def _of_quantity(quantity: str, by: Sequence[str], link: str = " ") -> str:
    """What changes most, and by how much."""
    if not quantity:
        return "result: no solution is found with it"
    said = " to ".join(by)
    is_about = link == BY and not said.startswith(("≈", MORE, "0 "))
    return f"{WORDS[quantity]}{link}{'about ' * is_about}{said}"


EFFECT = {entry.name: entry for entry in EFFECTS}
BESIDE = ("who", "raceways", "balls", "field")
"""What sentences have beside the values of a remark."""
_ADD = {
    Audience.PYTHON: "Set {}",
    Audience.FILE: "Add under [effects]: {}",
    Audience.PAGE: "Tick what is missing in the table of effects",
}
_ADVICE = {Audience.PYTHON: "give", Audience.FILE: "give", Audience.PAGE: "open a scene file that gives"}
_DIFFERING = "Raceway control is a hypothesis. By all hypotheses that have a solution, the"
_LIST = {
    Audience.PYTHON: "To see each: qsbearing explain FILE",
    Audience.FILE: "To see each: qsbearing explain FILE",
    Audience.PAGE: "The table of effects has the range",
}
_ENDED = ", a limit of practice; wear or the lubricant will"
_YIELDING = (
    " Steel with a yield strength of {yield_strength_MPa:.5g} MPa begins to yield below the surface near "
    "{first_yield_MPa:g} MPa."
)
_FRICTION = (
    "The gyroscopic moment requires a friction coefficient of {required:.2f} at {raceways:the} raceway of {balls}: "
)
_TYPICAL = " (typical: {typical_least:g} to {typical_most:g})."
_GROOVES = "ISO 281's ratings hold for grooves up to f = 0.52 inside and 0.53 outside, of thrust bearings 0.54"

# fmt: off
_ALL = (
    # The ring
    Kind("ring_unloaded", CHECK, STATUSES,
         "No load acts on the ring: its position is undetermined, and one of many is reported."),
    Kind("ring_free", CHECK, STATUSES,
         "Nothing resists a displacement of the ring in {channels}: the value reported for it is arbitrary."),
    Kind("raceways_separated", CHECK, "how_to#preload-of-one-bearing",
         "No axial load keeps the raceways together: the ring has moved axially by {axial_displacement_um:.4g} µm, "
         "until the contact angles are zero."),
    Kind("tilt_large", WRONG, "limits",
         "The ring tilts by {tilt_mrad:.0f} mrad: beyond the small rotations that the model assumes."),
    # Balls
    Kind("control_inconsistent", WRONG, HYPOTHESES,
         "No consistent raceway control: for some ball, whichever raceway is assumed to control it, the loads point "
         "to the other one. The last choice tried is reported."),
    Kind("balls_unloaded", NOTE, "limits", "{balls:carries/carry} no load."),
    Kind("balls_off_inner", NOTE, "limits",
         "{balls:has/have} left the inner raceway: only the outer raceway carries load there."),
    Kind("balls_slip", WRONG, HYPOTHESES,
         "{balls:slips/slip}: the gyroscopic moment requires a friction coefficient of {required:.3g}, and the "
         "contacts have {given:.3g}. The ball speeds reported are those without slip."),
    Kind("friction_doubtful", NOTE, HYPOTHESES, f"{_FRICTION}slip may begin{_TYPICAL}"),
    Kind("friction_beyond", WRONG, HYPOTHESES, f"{_FRICTION}expect slip{_TYPICAL}"),
    Kind("friction_above_load", WRONG, HYPOTHESES,
         f"{_FRICTION}friction, not the contact, carries the load there, so that the ball slips{_TYPICAL}"),
    Kind("momentum_gap", INCOMPLETE, "limits#balls-that-cannot-follow-the-azimuth",
         "The outer ring takes {outer_N:.4g} N for a radial load of {inner_N:.4g} N on the inner ring: balls cannot "
         "follow the azimuth. Radial stiffness is that against a load that turns with the cage."),
    Kind("friction_assumed", NOTE, AXIS, "The friction coefficient of {assumed:g} that moves the balls is assumed."),
    Kind("axis_creeps", NOTE, AXIS,
         "Outer control would ask for {asked_percent:.0f} % of the contacts' friction: above 50 % balls creep, above "
         "100 % they slip, and hypotheses of raceway control err."),
    Kind("balls_near_skidding", CHECK, AXIS,
         "Drag is {used_percent:.0f} % of what drives the balls: at half the load they may skid."),
    Kind("pressure_dents", WRONG, "limits",
         "The contact pressure reaches {pressure_MPa:.0f} MPa, above ISO 76's static limit of {limit_MPa:.0f} MPa: "
         "expect permanent dents.", _YIELDING),
    Kind("pressure_yields", NOTE, "limits",
         "The contact pressure reaches {pressure_MPa:.0f} MPa, below ISO 76's static limit of {limit_MPa:.0f} MPa.",
         _YIELDING),
    Kind("balls_sparse", CHECK, "ten_minutes#2-write-your-own",
         "The balls fill {filled_percent:.2g} % of the pitch circle; 59 to 90 % is usual. Are ball count, ball "
         "diameter and pitch diameter right?"),
    # Rings that grow or bend
    Kind("balls_wedged", CHECK, HEAT,
         "The expansion is larger than the diametral clearance by {interference_um:.4g} µm: the balls are wedged "
         "between the rings."),
    Kind("clearance_negative", CHECK, HEAT,
         "The clearance is negative by {interference_um:.4g} µm: the balls are wedged between the rings."),
    Kind("ring_yields", WRONG, HEAT,
         "The stress of {raceways:the} ring is {stress_MPa:.4g} MPa at its bore, above its yield strength of "
         "{yield_strength_MPa:.5g} MPa."),
    Kind("fit_lost", CHECK, HEAT,
         "The fit of {raceways:the} ring is lost in operation: mounted with an interference of {interference_um:.4g} "
         "µm, it has a diametral clearance of {clearance_um:.4g} µm to the {seat}."),
    Kind("seat_parts", CHECK, RINGS,
         "{raceways:The} ring would lift off the {seat} in places, unless the seat pressure of its fit were "
         "{pressure_MPa:.3g} MPa larger: there it deflects more than computed."),
    Kind("seat_touches", CHECK, RINGS,
         "{raceways:The} ring has clearance to the {seat} on average, but bends so far that it touches the {seat} in "
         "places: there it deflects less than computed."),
    Kind("ring_bends_far", WRONG, RINGS,
         "The bending of {raceways:the} ring is {deflection_over_thickness:.2g} times its thickness, too much for "
         "small-deflection theory."),
    Kind("expansion_far", CHECK, HEAT,
         "Far from room temperature ({parts}: {temperature_C:.4g} °C), this program's coefficients of expansion do not "
         "hold. From {least_C:.4g} to {most_C:.4g} °C they are within 10 % of the mean between 20 °C and there; below "
         "they are too large (of steel 1.4 times at -196 °C, 1.7 times at -253 °C), above too small. Give the material "
         "as a table, with thermal_expansion_per_K = its mean from the reference temperature to there."),
    # Preload
    Kind("preload_lost", CHECK, PRELOAD,
         "Preload lost: {who} carries {carried_N:.4g} N in operation; its preload is {given_N:.4g} N {state}."),
    Kind("preload_reduced", CHECK, PRELOAD,
         "Preload reduced: {cause} {who} only {carried_N:.4g} N of its preload of {given_N:.4g} N {state} "
         "({share_percent:.3g} %); its axial stiffness {stiffness_went} from {stiffness_mounted_N_per_um:.4g} N/µm "
         "mounted to {stiffness_N_per_um:.4g} N/µm."),
    Kind("preload_excessive", CHECK, PRELOAD,
         "Preload excessive: {who} is pressed by {unmounted_N:.4g} N before fitting, {mounted_N:.4g} N mounted and "
         "{in_operation_N:.4g} N in operation without external loads: more than {limit:g} times the given preload of "
         "{given_N:.4g} N."),
    Kind("rows_press", CHECK, "locating",
         "The rows press each other axially with {pressed_N:.4g} N, which no load and no preload asks for: the outer "
         "ring of each is held on the side to which it is pushed. Let row {slides} slide", say=_pressing),
    Kind("axially_free", CHECK, "locating",
         "Nothing holds the shaft along x where it is.", " It lies amid its play of {play_um:.4g} µm."),
    Kind("stiffness_undetermined", WRONG, HYPOTHESES,
         "No stiffness: in a row, no raceway control is consistent, and several solutions exist."),
    # The model
    Kind("effects_missing", INCOMPLETE, "accuracy",
         "{effects} ({quantities} {changes}) are not included. Add under [effects]: {add}", say=_missing),
    Kind("effect_data_missing", INCOMPLETE, "accuracy",
         "{effect} is not included; it would change the {quantity} by about {changes} ({under}). To include it, give "
         "its numbers", say=_lacking),
    Kind("hypotheses_differ", INCOMPLETE, HYPOTHESES,
         f"{_DIFFERING} {{displacement}} is {{displacement_least:.4g}} to {{displacement_most:.4g}} "
         "{displacement_unit} (here {displacement_here:.4g}) and the {stiffness} is {stiffness_least:.4g} to "
         "{stiffness_most:.4g} {stiffness_unit} (here {stiffness_here:.4g}). To see each: qsbearing explain FILE",
         say=_differing),
    # Readings: life
    Kind("life_of_ceramic", NOTE, CHOICES,
         "the dynamic rating and the life modification factor of ceramic balls are those of steel balls"),
    Kind("life_dents", WRONG, "limits",
         "the pressure of a contact is above {limit_MPa:.0f} MPa: permanent dents, and the rating life is not valid"),
    Kind("life_grooves_uncovered", WRONG, CHOICES,
         f'{_GROOVES}: a wider groove carries less ({{field}} takes the grooves into account)',
         field=Setting("rating", "lundberg_palmgren")),
    Kind("life_size_uncovered", WRONG, CHOICES,
         "ISO 281's table of fc covers D cos(alpha)/dm from 0.01 to 0.40"),
    Kind("life_viscosity_low", WRONG, CHOICES, "aISO is not defined below kappa = {limit:g}"),
    Kind("life_viscosity_high", NOTE, CHOICES, "kappa above {limit:g} counts as {limit:g} in aISO"),
    Kind("life_thrust_uncovered", WRONG, CHOICES,
         "ISO 281 has no P of a thrust bearing with less axial load than 1.25 tan(alpha) of the radial one: no L10"),
    Kind("life_factor_large", NOTE, CHOICES, f"fatigue will not end this bearing: aISO is beyond {{limit:g}}{_ENDED}"),
    Kind("life_factor_capped", NOTE, CHOICES,
         "aISO is at the upper limit of ISO 281, {limit:g}: the modified life is not a prediction"),
    Kind("life_long", NOTE, CHOICES,
         f"fatigue will not end this bearing: {{life_h:,.0f}} h is beyond {{limit_h:,.0f}} h{_ENDED}"),
    # Readings: static safety, stress, overrun
    Kind("static_dents", WRONG, "limits",
         "the pressure of a contact is above {limit_MPa:.0f} MPa: permanent dents, and the contact is no longer "
         "elastic"),
    Kind("static_moment", WRONG, CHOICES,
         "the ring carries a moment, which P0 of ISO 76 does not include; contact_safety does"),
    Kind("static_thrust_uncovered", WRONG, CHOICES,
         "P0 of a thrust bearing holds for radial loads up to 0.67 cot(alpha) of the axial one"),
    Kind("static_of_ceramic", NOTE, "readings#not-included",
         "ceramic balls are judged by {limit_MPa:.0f} MPa like steel ones; ISO 20056-2 allows more"),
    Kind("dent_noticeable", NOTE, "limits",
         "the dent of {raceways:an} contact is deeper than {limit:g} of the ball's diameter"),
    Kind("dent_of_ceramic", NOTE, CHOICES,
         "dents were measured on steel; ceramic balls keep their shape, the raceway alone yields"),
    Kind("ellipse_cut", WRONG, "limits",
         "the ellipse of {raceways:an} contact runs over the groove's edge, with {beyond_percent:.2g} % of its major "
         "axis: it is no longer Hertz's contact; at the same approach it carries {load_loss_percent:.2g} % less load, "
         "which acts {turn_deg:.2g} deg farther from the edge; the pressure at the edge is {edge_pressure_MPa:.0f} MPa",
         say=_cut),
    Kind("ellipse_cut_little", NOTE, "limits",
         "the ellipse of {raceways:an} contact runs over the groove's edge, with {beyond_percent:.2g} % of its major "
         "axis: load and angle hold, and the pressure rises at the edge", say=_cut),
    # Readings: motion, friction, film
    Kind("control_assumed", NOTE, CHOICES, "no raceway control is named: all spin is put on the inner raceway"),
    Kind("balls_press_cage", CHECK, "cage_and_grease#balls-and-their-pockets",
         "from lag to lead the balls need {excursion_mm:.3g} mm of freedom in the cage, whose pockets have "
         "{clearance_mm:.3g} mm: the cage holds balls back and pulls others along, by forces that are not computed"),
    Kind("friction_given_exceeded", WRONG, HYPOTHESES,
         "at {raceways:an} contact the gyroscopic moment requires more friction than the coefficient given: the ball "
         "slips, and the heat of this slip is not included"),
    Kind("friction_may_be_low", INCOMPLETE, HYPOTHESES,
         "at {raceways:an} contact the gyroscopic moment requires more than half of the friction coefficient given: "
         "balls creep, and the friction may be too low, up to {times:g} times"),
    Kind("axis_not_held", WRONG, HYPOTHESES,
         "the gyroscopic moment is larger than the friction of both contacts of a ball holds with the coefficient "
         "given: balls slip, and do not turn as raceway control has it"),
    Kind("balls_skid", WRONG, HYPOTHESES,
         "with the least share of oil given, drag is larger than the friction that drives the balls: they skid"),
    Kind("balls_may_skid", INCOMPLETE, HYPOTHESES,
         "with the most oil given, though not with the least, drag is larger than the friction that drives the balls: "
         "they may skid"),
    Kind("least_load_missed", CHECK, HYPOTHESES,
         "the axial load is below the least one by the maker's factor: balls may skid"),
    Kind("speed_rating_unknown", NOTE, CHOICES,
         "SKF's friction model is valid below the bearing's speed rating, which is not given ({field})",
         field=Field("speed_rating")),
    Kind("speed_rating_exceeded", WRONG, CHOICES,
         "the speed is above the bearing's speed rating, the limit of SKF's friction model: its torque and heat are "
         "extrapolated"),
    Kind("pressure_viscosity_estimated", CHECK, CHOICES,
         "the pressure-viscosity coefficient is an estimate for mineral oil, good to some 30 % (15 % of the film "
         "thickness)"),
    Kind("film_isothermal", WRONG, CHOICES,
         "SKF's inlet shear heating factor is below {limit:g}: the true film is thinner than this isothermal one"),
    Kind("film_reduced", NOTE, CHOICES,
         "inlet heating reduces the film of {raceways:an} contact by more than {limit_percent:.0f} %; published "
         "factors of this reduction differ by {spread_percent:.0f} %"),
    Kind("film_thin", NOTE, CHOICES,
         "a film parameter is below 1: asperities touch over much of {raceways:that} contact"),
    # Bearings compared
    Kind("job_of_another", NOTE, "how_to#five-bearings-or-two-machines-compared",
         "{tables} of its file {verb} not used: all are solved with operating point, effects and readings of {job}"),
    # A bearing from its data sheet
    Kind("sheet_sets_left_out", CHECK, "data_sheet", "of {sets} ball sets the {solved} that fit best are solved"),
    Kind("sheet_not_solved", CHECK, "data_sheet",
         "{unsolved} of the {bearings} bearings that the data sheet allows are not solved, and in no range"),
    Kind("sheet_groove_assumed", NOTE, "data_sheet",
         "the ratings do not tell the groove radius: f = {least:.3f} to {most:.3f} is assumed"),
    Kind("sheet_by_name", NOTE, "data_sheet", "taken from the name alone: {what}"),
    Kind("sheet_spin_twice", NOTE, "data_sheet",
         "ball_spin = {printed:g} is read as twice how often a ball turns about itself, {spin:.4g}"),
    Kind("sheet_guessed", CHECK, "data_sheet",
         "the ratings of this bearing are not known here: its balls are guessed by the proportions of its series, for "
         "stiffness and pressure, not for life. Printed ratings replace the guess: {field} and the static one",
         field=Field("bearing.dynamic_load_rating")),
    Kind("sheet_ratings_unstated", CHECK, "data_sheet",
         "nothing states what the ratings mean: they agree with the standards, perhaps by chance, and are read so and "
         "as those of the bearing's own grooves. Add whose they are, such as {field}", field=Setting("maker", "SKF")),
)
# fmt: on
KINDS = {kind.code: kind for kind in _ALL}
"""By their codes."""
